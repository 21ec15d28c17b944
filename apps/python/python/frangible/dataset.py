"""Datasets of broken things: meshes times materials times blows, for those who put pieces together again.

    frangible dataset cup.obj vase.glb -o data --material porcelain --breaks 20

makes, under ``data``:

- ``breaking_bad/CATEGORY/OBJECT/fractured_K/piece_N.obj`` in the layout of the Breaking Bad dataset, nothing else in these folders, pieces where they
  were in the body, largest first; ``breaking_bad/data_split/CATEGORY.{train,val}.txt`` names them (objects in one of the two, never in both);
- ``meta/CATEGORY/OBJECT/fractured_K.json``: the blow, the energies, the masses, who touches whom over which area; ``.npz`` beside it: the same pieces in
  float64 with the exact neighbour of each face;
- ``manifest/SHARD.jsonl``: a row for each break, the failed ones with the reason, with the SHA-256 of what was written.

A break that is there is not made again: a run that was killed goes on where it was. ``--shard 2/8`` does the third eighth of the objects.
``--hdf5`` also writes ``garf.hdf5`` as GARF reads it, with exact ``shared_faces``. The data are yours to give: we suggest CC0.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import math
import os
import shutil
import sys
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from dataclasses import asdict, dataclass, field
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np

from .arrays import Floats, number
from .bodies import Body, bake
from .contacts import Contact, Striker
from .outcomes import Fragment, Outcome

GRAVITY = 9.81
# Heights of drops, m, masses of balls, kg, and their speeds, m/s: each is as likely at every order of magnitude.
DROPS = (0.3, 3.0)
BALLS = (0.05, 1.0)
SPEEDS = (3.0, 20.0)
# A blow that gave too few pieces, or too many, is tried again so many times as fast, or as slow; between the two at their geometric mean.
STEP = 1.6


@dataclass(frozen=True)
class Plan:
    """What is made of each mesh.

    Attributes:
        materials: Of each mesh there is a body of each of these.
        breaks: How often each body is broken.
        category: Name of the folder of objects.
        seed: Of all blows and weak points.
        size: Longest side, m; None where the meshes' unit is the metre.
        wall: Thickness of a wall along the mesh, m, instead of what it encloses.
        pieces: Fewest and most pieces of a break.
        least_share: A piece of less than about this share of the body's volume stays with its neighbour; its volume is reckoned by
            whole tetrahedra, so that the pieces, which are cut, can be smaller.
        tetrahedra: For cracks, about.
        modes: Vibration modes.
        tries: Blows that are tried for a break of as many pieces as wanted.
        val_share: Share of the objects in the ``val`` split.
    """

    materials: tuple[str, ...] = ("porcelain",)
    breaks: int = 20
    category: str = "everyday"
    seed: int = 1
    size: float | None = None
    wall: float | None = None
    pieces: tuple[int, int] = (2, 20)
    least_share: float = 1e-3
    tetrahedra: int = 12_000
    modes: int = 60
    tries: int = 12
    val_share: float = 0.2

    def __post_init__(self) -> None:
        if not self.materials:
            raise ValueError("there is no material; give at least one")
        for what, count in (("breaks", self.breaks), ("tries", self.tries), ("tetrahedra", self.tetrahedra), ("modes", self.modes)):
            if int(count) != count or count < 1:
                raise ValueError(f"{what} is {count!r}; give a whole number from 1")
        fewest, most = self.pieces
        if not 2 <= fewest <= most:
            raise ValueError(f"pieces is {fewest} to {most}; give two numbers from 2, the smaller one first")
        for what, share in (("least_share", self.least_share), ("val_share", self.val_share)):
            if number(share, what) > 0.5:
                raise ValueError(f"{what} is {share}; give a number up to 0.5")


@dataclass
class Summary:
    """What a run did.

    Attributes:
        made: Breaks made in this run.
        there: Breaks that were there already.
        failed: Rows of what could not be made, with the reason.
        seconds: Of all workers together.
    """

    made: int = 0
    there: int = 0
    failed: list[dict[str, Any]] = field(default_factory=list)
    seconds: float = 0.0


def objects(meshes: Sequence[Path], plan: Plan, shard: tuple[int, int] = (0, 1)) -> list[tuple[Path, str, str]]:
    """The objects of a shard: mesh, material and name. Two meshes of one name are an error."""
    part, parts = shard
    if not 0 <= part < parts:
        raise ValueError(f"the shard is {part}/{parts}; give I/N with I from 0 to N - 1")
    named: dict[str, Path] = {}
    for mesh in meshes:
        if not mesh.is_file():
            raise ValueError(f"`{mesh}` is no file; give mesh files")
        other = named.setdefault(mesh.stem, mesh)
        if other != mesh:
            raise ValueError(f"`{other}` and `{mesh}` have one name; rename one of them")
    many = len(plan.materials) > 1
    every = [(mesh, m, f"{stem}-{m}" if many else stem) for stem, mesh in sorted(named.items()) for m in plan.materials]
    return every[part::parts]


def make(
    meshes: Sequence[Path], out: Path, plan: Plan, *, shard: tuple[int, int] = (0, 1), workers: int = 1, quiet: bool = False
) -> Summary:
    """Makes the breaks of a shard that are not there yet; an object that cannot be baked is a row, not the end."""
    todo = objects(meshes, plan, shard)
    _keep_plan(out, plan)
    summary, begin = Summary(), time.monotonic()
    rows = out / "manifest" / f"{shard[0]}-of-{shard[1]}.jsonl"
    rows.parent.mkdir(parents=True, exist_ok=True)
    for done, row in _each(todo, out, plan, workers):
        if row is not None:
            with rows.open("a", encoding="utf-8") as file:
                file.write(json.dumps(row, sort_keys=True) + "\n")
            summary.seconds += row["seconds"]
            if row["failed"] is None:
                summary.made += 1
            else:
                summary.failed.append(row)
        else:
            summary.there += 1
        if not quiet:
            _tell(done, len(todo) * plan.breaks, time.monotonic() - begin)
    if not quiet:
        print(file=sys.stderr)
    write_splits(out, plan)
    return summary


def _tell(done: int, all_of_them: int, passed: float) -> None:
    left = passed / max(done, 1) * (all_of_them - done)
    print(f"\r{done} of {all_of_them} breaks, {left / 60:.0f} min left ", end="", file=sys.stderr, flush=True)


def _each(
    todo: list[tuple[Path, str, str]], out: Path, plan: Plan, workers: int
) -> Iterator[tuple[int, dict[str, Any] | None]]:
    """Rows as they come, None for what is there, with how many there are so far."""
    done = 0
    if workers <= 1:
        for mesh, material, name in todo:
            for row in break_object(mesh, material, name, out, plan):
                done += 1
                yield done, row
        return
    # A forked process would have none of the threads that bake.
    with ProcessPoolExecutor(workers, get_context("spawn")) as pool:
        waiting: set[Future[list[dict[str, Any] | None]]] = set()
        rest = iter(todo)
        while True:
            # No more wait than can be worked on: a million objects are not all in memory.
            for mesh, material, name in rest:
                waiting.add(pool.submit(_all_of_object, mesh, material, name, out, plan))
                if len(waiting) >= 2 * workers:
                    break
            if not waiting:
                return
            ready, waiting = wait(waiting, return_when=FIRST_COMPLETED)
            for future in ready:
                for row in future.result():
                    done += 1
                    yield done, row


def _all_of_object(mesh: Path, material: str, name: str, out: Path, plan: Plan) -> list[dict[str, Any] | None]:
    return list(break_object(mesh, material, name, out, plan))


def break_object(mesh: Path, material: str, name: str, out: Path, plan: Plan) -> Iterator[dict[str, Any] | None]:
    """Breaks one object; a row for each break, None where it is there."""
    missing = [k for k in range(plan.breaks) if not _meta(out, plan, name, k).with_suffix(".json").exists()]
    yield from [None] * (plan.breaks - len(missing))
    if not missing:
        return
    begin = time.monotonic()
    row = {"category": plan.category, "object": name, "mesh": mesh.name, "material": material}
    try:
        body = bake(
            mesh, material=material, name=name, size=plan.size, wall=plan.wall, tetrahedra=plan.tetrahedra, modes=plan.modes, seed=plan.seed
        )
    except ValueError as error:
        for k in missing:
            yield {**row, "break": k, "failed": str(error), "seconds": (time.monotonic() - begin) / len(missing)}
        return
    baked = time.monotonic() - begin
    row["mesh_sha256"] = hashlib.sha256(mesh.read_bytes()).hexdigest()
    for k in missing:
        begin = time.monotonic()
        try:
            found, blow = _broken(body, plan, name, k)
            files = _write(out, plan, body, name, k, found, {**row, **blow})
            failed = None
        except ValueError as error:
            files, failed = {}, str(error)
        seconds = time.monotonic() - begin + baked / len(missing)
        yield {**row, "break": k, "failed": failed, "sha256": files, "seconds": seconds}


def _broken(body: Body, plan: Plan, name: str, k: int) -> tuple[Outcome, dict[str, Any]]:
    """A blow that breaks the body into as many pieces as wanted, and what it was."""
    digest = hashlib.sha256(f"{plan.seed} {name} {k}".encode()).digest()
    rng = np.random.default_rng(list(digest))
    contact, words = _drop(body, rng) if rng.random() < 0.5 else _blow(body, rng)
    seed = int.from_bytes(digest[:4], "little")
    fewest, most = plan.pieces
    tried = []
    slow, fast = 0.0, math.inf
    for _ in range(plan.tries):
        outcome = body.impact(contact, seed=seed, least_share=plan.least_share)
        count = len(outcome.fragments)
        tried.append(count)
        if fewest <= count <= most:
            described = {
                **words,
                "point": [float(x) for x in np.asarray(contact.point)],
                "direction": [float(x) for x in np.asarray(contact.direction)],
                "speed": contact.speed,
                "seed": seed,
            }
            return outcome, {"blow": described}
        speed = float(contact.speed or 0.0)
        slow, fast = (speed, fast) if count < fewest else (slow, speed)
        between = math.sqrt(slow * fast) if 0 < slow and fast < math.inf else speed * (STEP if count < fewest else 1 / STEP)
        contact = Contact(contact.point, contact.direction, between, contact.striker)
    raise ValueError(f"{plan.tries} blows gave {tried} pieces and none {fewest} to {most}; widen the limits or allow more tries")


def _between(rng: np.random.Generator, limits: tuple[float, float]) -> float:
    low, high = limits
    return low * math.pow(high / low, rng.random())


def _drop(body: Body, rng: np.random.Generator) -> tuple[Contact, dict[str, Any]]:
    """A fall onto stone, with any side down."""
    down = rng.normal(size=3)
    down /= np.linalg.norm(down)
    point = body.vertices[np.argmax(body.vertices @ down)]
    height = _between(rng, DROPS)
    words = {"kind": "drop", "height": height, "striker": {"material": "stone"}}
    return Contact(point, -down, math.sqrt(2 * GRAVITY * height), "stone"), words


def _blow(body: Body, rng: np.random.Generator) -> tuple[Contact, dict[str, Any]]:
    """A steel ball straight onto any place of the surface."""
    corners = body.vertices[body.faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = np.linalg.norm(normals, axis=1)
    face = rng.choice(len(areas), p=areas / areas.sum())
    weights = rng.dirichlet((1.0, 1.0, 1.0))
    mass = _between(rng, BALLS)
    words = {"kind": "ball", "striker": {"material": "steel", "mass": mass}}
    contact = Contact(weights @ corners[face], -normals[face] / areas[face], _between(rng, SPEEDS), Striker("steel", mass))
    return contact, words


def _folder(out: Path, plan: Plan, name: str, k: int) -> Path:
    return out / "breaking_bad" / plan.category / name / f"fractured_{k}"


def _meta(out: Path, plan: Plan, name: str, k: int) -> Path:
    return out / "meta" / plan.category / name / f"fractured_{k}"


def _write(out: Path, plan: Plan, body: Body, name: str, k: int, outcome: Outcome, words: dict[str, Any]) -> dict[str, str]:
    """Writes a break. Each file and folder has its final name only when it is whole; the JSON comes last."""
    folder, meta = _folder(out, plan, name, k), _meta(out, plan, name, k)
    part = out / "parts" / f"{name}-{k}-{os.getpid()}"
    part.mkdir(parents=True)
    (part / "pieces").mkdir()
    try:
        hashes = {}
        arrays: dict[str, Any] = {}
        for i, fragment in enumerate(outcome.fragments):
            text = _obj(fragment)
            (part / "pieces" / f"piece_{i}.obj").write_bytes(text)
            hashes[f"piece_{i}.obj"] = hashlib.sha256(text).hexdigest()
            arrays |= {f"vertices_{i}": fragment.vertices, f"faces_{i}": fragment.faces, f"neighbour_{i}": fragment.neighbour}
        with (part / "arrays.npz").open("wb") as file:
            np.savez_compressed(file, **arrays)
        about = {**words, "break": k, "pieces": [_about(f) for f in outcome.fragments], "touching": touching(outcome.fragments)}
        numbers = {key: value for key, value in outcome.report.items() if isinstance(value, int | float) and key != "seconds"}
        about |= {"report": numbers, "frequencies": [float(f) for f in body.frequencies], "mass": body.mass}
        about |= {"mesh_scale": body.scale, "mesh_offset": [float(x) for x in body.offset]}
        (part / "about.json").write_text(json.dumps(about, indent=1, sort_keys=True))
        for place in (folder, meta):
            place.parent.mkdir(parents=True, exist_ok=True)
        if folder.exists():
            # Of a run that ended between the pieces and the JSON.
            shutil.rmtree(folder)
        os.replace(part / "pieces", folder)
        os.replace(part / "arrays.npz", meta.with_suffix(".npz"))
        os.replace(part / "about.json", meta.with_suffix(".json"))
        return hashes
    finally:
        shutil.rmtree(part, ignore_errors=True)


def _obj(fragment: Fragment) -> bytes:
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in fragment.vertices.tolist()]
    lines += [f"f {a} {b} {c}" for a, b, c in (fragment.faces + 1).tolist()]
    return ("\n".join(lines) + "\n").encode()


def _about(fragment: Fragment) -> dict[str, Any]:
    return {"mass": fragment.mass, "volume": fragment.volume, "center": [float(x) for x in fragment.center]}


def touching(fragments: Sequence[Fragment]) -> list[dict[str, Any]]:
    """Pairs of fragments that have faces in common, and the area, m²."""
    pairs: dict[tuple[int, int], float] = {}
    for i, fragment in enumerate(fragments):
        corners = fragment.vertices[fragment.faces]
        areas: Floats = 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
        for j in np.unique(fragment.neighbour[fragment.neighbour > i]):
            pairs[i, int(j)] = float(areas[fragment.neighbour == j].sum())
    return [{"pieces": list(pair), "area": area} for pair, area in sorted(pairs.items())]


def _keep_plan(out: Path, plan: Plan) -> None:
    """A folder is of one plan: another one would mix two kinds of breaks under one name."""
    words = json.dumps(asdict(plan), indent=1, sort_keys=True)
    file = out / f"plan-{plan.category}.json"
    if file.exists():
        if file.read_text() != words:
            raise ValueError(f"`{file}` is of another plan; give another folder or category, or the options of then")
        return
    out.mkdir(parents=True, exist_ok=True)
    part = file.with_suffix(f".{os.getpid()}.part")
    part.write_text(words)
    os.replace(part, file)


def breaks(out: Path, category: str) -> list[str]:
    """Names of all breaks that are there, as the splits have them: ``CATEGORY/OBJECT/fractured_K``."""
    there = (out / "meta" / category).glob("*/fractured_*.json")
    found = [(file.parent.name, int(file.stem.removeprefix("fractured_"))) for file in there]
    return [f"{category}/{name}/fractured_{k}" for name, k in sorted(found)]


def split_of(name: str, val_share: float) -> str:
    """``train`` or ``val``, by the object's name alone, so that more objects change nothing."""
    share = int.from_bytes(hashlib.sha256(name.encode()).digest()[:8], "little") / 2**64
    return "val" if share < val_share else "train"


