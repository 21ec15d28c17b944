"""Writes a hundred vessels as OBJ files: bowls, cups, vases, bottles and plates, each turned on a wheel from a profile that is drawn by chance.

    python vessels.py meshes 100
    frangible dataset meshes/*.obj -o data --category vessels --workers 4 --hdf5
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

# Directions around the axis, and points along the profile of one side.
AROUND, ALONG = 48, 24
# Of each kind: height and widest radius, m, and the radius at these shares of the height, as a share of the widest.
KINDS = {
    "bowl": ((0.06, 0.10), (0.07, 0.11), [0.45, 0.75, 0.9, 0.97, 1.0]),
    "cup": ((0.08, 0.11), (0.035, 0.05), [0.8, 0.95, 1.0, 1.0, 1.0]),
    "vase": ((0.16, 0.26), (0.05, 0.08), [0.6, 0.95, 1.0, 0.6, 0.5]),
    "bottle": ((0.20, 0.28), (0.035, 0.05), [0.95, 1.0, 1.0, 0.5, 0.38]),
    "plate": ((0.02, 0.03), (0.09, 0.13), [0.6, 0.7, 0.85, 0.95, 1.0]),
}
# Of walls and bottoms, m.
THICKNESS = (0.006, 0.009)
# How far a rim leans in or out at most, as radius by height: beyond, its edge is a blade, and needs far too many tetrahedra.
RIM = 0.6


def vessel(kind: str, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """A vessel, closed: vertices (n, 3) in m with the axis upright, and triangles (m, 3)."""
    heights, radii, shape = KINDS[kind]
    height, widest, wall = rng.uniform(*heights), rng.uniform(*radii), rng.uniform(*THICKNESS)
    known = np.linspace(0.0, height, len(shape))
    drawn = widest * np.array(shape) * rng.normal(1.0, 0.05, len(shape))
    up = np.linspace(0.0, height, ALONG)
    outside = np.interp(up, known, drawn)
    # As smooth as hands make it.
    for _ in range(6):
        outside[1:-1] = (outside[:-2] + 2 * outside[1:-1] + outside[2:]) / 4
    slope = np.gradient(outside, up)
    if abs(slope[-1]) > RIM:
        return vessel(kind, rng)
    level = np.linspace(wall, height, ALONG)
    inside = np.interp(level, up, outside) - wall * np.sqrt(1 + np.interp(level, up, slope) ** 2)
    inside = np.maximum(inside, 0.15 * drawn.min())
    profile = np.concatenate([np.stack([outside, up], 1), np.stack([inside, level], 1)[::-1]])
    turn = np.linspace(0, 2 * np.pi, AROUND, endpoint=False)
    rings = np.stack(
        [profile[:, :1] * np.cos(turn), np.broadcast_to(profile[:, 1:], (len(profile), AROUND)), profile[:, :1] * np.sin(turn)], axis=2
    )
    ends = [[0.0, 0.0, 0.0], [0.0, wall, 0.0]]
    vertices = np.concatenate([rings.reshape(-1, 3), ends])
    foot, well = len(vertices) - 2, len(vertices) - 1
    i, j = np.meshgrid(np.arange(len(profile) - 1), np.arange(AROUND), indexing="ij")
    here, right = i * AROUND + j, i * AROUND + (j + 1) % AROUND
    sides = np.concatenate([np.stack([here, here + AROUND, right], -1), np.stack([right, here + AROUND, right + AROUND], -1)]).reshape(-1, 3)
    around = np.arange(AROUND)
    next_one, last = (around + 1) % AROUND, (len(profile) - 1) * AROUND
    bottom = np.stack([np.full(AROUND, foot), around, next_one], 1)
    top = np.stack([np.full(AROUND, well), last + next_one, last + around], 1)
    return vertices, np.concatenate([sides, bottom, top])


def write(folder: Path, count: int, seed: int = 1) -> None:
    """Writes so many vessels, of the kinds in turn."""
    folder.mkdir(parents=True, exist_ok=True)
    for number in range(count):
        kind = list(KINDS)[number % len(KINDS)]
        vertices, faces = vessel(kind, np.random.default_rng([seed, number]))
        lines = [f"v {x:.6f} {y:.6f} {z:.6f}" for x, y, z in vertices] + [f"f {a} {b} {c}" for a, b, c in faces + 1]
        (folder / f"{kind}-{number:03}.obj").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    write(Path(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 100)
