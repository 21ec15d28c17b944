"""Breaks the same bodies with ours, three-pinata and Blender's Cell Fracture and prints a Markdown table; started by pieces.sh."""

import argparse
import json
import os
import resource
import statistics
import subprocess
import sys
from pathlib import Path

import numpy as np

from closed import figures, is_closed
from surfaces import fans, read_obj, signed_volume, sphere, write_obj

ONE_THREAD = {name: "1" for name in ["RAYON_NUM_THREADS", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"]}
LONGEST = 0.15  # side of the bunny and the sphere, m, as large as Table 1's rabbit
TETRAHEDRA, MODES, MATERIAL = 20_000, 100, "porcelain"
# What peers merge and compare is absolute: sizes at which that is small, and which their users have.
PEER_SIZES = {"three-pinata": 2.0, "Cell Fracture": 20.0}
BODIES = ["rabbit", "bunny", "icosphere"]

PAGE = """# Breaks beside others

Written by `benches/peers/pieces.sh --page docs/peers.md`, which installs what it needs; `benches/peers/README.md` says how it works.

Three programs break the same closed bodies: ours, [three-pinata](https://www.npmjs.com/package/@dgreenheck/three-pinata) (npm), and Cell
Fracture, the add-on that comes with Debian's Blender. They answer different questions. Ours computes whether, where and into how many
pieces a blow breaks a body of a material; the others cut it into as many Voronoi cells as they are told. What can be compared is what
comes out: how long it takes, whether the pieces are closed, whether they fill the body.

- Break: processor time on one thread, of the break alone. Ours: the whole impact, from the contact to pieces with surfaces and masses; it
  works on tetrahedra and modes that were baked before, once per kind of body (second table, in processor time of the whole program; of
  the rabbit in wall-clock time). Theirs: from the loaded surface and the seeds
  of the cells to the pieces, no physics.
- Wanted: theirs get as many seeds, the same ones for both, spread evenly within the body; a cell of a body that is not convex may be two
  pieces. Ours takes no number: of blows by a flat stone from six sides, at speeds 8 % apart, the slowest counts that comes within a tenth
  of it, or else the one that comes nearest. Many pieces of a small solid body take speeds that nothing is thrown with.
- Closed: every edge of a piece has exactly two triangles, in opposite directions, after corners at the same place, or within a millionth
  of the body, became one. *As drawn*: bodies from files are drawn with their author's surface, cut by the cracks; that lies a little
  off the tetrahedra's. Its pieces keep the holes that it has (the bunny's has five).
- Volumes: those of all pieces over the volume of the surface that peers break. Where that is the file's own, ours differs by what the
  tetrahedra do not follow.

"""


def main():
    options = parse()
    options.work.mkdir(parents=True, exist_ok=True)
    load = os.getloadavg()[0]
    skipped, rows, versions, bodies = {}, [], {}, []
    for name in options.only or BODIES:
        body = prepare(name, options)
        if isinstance(body, str):
            skipped[name] = body
            continue
        bodies.append(body)
        rows += ours(body, options)
        for peer in PEER_SIZES:
            rows += theirs(peer, body, options, skipped, versions)
    text = "\n".join(report(bodies, rows, skipped, versions, options, load)) + "\n"
    print(text, end="")
    if options.out:
        options.out.write_text(text, encoding="utf-8")
    if options.page:
        options.page.write_text(PAGE + text, encoding="utf-8")


def parse():
    parser = argparse.ArgumentParser(prog="pieces.sh", description="Compares our breaks with three-pinata and Cell Fracture.")
    parser.add_argument("--out", type=Path, help="also write the table to this file")
    parser.add_argument("--page", type=Path, help="also write the table with what it means to this file, such as docs/peers.md")
    parser.add_argument("--only", nargs="+", choices=BODIES, help="bodies; by default all")
    parser.add_argument("--pieces", nargs="+", type=int, default=[16, 50, 100], help="numbers of pieces (default 16 50 100)")
    parser.add_argument("--runs", type=int, default=5, help="runs of each, the median counts (default %(default)s)")
    parser.add_argument("--limit", type=float, default=600.0, help="seconds a peer may take in all (default %(default)s)")
    parser.add_argument("--no-install", action="store_true", help="leave Blender out where it is not installed")
    for hidden in ["--frangible", "--lab", "--hit", "--work", "--pinata"]:
        parser.add_argument(hidden, type=Path, required=True, help=argparse.SUPPRESS)
    return parser.parse_args()


def prepare(name, options):
    """The body baked by ours and as a closed surface for the peers, or why it cannot be had."""
    work = options.work
    body = {"name": name, "baked": work / f"{name}.frangible", "surface": work / f"{name}.obj"}
    if name == "rabbit":
        cache = work / "table1"
        cache_of = [options.lab, "bench", "table1", "--body", "rabbit", "--cache", cache, "--rebake"]
        run([*cache_of, "--runs", 1, "--no-reference", "--json"])
        body["baked"] = cache / f"rabbit-{MODES}.frangible"
        body["bake"] = float((cache / f"rabbit-{MODES}.seconds").read_text())
        surface = None
    else:
        source = work / f"{name}-source.obj"
        if name == "bunny":
            meshes = os.environ.get("FRANGIBLE_MESHES")
            if not meshes:
                return "FRANGIBLE_MESHES names no folder of meshes"
            file = Path(meshes) / "stanford-bunny.obj"
            if not file.is_file():
                return "no stanford-bunny.obj in the folder named by FRANGIBLE_MESHES"
            vertices, triangles = read_obj(file)
        else:
            vertices, polygons = sphere()
            triangles = np.array(fans(polygons))
        write_obj(source, (vertices, triangles.tolist()))
        bake = [options.frangible, "bake", source, "--size", LONGEST, "--material", MATERIAL, "--modes", MODES]
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        run([*bake, "--resolution", TETRAHEDRA, "-o", body["baked"]])
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        body["bake"] = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        scale = LONGEST / float(np.ptp(vertices, axis=0).max())
        surface = (vertices * scale, triangles) if is_closed(vertices, triangles, 1.0 / scale) else None
    body["own"] = surface is None
    if surface is None:
        run([options.hit, "surface", body["baked"], body["surface"]])
        surface = read_obj(body["surface"])
    body["mesh"] = surface
    body["size"] = float(np.ptp(surface[0], axis=0).max())
    body["volume"] = signed_volume(*surface)
    return body


def ours(body, options):
    """A row for each number of pieces; where a body has an author's surface, its pieces count as they are drawn, too."""
    folder = options.work / f"{body['name']}-ours"
    lines = run([options.hit, "pieces", body["baked"], folder, options.runs, *options.pieces]).splitlines()
    rows = []
    for found in map(json.loads, lines):
        row = {"body": body["name"], "program": "Frangible", "wanted": found["wanted"], "blow": found}
        row["seconds"] = statistics.median(found["seconds"])
        rows.append(row | figures(folder / f"{found['wanted']}.obj", body["size"], body["volume"]))
        if found["drawn"]:
            drawn = figures(folder / f"{found['wanted']}-drawn.obj", body["size"], body["volume"])
            rows[-1]["drawn"] = drawn["closed"]
        tell(rows[-1])
    return rows


def theirs(peer, body, options, skipped, versions):
    if peer in skipped:
        return []
    size = PEER_SIZES[peer]
    vertices, triangles = body["mesh"]
    scale = size / body["size"]
    stem = options.work / f"{body['name']}-{peer.replace(' ', '-').lower()}"
    surface = stem.with_suffix(".obj")
    write_obj(surface, (vertices * scale, triangles.tolist()))
    rows = []
    for wanted in options.pieces:
        seeds, out = stem.with_name(f"{stem.name}-{wanted}.json"), stem.with_name(f"{stem.name}-{wanted}-pieces.obj")
        seeds.write_text(json.dumps((seeds_in(vertices, triangles, wanted) * scale).tolist()))
        row = {"body": body["name"], "program": peer, "wanted": wanted}
        try:
            found = result(run(command_of(peer, surface, seeds, out, options), options.limit))
        except FileNotFoundError as error:
            found = {"skipped": f"{error.filename} is not installed"}
        except (subprocess.TimeoutExpired, RuntimeError) as error:
            over = isinstance(error, subprocess.TimeoutExpired)
            row["failed"] = f"more than {options.limit:.0f} s" if over else str(error)
        else:
            if "skipped" not in found:
                versions[peer] = found["version"]
                row["seconds"] = statistics.median(found["seconds"])
                row |= figures(out, size, body["volume"] * scale**3)
        if "failed" not in row and "skipped" in found:
            skipped[peer] = found["skipped"]
            break
        tell(row)
        rows.append(row)
    return rows


def result(printed):
    """The line of JSON after RESULT; Blender prints more below it."""
    return json.loads(printed.split("\nRESULT ")[-1].removeprefix("RESULT ").splitlines()[0])


def command_of(peer, *words):
    *files, options = words
    if peer == "three-pinata":
        surface, seeds, out = files
        return ["node", options.pinata / "break.mjs", surface, seeds, options.runs, out]
    surface, seeds, out = files
    script = Path(__file__).with_name("cells.py")
    blender = ["blender", "--background", "--threads", 1, "--factory-startup", "--python-exit-code", 1, "--python", script]
    return [*blender, "--", surface, seeds, options.runs, out]


def seeds_in(vertices, triangles, count):
    """The same points within the body for every peer, as many as pieces are wanted."""
    draw = np.random.default_rng(1)
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    found = np.empty((0, 3))
    while len(found) < count:
        points = draw.uniform(low, high, (20, 3))
        found = np.vstack([found, points[[winding(p, vertices, triangles) > 0.5 for p in points]]])
    return found[:count]


def winding(point, vertices, triangles):
    """How often the surface winds around a point."""
    a, b, c = np.moveaxis(vertices[triangles] - point, 1, 0)
    x, y, z = (np.linalg.norm(v, axis=1) for v in (a, b, c))
    dot = np.einsum
    below = x * y * z + dot("ij,ij->i", a, b) * z + dot("ij,ij->i", b, c) * x + dot("ij,ij->i", c, a) * y
    return float(np.arctan2(dot("ij,ij->i", a, np.cross(b, c)), below).sum() / (2.0 * np.pi))


def run(command, limit=None):
    """What a process on one thread prints."""
    words = [str(word) for word in command]
    environment = {**os.environ, **ONE_THREAD}
    done = subprocess.run(words, capture_output=True, text=True, env=environment, timeout=limit, check=False)
    if done.returncode:
        reason = (done.stderr.strip() or done.stdout.strip() or str(done.returncode)).splitlines()[-1]
        raise RuntimeError(f"{Path(words[0]).name} failed: {reason}")
    return done.stdout


def tell(row):
    print(row, file=sys.stderr, flush=True)


def report(bodies, rows, skipped, versions, options, load):
    """The table and how it is to be read."""
    lines = [
        f"Measured on: {processor()}, {os.cpu_count()} threads, load {load:.1f} before and {os.getloadavg()[0]:.1f} after. Processor "
        f"milliseconds of a break alone on one thread, medians of {options.runs} runs. "
        + ", ".join(f"{name} {version}" for name, version in about(versions, options)) + ".",
        "",
        "| Body | Wanted | Program | Break, ms | Pieces | Closed | Volumes / body's |",
        "|---|--:|---|--:|--:|--:|--:|",
    ]
    for row in sorted(rows, key=lambda row: ([b["name"] for b in bodies].index(row["body"]), row["wanted"])):
        cells = f"| {row['body']} | {row['wanted']} | {row['program']} "
        if "failed" in row:
            lines.append(f"{cells}| – | – | – | {row['failed']} |")
            continue
        drawn = f" ({100 * row['drawn']:.0f} % as drawn)" if "drawn" in row else ""
        lines.append(
            f"{cells}| {1e3 * row['seconds']:.1f} | {row['pieces']} | {100 * row['closed']:.0f} %{drawn} | {row['volume']:.6f} |"
        )
    lines += ["", "| Body | Surface that peers break | Triangles | Our tetrahedra | Our bake, s | Our blows, m/s |", "|---|---|--:|--:|--:|--:|"]
    for body in bodies:
        blows = [row["blow"] for row in rows if row["body"] == body["name"] and "blow" in row]
        surface = "outer surface of our tetrahedra" if body["own"] else "its own"
        lines.append(
            f"| {body['name']} | {surface} | {len(body['mesh'][1])} | {blows[0]['tets']} | {body['bake']:.2f} | "
            + ", ".join(f"{blow['speed']:.0f}" for blow in blows) + " |"
        )
    if skipped:
        lines += [""] + [f"- {name} is left out: {why}." for name, why in skipped.items()]
    return lines


def about(versions, options):
    """Name and version of all programs that ran."""
    own = run([options.frangible, "--version"]).split()
    yield own[0].capitalize(), own[1]
    for peer, version in versions.items():
        if peer == "three-pinata":
            package = options.pinata / "node_modules" / "@dgreenheck" / "three-pinata" / "package.json"
            yield peer, f"{json.loads(package.read_text())['version']} (three r{version}, Node {run(['node', '--version']).strip()[1:]})"
        else:
            yield "Blender", f"{version} ({peer})"


def processor():
    with open("/proc/cpuinfo", encoding="ascii", errors="replace") as file:
        names = [line.split(":", 1)[1].split() for line in file if line.startswith("model name")]
    return " ".join(names[0]) if names else os.uname().machine


if __name__ == "__main__":
    sys.exit(main())
