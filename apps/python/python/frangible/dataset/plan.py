"""What is made of each mesh, and of which meshes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ..arrays import number


# A mesh, the material that a body of it is made of, and the body's name.
Object = tuple[Path, str, str]


@dataclass(frozen=True)
class Plan:
    """What is made of each mesh.

    Attributes:
        materials: There is a body of each mesh in each of these.
        breaks: How often each body is broken.
        category: Name of the folder of objects.
        seed: Draws all blows and weak points.
        size: Longest side, m; None where the meshes' unit is the metre.
        wall: Thickness of a wall along the mesh, m, instead of what it encloses.
        pieces: Fewest and most pieces of a break.
        least_share: No piece is a smaller share of the body's volume; smaller ones stay with a neighbour.
        tetrahedra: For cracks, about.
        modes: Vibration modes.
        tries: Blows that are tried for a break of as many pieces as wanted.
        val_share: Share of the objects in the ``val`` split.
        normalized: Whether the unit of the OBJ files and of GARF's is the longest side of each body, as Breaking Bad's, instead of the metre.
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


def objects(meshes: Sequence[Path], plan: Plan, shard: tuple[int, int] = (0, 1)) -> list[Object]:
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