def write_splits(out: Path, plan: Plan) -> None:
    """Names the breaks that are there, each in one split."""
    folder = out / "breaking_bad" / "data_split"
    folder.mkdir(parents=True, exist_ok=True)
    named = breaks(out, plan.category)
    for split in ("train", "val"):
        lines = [line for line in named if split_of(line.split("/")[1], plan.val_share) == split]
        part = folder / f"{plan.category}.{split}.{os.getpid()}.part"
        part.write_text("".join(f"{line}\n" for line in lines))
        os.replace(part, folder / f"{plan.category}.{split}.txt")


def write_hdf5(out: Path, plan: Plan, path: Path) -> int:
    """Writes all breaks that are there as one file that GARF reads; returns how many."""
    try:
        import h5py
    except ImportError as error:
        raise ImportError("this needs h5py: pip install frangible[hdf5]") from error
    named = breaks(out, plan.category)
    part = path.with_name(f"{path.name}.{os.getpid()}.part")
    with h5py.File(part, "w") as file:
        for split in ("train", "val", "test"):
            lines = [line for line in named if split_of(line.split("/")[1], plan.val_share) == split]
            file.create_dataset(f"data_split/{plan.category}/{split}", data=lines, dtype=h5py.string_dtype())
        for line in named:
            _hdf5_break(file.create_group(line), out / "meta" / f"{line}.npz")
    os.replace(part, path)
    return len(named)


