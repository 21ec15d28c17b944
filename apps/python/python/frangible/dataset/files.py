"""The folders of a dataset. Every file is complete once it has its final name."""

from __future__ import annotations

import errno
import hashlib
import json
import os
import shutil
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from ..arrays import Floats
from ..bodies import Body
from ..outcomes import Fragment, Outcome
from .plan import Plan


def folder_of(out: Path, plan: Plan, name: str, k: int) -> Path:
    return out / "breaking_bad" / plan.category / name / f"fractured_{k}"


def meta_of(out: Path, plan: Plan, name: str, k: int) -> Path:
    return out / "meta" / plan.category / name / f"fractured_{k}"


def is_there(out: Path, plan: Plan, name: str, k: int, mesh_sha256: str) -> bool:
    """Returns True if the break of this mesh exists. Removes a break of a different mesh of the same name."""
    meta = meta_of(out, plan, name, k).with_suffix(".json")
    if not meta.exists():
        return False
    if json.loads(meta.read_text())["mesh_sha256"] == mesh_sha256:
        return True
    meta.unlink()
    shutil.rmtree(folder_of(out, plan, name, k), ignore_errors=True)
    return False


def write_break(out: Path, plan: Plan, body: Body, outcome: Outcome, words: dict[str, Any]) -> dict[str, Any]:
    """Writes a break and returns its metadata. Each file and folder gets its final name only when it is complete; the JSON file comes last."""
    name, k = words["object"], words["break"]
    folder, meta = folder_of(out, plan, name, k), meta_of(out, plan, name, k)
    part = out / "parts" / f"{name}-{k}-{os.getpid()}"
    # A run that was killed may have had the number of this process.
    shutil.rmtree(part, ignore_errors=True)
    part.mkdir(parents=True)
    (part / "pieces").mkdir()
    try:
        hashes = {}
        unit = float(np.ptp(body.vertices, axis=0).max()) if plan.normalized else 1.0
        arrays: dict[str, Any] = {}
        for i, fragment in enumerate(outcome.fragments):
            text = _obj(fragment, unit)
            (part / "pieces" / f"piece_{i}.obj").write_bytes(text)
            hashes[f"piece_{i}.obj"] = hashlib.sha256(text).hexdigest()
            arrays |= {f"vertices_{i}": fragment.vertices, f"faces_{i}": fragment.faces, f"neighbour_{i}": fragment.neighbour}
        with (part / "arrays.npz").open("wb") as file:
            np.savez_compressed(file, **arrays)
        about = {**words, "sha256": hashes, "pieces": [_about(f) for f in outcome.fragments], "touching": touching(outcome.fragments)}
        numbers = {key: value for key, value in outcome.report.items() if isinstance(value, int | float) and key != "seconds"}
        about |= {"report": numbers, "frequencies": [float(f) for f in body.frequencies], "mass": body.mass}
        about |= {"cracks": [{**start, "point": [float(x) for x in start["point"]]} for start in outcome.report["starts"]]}
        about |= {"unit": unit, "mesh_scale": body.scale, "mesh_offset": [float(x) for x in body.offset]}
        (part / "about.json").write_text(json.dumps(about, indent=1, sort_keys=True))
        if is_there(out, plan, name, k, words["mesh_sha256"]):
            # Another run was faster, with the same bits.
            return about
        for place in (folder, meta):
            place.parent.mkdir(parents=True, exist_ok=True)
        _put(part / "pieces", folder, part / "earlier")
        os.replace(part / "arrays.npz", meta.with_suffix(".npz"))
        os.replace(part / "about.json", meta.with_suffix(".json"))
        return about
    except OSError as error:
        # Of a full disk the system does not say where it is.
        raise OSError(error.errno, f"{error.strerror}; completed breaks are kept, and the same call continues with the rest", error.filename or str(part)) from error
    finally:
        shutil.rmtree(part, ignore_errors=True)


def _put(pieces: Path, folder: Path, aside: Path) -> None:
    """Moves a folder to its final name, replacing one left by an interrupted run or written by a concurrent one."""
    while True:
        with suppress(FileNotFoundError):
            os.replace(folder, aside)
        shutil.rmtree(aside, ignore_errors=True)
        try:
            os.replace(pieces, folder)
            return
        except OSError as error:
            if error.errno not in (errno.EEXIST, errno.ENOTEMPTY):
                raise


def _obj(fragment: Fragment, unit: float) -> bytes:
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in (fragment.vertices / unit).tolist()]
    lines += [f"f {a} {b} {c}" for a, b, c in (fragment.faces + 1).tolist()]
    return ("\n".join(lines) + "\n").encode()


def _about(fragment: Fragment) -> dict[str, Any]:
    return {"mass": fragment.mass, "volume": fragment.volume, "center": [float(x) for x in fragment.center]}


def touching(fragments: Sequence[Fragment]) -> list[dict[str, Any]]:
    """Returns the pairs of fragments that share faces, and the shared area, m²."""
    pairs: dict[tuple[int, int], float] = {}
    for i, fragment in enumerate(fragments):
        corners = fragment.vertices[fragment.faces]
        areas: Floats = 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
        for j in np.unique(fragment.neighbour[fragment.neighbour > i]):
            pairs[i, int(j)] = float(areas[fragment.neighbour == j].sum())
    return [{"pieces": list(pair), "area": area} for pair, area in sorted(pairs.items())]


def keep_plan(out: Path, plan: Plan) -> None:
    """Stores the plan in the folder, and raises ``ValueError`` if the folder holds another plan, which would mix different breaks."""
    words = json.dumps(asdict(plan), indent=1, sort_keys=True)
    file = out / f"plan-{plan.category}.json"
    if file.exists():
        if file.read_text() != words:
            raise ValueError(f"`{file}` stores another plan; give another folder or category, or the options of that plan")
        return
    out.mkdir(parents=True, exist_ok=True)
    part = file.with_suffix(f".{os.getpid()}.part")
    part.write_text(words)
    os.replace(part, file)


def breaks(out: Path, category: str) -> list[str]:
    """Returns the names of all existing breaks: ``CATEGORY/OBJECT/fractured_K``."""
    there = (out / "meta" / category).glob("*/fractured_*.json")
    found = [(file.parent.name, int(file.stem.removeprefix("fractured_"))) for file in there]
    return [f"{category}/{name}/fractured_{k}" for name, k in sorted(found)]


def split_of(name: str, val_share: float) -> str:
    """Returns ``train`` or ``val``. Depends only on the object's name, so adding objects does not move others."""
    share = int.from_bytes(hashlib.sha256(name.encode()).digest()[:8], "little") / 2**64
    return "val" if share < val_share else "train"


def write_splits(out: Path, plan: Plan) -> None:
    """Writes the lists of objects with breaks, each object in one split; loaders find the breaks in the objects' folders.

    Some loaders expect the lists beside the objects, others in ``data_split``, so both places get them.
    """
    root = out / "breaking_bad"
    named = sorted({line.rsplit("/", 1)[0] for line in breaks(out, plan.category)})
    for folder in (root, root / "data_split"):
        folder.mkdir(parents=True, exist_ok=True)
        for split in ("train", "val"):
            lines = [line for line in named if split_of(line.split("/")[1], plan.val_share) == split]
            part = folder / f"{plan.category}.{split}.{os.getpid()}.part"
            part.write_text("".join(f"{line}\n" for line in lines))
            os.replace(part, folder / f"{plan.category}.{split}.txt")
