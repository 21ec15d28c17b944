"""Writes a model that is put together from seven parts as an OBJ file: a plinth, four columns, a roof and an urn on it, each with a name.

    python temple.py temple.obj
    frangible break temple.obj --material marble --drop 0.3
"""

from __future__ import annotations

import math
import sys
from pathlib import Path

# Sides of a column and corners around the urn.
SIDES = 16
# Half of the distance between the columns' axes, along x and z, and radius of a column at its foot and at its head, m.
HALF, COLUMN = (0.07, 0.045), (0.012, 0.010)
# Heights of the tops of plinth, columns and roof, m.
PLINTH, COLUMNS, ROOF = 0.03, 0.15, 0.175
# Profile of the urn above the roof: radius and height, m, from its foot to its lid.
URN = [(0.012, 0.0), (0.006, 0.008), (0.016, 0.022), (0.017, 0.03), (0.009, 0.04), (0.011, 0.044)]

Mesh = tuple[list[tuple[float, float, float]], list[tuple[int, ...]]]


def box(low: tuple[float, float, float], high: tuple[float, float, float]) -> Mesh:
    """A box from its lowest corner to its highest."""
    corners = [tuple((low, high)[i >> k & 1][k] for k in range(3)) for i in range(8)]
    return corners, [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]


def turned(profile: list[tuple[float, float]], x: float, z: float) -> Mesh:
    """A solid of revolution about an upright axis, from its profile of radii and heights, from below."""
    turns = [2 * math.pi * i / SIDES for i in range(SIDES)]
    corners = [(x + radius * math.cos(turn), height, z - radius * math.sin(turn)) for radius, height in profile for turn in turns]
    rings = [range(SIDES * row, SIDES * (row + 1)) for row in range(len(profile))]
    faces = [(low[i], low[i - SIDES + 1], high[i - SIDES + 1], high[i]) for low, high in zip(rings, rings[1:]) for i in range(SIDES)]
    return corners, [*faces, tuple(reversed(rings[0])), tuple(rings[-1])]


def temple() -> dict[str, Mesh]:
    """The parts by their names. Each stands on the one below it, and y is up."""
    x, z = HALF
    feet = [(-x, -z), (x, -z), (x, z), (-x, z)]
    column = [(COLUMN[0], PLINTH), (COLUMN[1], COLUMNS)]
    parts = {"plinth": box((-0.1, 0.0, -0.07), (0.1, PLINTH, 0.07))}
    parts |= {f"column_{i + 1}": turned(column, *foot) for i, foot in enumerate(feet)}
    parts["roof"] = box((-0.095, COLUMNS, -0.065), (0.095, ROOF, 0.065))
    parts["urn"] = turned([(radius, ROOF + height) for radius, height in URN], 0.0, 0.0)
    return parts


def main() -> None:
    lines, first = [], 1
    for name, (corners, faces) in temple().items():
        lines.append(f"o {name}")
        lines += [f"v {x:.6g} {y:.6g} {z:.6g}" for x, y, z in corners]
        lines += ["f " + " ".join(str(first + corner) for corner in face) for face in faces]
        first += len(corners)
    Path(sys.argv[1] if len(sys.argv) > 1 else "temple.obj").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