def _hdf5_break(group: Any, arrays: Path) -> None:
    with np.load(arrays) as data:
        count = sum(key.startswith("faces_") for key in data.files)
        pieces = [(data[f"vertices_{i}"], data[f"faces_{i}"], data[f"neighbour_{i}"].astype(np.int64)) for i in range(count)]
    import h5py

    # HDF5 lists names by their letters, and `shared_faces` counts in that order: 02 comes before 10.
    digits = len(str(count - 1))
    masks, order = _removals([shared for *_, shared in pieces])
    group.create_dataset("pieces_names", data=[f"piece_{i}" for i in range(count)], dtype=h5py.string_dtype())
    group.create_dataset("removal_masks", data=masks, compression="gzip")
    group.create_dataset("removal_order", data=order, compression="gzip")
    for i, (vertices, faces, shared) in enumerate(pieces):
        piece = group.create_group(f"pieces/{i:0{digits}}")
        for name, values in (("vertices", vertices), ("faces", faces), ("shared_faces", shared)):
            piece.create_dataset(name, data=values, compression="gzip")


def _removals(shared: list[Any]) -> tuple[Any, Any]:
    """Which piece can be taken away after which so that the others still hang together: large ones first, the largest last."""
    count = len(shared)
    beside = [{int(j) for j in np.unique(s[s >= 0])} for s in shared]
    left = set(range(count))
    masks, order = [], []
    for _ in range(count - 1):
        for piece in [*range(1, count), 0]:
            rest = left - {piece}
            if piece in left and _hang_together(rest, beside):
                left = rest
                masks.append([i in left for i in range(count)])
                order.append(piece)
                break
    return np.array(masks, dtype=bool).reshape(-1, count), np.array(order, dtype=np.int64)


