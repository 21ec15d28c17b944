"""Whether the pieces of a dataset fit: each closed, all together of the body's mass, and each shared face in the two pieces that it is said to be in.

    python fit.py data   # what `frangible dataset --hdf5` wrote into data; needs h5py
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import h5py
import numpy as np

# Vertices of two pieces that are one vertex of the body are this near, m.
NEAR = 1e-7


def closed(faces: Any) -> bool:
    """Whether each edge is passed once this way and once that way."""
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]).astype(np.int64)
    there, back = np.sort(edges[:, 0] << 32 | edges[:, 1]), np.sort(edges[:, 1] << 32 | edges[:, 0])
    return bool(np.all(np.diff(there) > 0) and np.array_equal(there, back))


def apart(ours: Any, theirs: Any) -> tuple[int, float]:
    """How many of our triangles are none of theirs, and how far those of one place are apart, m."""
    if len(ours) == 0 or len(theirs) == 0:
        return max(len(ours), len(theirs)), 0.0
    centres, others = ours.mean(axis=1), theirs.mean(axis=1)
    # In the order along some line, those that belong together are mostly beside each other; for the rest, all are compared.
    line = np.array([0.8391, 0.4337, 0.3288])
    centres, others = centres[np.argsort(centres @ line)], others[np.argsort(others @ line)]
    if len(ours) == len(theirs):
        far = np.linalg.norm(centres - others, axis=1)
        if np.all(far < NEAR):
            return 0, float(far.max())
    distances = np.array([np.linalg.norm(others - centre, axis=1).min() for centre in centres])
    return int(np.sum(distances >= NEAR)) + abs(len(ours) - len(theirs)), float(distances[distances < NEAR].max(initial=0.0))


def main(folder: Path) -> None:
    breaks = pieces = still_open = shared = alone = unlike = 0
    off = far = 0.0
    with h5py.File(folder / "garf.hdf5") as file:
        for meta in sorted(folder.glob("meta/*/*/fractured_*.json")):
            about = json.loads(meta.read_text())
            off = max(off, abs(sum(piece["mass"] for piece in about["pieces"]) / about["mass"] - 1))
            group = file[f"{about['category']}/{about['object']}/{meta.stem}/pieces"]
            parts = [(p["vertices"][:], p["faces"][:], p["shared_faces"][:]) for p in (group[name] for name in sorted(group))]
            breaks, pieces = breaks + 1, pieces + len(parts)
            for i, (vertices, faces, beside) in enumerate(parts):
                still_open += not closed(faces)
                corners = vertices[faces]
                volume = np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
                unlike += abs(volume / about["pieces"][i]["volume"] - 1) > 1e-3
                shared += int(np.sum(beside >= 0))
                for j in np.unique(beside[beside > i]):
                    other_vertices, other_faces, other_beside = parts[j]
                    lonely, distance = apart(corners[beside == j], other_vertices[other_faces[other_beside == i]])
                    alone, far = alone + lonely, max(far, distance)
                for j in np.unique(beside[(beside >= 0) & (beside < i)]):
                    alone += int(np.sum(beside == j)) if not np.any(parts[j][2] == i) else 0
    print(f"{breaks} breaks of {pieces} pieces, of which {still_open} are open and {unlike} have another volume than is told")
    print(f"masses are off the body's by {off:.1e} of it at most")
    print(f"{shared} shared faces: {alone} without the other one; two that are one are {far:.1e} m apart at most")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
