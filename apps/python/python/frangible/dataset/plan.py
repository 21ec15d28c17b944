"""The plan of a dataset: meshes, materials and the settings of the breaks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ..arrays import number


# A mesh, the material of the body, and the name of the body.
Object = tuple[Path, str, str]


@dataclass(frozen=True)
class Plan:
    """Settings of a dataset.

    Attributes:
        materials: Names of the materials; each mesh becomes one body per material.
        breaks: Number of breaks of each body.
        category: Name of the folder of the objects.
        seed: Random seed for all blows and weak points.
        size: Length of the longest side, m; None if the meshes are in metres.
        wall: Thickness of a wall along the mesh, m, instead of a solid body; None for solid bodies.
        pieces: Smallest and largest number of pieces of a break.
        least_share: Smallest volume of a piece, as a share of the body's volume; smaller pieces stay with a neighbour.
        tetrahedra: Approximate number of tetrahedra of the fracture mesh.
        modes: Number of vibration modes.
        tries: Maximum number of blows tried to get an allowed number of pieces.
        val_share: Share of the objects in the ``val`` split.
        normalized: Write the OBJ and GARF files in units of the longest side of each body, as in Breaking Bad, instead of metres.
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
    tries: int = 24
    val_share: float = 0.2
    normalized: bool = False

    def __post_init__(self) -> None:
        if not self.materials:
            raise ValueError("no material given; give at least one")
        for what, count in (("breaks", self.breaks), ("tries", self.tries), ("tetrahedra", self.tetrahedra), ("modes", self.modes)):
            if int(count) != count or count < 1:
                raise ValueError(f"{what} is {count!r}; give a whole number from 1")
        fewest, most = self.pieces
        if not 2 <= fewest <= most:
            raise ValueError(f"pieces is {fewest} to {most}; give two numbers from 2, the smaller one first")
        for what, share in (("least_share", self.least_share), ("val_share", self.val_share)):
            if number(share, what) > 0.5:
                raise ValueError(f"{what} is {share}; give a number from 0 to 0.5")


def objects(meshes: Sequence[Path], plan: Plan, shard: tuple[int, int] = (0, 1)) -> list[Object]:
    """Returns the objects of a shard: mesh, material and name. Raises ``ValueError`` if two meshes have the same name."""
    part, parts = shard
    if not 0 <= part < parts:
        raise ValueError(f"the shard is {part}/{parts}; give I/N with I from 0 to N - 1")
    named: dict[str, Path] = {}
    for mesh in meshes:
        if not mesh.is_file():
            raise ValueError(f"`{mesh}` is not a file; give mesh files")
        other = named.setdefault(mesh.stem, mesh)
        if other != mesh:
            raise ValueError(f"`{other}` and `{mesh}` have the same name; rename one of them")
    many = len(plan.materials) > 1
    every = [(mesh, m, f"{stem}-{m}" if many else stem) for stem, mesh in sorted(named.items()) for m in plan.materials]
    return every[part::parts]