def _hang_together(pieces: set[int], beside: list[set[int]]) -> bool:
    reached, waiting = set(), [min(pieces)]
    while waiting:
        piece = waiting.pop()
        if piece not in reached:
            reached.add(piece)
            waiting.extend((beside[piece] | {i for i in pieces if piece in beside[i]}) & pieces)
    return reached == pieces


def _shard(text: str) -> tuple[int, int]:
    part, parts = text.split("/")
    return int(part), int(parts)


def _limits(text: str) -> tuple[int, int]:
    fewest, most = text.split("-")
    return int(fewest), int(most)


def main(words: Sequence[str]) -> int:
    """``frangible dataset``."""
    usual = Plan()
    parser = argparse.ArgumentParser(prog="frangible dataset", description="Breaks meshes many times, for those who put pieces together again.")
    parser.add_argument("meshes", nargs="+", type=Path, help="mesh files: OBJ, STL, PLY, glTF, GLB")
    parser.add_argument("-o", "--out", type=Path, required=True, help="folder; what is there already is not made again")
    parser.add_argument("--material", action="append", help="named material; several make several bodies of each mesh (default porcelain)")
    parser.add_argument("--breaks", type=int, default=usual.breaks, help="of each body (default %(default)s)")
    parser.add_argument("--category", default=usual.category, help="folder of the objects (default %(default)s)")
    parser.add_argument("--seed", type=int, default=usual.seed, help="of all blows (default %(default)s)")
    parser.add_argument("--size", type=float, help="longest side, m (default: the meshes' unit is the metre)")
    parser.add_argument("--wall", type=float, help="thickness of a wall along the mesh, m (default: what it encloses)")
    parser.add_argument("--pieces", type=_limits, default=usual.pieces, metavar="2-20", help="fewest and most pieces (default 2-20)")
    parser.add_argument("--least-share", type=float, default=usual.least_share, help="smaller shares of the volume stay with a neighbour (default %(default)s)")
    parser.add_argument("--tetrahedra", type=int, default=usual.tetrahedra, help="for cracks, about (default %(default)s)")
    parser.add_argument("--shard", type=_shard, default=(0, 1), metavar="I/N", help="does every Nth object, from the Ith (default 0/1)")
    parser.add_argument("--workers", type=int, default=1, help="processes (default %(default)s)")
    parser.add_argument("--hdf5", action="store_true", help="also writes garf.hdf5, of all that is there")
    parser.add_argument("--quiet", action="store_true", help="no progress")
    given = parser.parse_args(words)
    try:
        plan = Plan(
            materials=tuple(given.material or usual.materials),
            breaks=given.breaks,
            category=given.category,
            seed=given.seed,
            size=given.size,
            wall=given.wall,
            pieces=given.pieces,
            least_share=given.least_share,
            tetrahedra=given.tetrahedra,
        )
        summary = make(given.meshes, given.out, plan, shard=given.shard, workers=given.workers, quiet=given.quiet)
        if given.hdf5:
            write_hdf5(given.out, plan, given.out / "garf.hdf5")
    except (ValueError, ImportError, OSError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    print(f"{summary.made} breaks made in {summary.seconds:.1f} s, {summary.there} were there, {len(summary.failed)} failed")
    for row in summary.failed[:10]:
        print(f"failed: {row['object']} {row['break']}: {row['failed']}", file=sys.stderr)
    return 0
