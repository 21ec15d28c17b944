"""All breaks of a dataset as one HDF5 file that GARF reads."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

import numpy as np

from .files import breaks, split_of


def write_hdf5(out: Path, path: Path) -> int:
    """Writes all breaks of all categories to one HDF5 file in the format of GARF. Returns their number."""
    try:
        import h5py
    except ImportError as error:
        raise ImportError("this needs h5py: pip install frangible[hdf5]") from error
    plans = [json.loads(file.read_text()) for file in sorted(out.glob("plan-*.json"))]
    count = 0
    part = path.with_name(f"{path.name}.{os.getpid()}.part")
    with h5py.File(part, "w") as file:
        for plan in plans:
            category = plan["category"]
            named = breaks(out, category)
            count += len(named)
            for split in ("train", "val", "test"):
                lines = [line for line in named if split_of(line.split("/")[1], plan["val_share"]) == split]
                file.create_dataset(f"data_split/{category}/{split}", data=lines, dtype=h5py.string_dtype())
            for line in named:
                _hdf5_break(file.create_group(line), out / "meta" / line)
    os.replace(part, path)
    return count


def _hdf5_break(group: Any, meta: Path) -> None:
    # Folders of before there was a choice are in metres.
    unit = json.loads(meta.with_suffix(".json").read_text()).get("unit", 1.0)
    with np.load(meta.with_suffix(".npz")) as data:
        count = sum(key.startswith("faces_") for key in data.files)
        pieces = [(data[f"vertices_{i}"] / unit, data[f"faces_{i}"], data[f"neighbour_{i}"].astype(np.int64)) for i in range(count)]
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
    """Returns an order in which pieces can be removed so that the rest stays connected: large ones first, the largest last."""
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
