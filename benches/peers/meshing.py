"""Runs our mesher, TetGen and fTetWild on the same surfaces and prints a Markdown table; started by meshing.sh.

TetGen is AGPL-3.0 and fTetWild MPL-2.0: both are installed for comparison only and linked to nothing.
"""

import argparse
import json
import os
import signal
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

import numpy as np

from quality import figures, read_medit
from surfaces import HOLLOW_INSIDE, generated, read_obj, signed_volume, write_obj

HERE = Path(__file__).resolve().parent
REAL = ["spot.obj", "stanford-bunny.obj", "suzanne.obj", "teapot.obj"]
PEERS = ["TetGen", "fTetWild"]
STAGES = ["read", "repair", "tree", "walls", "fill"]
ONE_THREAD = {"RAYON_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
CLOSE_ENOUGH = 0.15  # share by which a peer may miss the number of tetrahedra; ours promises the same
VOLUME_OFF = 0.1  # share of the known volume that makes a mesh a failure
ANGLE_AGREEMENT = 0.01  # degrees: our printed angles have two decimals


def main():
    options = parse()
    work = options.work.resolve()
    lines = []
    surfaces = collect(work / "surfaces", options.only, lines)
    load = os.getloadavg()[0]
    rows = []
    for name, path, volume in surfaces:
        rows.append((name, len(read_obj(path)[1]), compare(name, path, volume, work, options)))
    lines += report(rows, options, load)
    text = "\n".join(lines) + "\n"
    print(text, end="")
    if options.out:
        options.out.write_text(text, encoding="utf-8")


def parse():
    parser = argparse.ArgumentParser(prog="meshing.sh", description="Compares our mesher with TetGen and fTetWild.")
    parser.add_argument("--out", type=Path, help="also write the table to this file")
    parser.add_argument("--tets", type=int, default=20_000, help="tetrahedra asked for (default %(default)s)")
    parser.add_argument("--limit", type=float, default=120.0, help="seconds per run (default %(default)s)")
    parser.add_argument("--tries", type=int, default=3, help="runs of a peer to meet the number (default %(default)s)")
    parser.add_argument("--only", nargs="+", metavar="NAME", help="only surfaces whose name contains one of these")
    parser.add_argument("--mesh-file", type=Path, required=True, help=argparse.SUPPRESS)
    parser.add_argument("--work", type=Path, required=True, help=argparse.SUPPRESS)
    return parser.parse_args()


def collect(folder, only, lines):
    """Name, path and volume, m³, where it is known, of each surface; writes the generated ones."""
    folder.mkdir(parents=True, exist_ok=True)
    meshes = os.environ.get("FRANGIBLE_MESHES")
    wanted = [(Path(file).stem, Path(meshes) / file if meshes else None, None) for file in REAL]
    for name, (surface, volume) in generated().items():
        path = folder / (name.replace(" ", "-") + ".obj")
        write_obj(path, surface)
        wanted.append((name, path, volume))
    found = []
    for name, path, volume in wanted:
        if only and not any(part in name for part in only):
            continue
        if path is None:
            lines += [f"skipped {name}: FRANGIBLE_MESHES names no folder of meshes", ""]
        elif path.is_file():
            found.append((name, path.resolve(), volume))
        else:
            lines += [f"skipped {name}: there is no file {path}", ""]
    return found


def compare(name, path, known_volume, work, options):
    """Results by mesher: the figures, and why it failed if it did."""
    results = {"ours": ours(path, work, options)}
    volume = known_volume or results["ours"].get("volume") or enclosed(*read_obj(path))
    hole = HOLLOW_INSIDE if name == "hollow sphere" else ()
    for peer in PEERS:
        results[peer] = nearest_run(peer, path, volume, hole, work, options)
    for mesher, result in results.items():
        if known_volume and "volume" in result and abs(result["volume"] / known_volume - 1.0) > VOLUME_OFF:
            result["failed"] = f"holds {100.0 * result['volume'] / known_volume:.0f} % of the volume"
        print(f"{name}, {mesher}: {result}", file=sys.stderr, flush=True)
    return results


def ours(path, work, options):
    code, out, err = run([options.mesh_file, "--out", work / "ours", options.tets, path], options.limit, work)
    if code is None:
        return {"failed": f"no end within {options.limit:g} s"}
    try:
        result = json.loads(out)
    except ValueError:
        return {"failed": reason(code, out + err)}
    if "failed" in result:
        return {"failed": tidy(result["failed"])}
    measured = figures(*read_medit(work / "ours" / f"{path.stem}.mesh"))
    for angle in ["smallest_angle", "largest_angle"]:
        if abs(measured[angle] - result[angle]) > ANGLE_AGREEMENT:
            sys.exit(f"{path}: we print {angle} {result[angle]}, measured is {measured[angle]}")
    return {**result, **measured}


def nearest_run(peer, path, volume, hole, work, options):
    """Runs a peer until its number of tetrahedra is close to the wanted; the closest run counts."""
    # A regular tetrahedron of edge l holds l³ / (6 √2); TetGen's average is about half of its largest.
    size = volume / options.tets * {"TetGen": 2.0, "fTetWild": 6.0 * 2.0**0.5}[peer]
    best, counts = None, []
    too_small, too_large = 0.0, float("inf")
    for _ in range(max(options.tries, 1)):
        argument = size if peer == "TetGen" else size ** (1.0 / 3.0)
        result = peer_run(peer, path, argument, hole, work, options.limit)
        if "failed" in result:
            best = best or result
            break
        counts.append(result["tets"])
        ratio = result["tets"] / options.tets
        if best is None or abs(np.log(ratio)) < abs(np.log(best["tets"] / options.tets)):
            best = result
        if abs(ratio - 1.0) <= CLOSE_ENOUGH:
            break
        if ratio > 1.0:
            too_small = size
        else:
            too_large = size
        size *= ratio
        # fTetWild's number jumps where edges are halved: between two sizes known, take the middle.
        if not too_small < size < too_large:
            size = (too_small * too_large) ** 0.5
    return {**best, "counts": counts}


def peer_run(peer, path, argument, hole, work, limit):
    # fTetWild leaves a file in the current folder.
    code, out, err = run([sys.executable, HERE / "peer.py", peer, path, repr(float(argument)), *hole], limit, work)
    if code is None:
        return {"failed": f"no end within {limit:g} s"}
    for line in out.splitlines():
        if code == 0 and line.startswith("RESULT "):
            return json.loads(line.removeprefix("RESULT "))
    return {"failed": reason(code, out + "\n" + err)}


def run(command, limit, folder):
    """Exit code (None: out of time), standard output and standard error of a process of its own, on one thread."""
    process = subprocess.Popen(
        [str(word) for word in command],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=folder,
        errors="replace",
        env={**os.environ, **ONE_THREAD},
        start_new_session=True,
    )
    try:
        out, err = process.communicate(timeout=limit)
        return process.returncode, out, err
    except subprocess.TimeoutExpired:
        return None, "", ""
    finally:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()


def reason(code, text):
    if code < 0:
        return f"killed by {signal.Signals(-code).name}"
    said = [line.strip() for line in text.splitlines() if line.strip()]
    return tidy(said[-1]) if said else f"exit code {code}"


def tidy(text):
    return " ".join(text.replace("|", "/").split())[:160]


def enclosed(vertices, triangles):
    """Volume for a first guess of sizes, m³: that of the triangles, or of the box if they enclose next to nothing."""
    volume = abs(signed_volume(vertices, triangles))
    box = float(np.prod(vertices.max(0) - vertices.min(0)))
    return volume if volume > 0.01 * box else box


def report(rows, options, load):
    """The table, how it is to be read, and where our seconds go."""
    lines = [
        f"Surfaces filled with about {options.tets} tetrahedra, one thread each, at most {options.limit:g} s a run.",
        f"TetGen {version('tetgen')} (AGPL-3.0) and fTetWild of pytetwild {version('pytetwild')} (MPL-2.0), "
        f"installed for comparison only. {os.cpu_count()} processors, load {load:.1f} before and "
        f"{os.getloadavg()[0]:.1f} after.",
        "",
        "Every mesher gets the surface as it is. TetGen needs a closed surface that does not intersect itself, and keeps "
        "all of its vertices: a fine surface gives more tetrahedra than wanted. TetGen is told where the cavity of the "
        "hollow sphere is. What comes out is not the same: TetGen keeps the surface exactly, fTetWild to a thousandth of "
        "the box's diagonal, ours to the size of its tetrahedra, and only the largest piece. A generated "
        "solid filled to less than 90 % or more than 110 % of its known volume counts as failed.",
        "",
        "| Surface | Triangles | Mesher | Seconds | Tetrahedra | Nodes | Smallest angle | Largest angle | Volume, m³ | Remarks |",
        "|---|--:|---|--:|--:|--:|--:|--:|--:|---|",
    ]
    for name, triangles, results in rows:
        for mesher, result in results.items():
            lines.append(f"| {name} | {triangles} | {mesher} | {cells(result, options)} |")
    lines.append("")
    for mesher in ["ours", *PEERS]:
        failed = sum("failed" in results[mesher] for _, _, results in rows)
        lines.append(f"- {mesher}: {failed} of {len(rows)} failed")
    lines += [
        "",
        "Seconds: ours are from the mesh as it was read to tetrahedra: repair, winding tree, wall thickness and filling, "
        "with its own search for the size. Those of the peers are from arrays in memory to tetrahedra, the one run that "
        "came closest to the number; where it took several runs to find the size, the remarks say so. Ours by stage, with "
        "the reading of the file, which is in no other figure:",
        "",
        "| Surface | " + " | ".join(stage.capitalize() for stage in STAGES) + " |",
        "|---|" + "--:|" * len(STAGES),
    ]
    for name, _, results in rows:
        if "tets" in results["ours"]:
            lines.append(f"| {name} | " + " | ".join(f"{results['ours'][stage]:.3f}" for stage in STAGES) + " |")
    return lines


def cells(result, options):
    remarks = [f"failed: {result['failed']}"] if "failed" in result else []
    if "tets" not in result:
        return f"– | – | – | – | – | – | {remarks[0]}"
    if abs(result["tets"] / options.tets - 1.0) > CLOSE_ENOUGH:
        remarks.append(f"{result['tets'] / options.tets:.2f} of the number")
    if result["inverted"]:
        remarks.append(f"{result['inverted']} inverted or flat")
    if len(result.get("counts", [])) > 1:
        remarks.append("sizes tried gave " + ", ".join(str(count) for count in result["counts"]))
    return (
        f"{result['seconds']:.2f} | {result['tets']} | {result['nodes']} | {result['smallest_angle']:.2f}° | "
        f"{result['largest_angle']:.2f}° | {result['volume']:.4g} | {'; '.join(remarks)}"
    )


if __name__ == "__main__":
    main()
