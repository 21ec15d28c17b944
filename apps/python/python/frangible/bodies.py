"""Bodies: what a bake makes of a mesh and a material."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _frangible
from .arrays import Floats, Ints, mesh, number, rows, seed_of, strings, vector
from .contacts import Contact, rows_of
from .outcomes import Outcome
from .weakness import Factor, factors_of

Contacts = Contact | Iterable[Contact]


@dataclass(frozen=True)
class Fatigue:
    """How strength falls with the time that a load lasts: flaws of glass and ceramics grow slowly in air.

    Attributes:
        exponent: n of the law of slow crack growth, above 2: glass 16, porcelain 20 to 40.
        rate: At which the stress rose in the slow test, Pa/s.
        increase: Inert strength, which is the material's, over that of the slow test, above 1.
    """

    exponent: float
    rate: float
    increase: float

    def _numbers(self) -> list[float]:
        return [number(value, f"fatigue.{name}") for name, value in vars(self).items()]


class Body:
    """A kind of body that can be broken: its mesh of tetrahedra, its vibration modes and its material.

    It does not change: each blow meets it whole, with the weak points of the seed given.

    Attributes:
        name: Its name.
        material: Name of its material.
        strength: Tensile strength of its material, Pa.
        supported: Whether something holds it.
        mass: kg.
        volume: m³.
        center: (3,) centre of mass, m: the origin of the body's frame.
        inertia: (3, 3) about it, kg·m².
        vertices: (n, 3) nodes of its tetrahedra, m, in the body's frame; of a piece those of its surface.
        faces: (m, 3) int32, its surface.
        tetrahedra: How many it has.
        frequencies: (k,) of its vibration modes, Hz, rising.
        scale: Factor of the lengths of the mesh that it was baked from.
        offset: (3,) m: a place p of that mesh is at ``scale * p + offset``.
    """

    def __init__(self, kind: _frangible.Kind, scale: float = 1.0, offset: ArrayLike = (0.0, 0.0, 0.0)) -> None:
        self._kind = kind
        self.scale = float(scale)
        self.offset = vector(offset, "offset")
        about = kind.about()
        self.name: str = about["name"]
        self.material: str = about["material"]
        self.strength: float = about["strength"]
        self.supported: bool = about["supported"]
        self.mass: float = about["mass"]
        self.volume: float = about["volume"]
        self.center: Floats = about["center"]
        self.inertia: Floats = rows(about["inertia"], 3)
        self.vertices: Floats = rows(about["vertices"], 3)
        self.faces: Ints = about["faces"].reshape(-1, 3).astype(np.int32)
        self.tetrahedra: int = about["tetrahedra"]
        self.frequencies: Floats = about["frequencies"]

    def __repr__(self) -> str:
        return f"<Body {self.name!r}: {self.mass:.4g} kg of {self.material}, {self.tetrahedra} tetrahedra, {len(self.frequencies)} modes>"

    def __reduce__(self) -> tuple[Any, ...]:
        return _of_bytes, (self._kind.to_bytes(), self.scale, self.offset, self._kind.factors(), self._kind.scatter())

    @property
    def modes(self) -> Floats:
        """(k, n, 3) displacement of each vertex in each mode of unit modal mass, 1/√kg."""
        return np.stack([rows(self._kind.mode(i), 3) for i in range(len(self.frequencies))])

    def weakened(self, strength: Factor | None = None, toughness: Factor | None = None, weak_points: Factor | None = None) -> Body:
        """This body, weaker in some places, or stronger: with factors on its material's numbers.

        Each factor is a number, or an array (n,) with one for each of ``vertices``, or a function. An array's tetrahedron has the mean of its
        four vertices. A function is given the middles of all tetrahedra, (t, 3), m, in the body's frame, and returns (t,).

            >>> import frangible as fr
            >>> bar = fr.bake(*fr.box(0.3, 0.03, 0.03), material="porcelain", tetrahedra=4000, modes=40)
            >>> blow = fr.Contact(point=(0, 0, 0.015), direction=(0, 0, -1), speed=5.0, striker=fr.Striker(mass=0.2))
            >>> weak = bar.weakened(strength=lambda places: 1 - 0.7 * (abs(places[:, 0] - 0.06) < 0.02))
            >>> weak.minimum_speed(blow) < bar.minimum_speed(blow)
            True

        All that is asked of the new body minds its weakness: blows, worlds, its pieces and its pickles. A ``.frangible`` file has no place for
        it. A body that is weakened again has the product of the factors.

        Args:
            strength: On the tensile strength, above 0.
            toughness: On the fracture energy, above 0. By default the square of the strength's, as of flaws of the same size.
            weak_points: On the density of weak points, from 0; where it is 0 no crack starts.

        Raises:
            ValueError: A factor out of these bounds or not one for each, or a piece, which keeps the weakness of its body.
        """
        tets = self._kind.tets().reshape(-1, 4)

        def of_tets(given: Factor | None, name: str, *, zero: bool = False) -> Floats:
            return np.ones(len(tets)) if given is None else factors_of(given, name, self.vertices, tets, zero=zero)

        strong = of_tets(strength, "strength")
        tough = strong**2 if toughness is None else of_tets(toughness, "toughness")
        factors = np.stack([strong, tough, of_tets(weak_points, "weak_points", zero=True)], axis=1)
        before = self._kind.factors()
        if before.size:
            factors *= rows(before, 3)
        return Body(self._kind.with_factors(factors.ravel()), self.scale, self.offset)

    def scattered(self, weibull_modulus: float | None = None, specimen: float | None = None, fatigue: Fatigue | None = None) -> Body:
        """This body with another scatter of its strength; what is not given stays. A bake gives it its material's.

            >>> import frangible as fr
            >>> pane = fr.bake(*fr.box(0.2, 0.2, 0.008), material="glass", tetrahedra=4000, modes=40)
            >>> even = pane.scattered(weibull_modulus=50)

        As after :meth:`weakened`, a ``.frangible`` file has no place for it.

        Args:
            weibull_modulus: From 1: glass 7, brick 6, fine ceramics 10 to 20; lower scatters more. 0: every weak point is as strong.
            specimen: Volume of the specimens whose strength is the material's, m³: of bodies that scatter those that are larger are weaker.
            fatigue: How the strength falls with the time that a load lasts.

        Raises:
            ValueError: A number that cannot be used, or a piece, which keeps the scatter of its body.
        """
        modulus, volume, tired = self._kind.scatter()
        if weibull_modulus is not None:
            modulus = number(weibull_modulus, "weibull_modulus")
        if specimen is not None:
            volume = number(specimen, "specimen", above=True)
        if fatigue is not None:
            tired = fatigue._numbers()
        return Body(self._kind.with_scatter(modulus, volume, tired), self.scale, self.offset)

    def impact(self, contacts: Contacts, seed: int | None = None, least_share: float | None = None) -> Outcome:
        """What a blow does to a whole body.

        Args:
            contacts: All contacts of the blow, in the body's frame.
            seed: Draws the weak points and the roughness of the cracks, default 1; a piece has that of its body.
            least_share: A piece of less than this share of the body's volume stays with its neighbour; default 2e-4.

        Raises:
            ValueError: A number that cannot be used.
        """
        share = None if least_share is None else number(least_share, "least_share")
        return Outcome(self._kind.impact(rows_of(contacts), _seed(seed), share))

    def would_break(self, contacts: Contacts, seed: int | None = None) -> bool:
        """Whether a blow breaks the body: the answer of :meth:`impact` without the pieces."""
        return self._kind.would_break(rows_of(contacts), _seed(seed))

    def margin(self, contacts: Contacts, seed: int | None = None) -> float:
        """Strength over the largest stress of a blow at a weak point: above 1 no crack starts."""
        return self._kind.margin(rows_of(contacts), _seed(seed))

    def minimum_speed(self, contacts: Contacts, seed: int | None = None, tolerance: float = 0.01) -> float:
        """The slowest approach at which a blow like this breaks the body.

        Args:
            contacts: Where and by what; their speeds do not matter.
            seed: Draws the weak points.
            tolerance: Share of the speed to which it is found.

        Returns:
            m/s; infinite where 1000 m/s do not break it.
        """
        share = number(tolerance, "tolerance", above=True)
        return self._kind.minimum_speed(rows_of(contacts), _seed(seed), share)

    def stress(self, contacts: Contacts, time: float | None = None, seed: int | None = None) -> tuple[Floats, Floats]:
        """The stress on the surface after a blow, as if nothing cracked.

        Args:
            contacts: The blow.
            time: After its begin, s: the time step nearest to it. By default all of them.
            seed: Draws the weak points, which say how deep a flaw is.

        Returns:
            Times (t,), s, and the largest principal tension (t, m) on each face at each of them, Pa; NaN where no flaw is.
        """
        wanted = None if time is None else number(time, "time")
        times, tensions = self._kind.stress(rows_of(contacts), _seed(seed), wanted)
        return times, tensions.reshape(len(times), -1)

    def to_bytes(self) -> bytes:
        """Its ``.frangible`` file.

        Raises:
            ValueError: A piece or a weakened body, or one with another scatter than its material's, which have none.
        """
        data = self._kind.to_bytes()
        if self._kind.factors().size:
            raise ValueError("a file holds no weakness; save the body before it is weakened, or pickle this one")
        if self._kind.scatter() != _frangible.Kind.of_bytes(data).scatter():
            raise ValueError("a file holds no scatter; save the body before it has another one, or pickle this one")
        return data

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes its ``.frangible`` file: whole, or not at all."""
        data = self.to_bytes()
        part = f"{os.fspath(path)}.part"
        with open(part, "wb") as file:
            file.write(data)
        os.replace(part, path)


def bake(
    vertices: ArrayLike | str | os.PathLike[str] | Any,
    faces: ArrayLike | None = None,
    *,
    material: str = "glass",
    name: str = "body",
    size: float | None = None,
    wall: float | None = None,
    tetrahedra: int | None = None,
    modes: int | None = None,
    supports: str | Sequence[str] = (),
    seed: int = 1,
    progress: Callable[[str, float], object] | None = None,
) -> Body:
    """Makes a mesh breakable. It takes seconds, and Ctrl-C ends it.

    Args:
        vertices: (n, 3), or a mesh file (OBJ, STL, PLY, glTF, GLB), or anything with ``vertices`` and ``faces``, such as a
            ``trimesh.Trimesh``.
        faces: (m, 3) whole numbers. Splits, doubles, turned faces and holes are mended.
        material: A named material: ``glass`` (handled, as most is; ``glass-new``, ``glass-abraded``), ``porcelain``, ``brick``, ``concrete``,
            ``chocolate`` …
        name: The body's name.
        size: Longest side, m. By default the mesh's unit is the metre.
        wall: Thickness, m, of a wall along the mesh, instead of what it encloses.
        tetrahedra: How many there are for cracks, about. More are finer and slower. By default 42 000; 1500 are enough for games.
        modes: Vibration modes that are kept.
        supports: What holds it, in the mesh's frame after ``size``: ``"below:z:0.01"``, ``"box:0,0,0,0.1,0.1,0.1"``,
            ``"sphere:0,0,0,0.02"``; ``"@xy"`` after one holds it along x and y only.
        seed: Draws the irregularity of the tetrahedra.
        progress: Told the stage and its share that is done, meanwhile. What it raises ends the bake.

    Raises:
        ValueError: A mesh that cannot be meant as a solid, or a number that cannot be used.
    """
    places, corners = mesh(*_both(vertices, faces))
    for what, value in (("size", size), ("wall", wall)):
        if value is not None:
            number(value, what, above=True)
    for what, count in (("tetrahedra", tetrahedra), ("modes", modes)):
        if count is not None and (int(count) != count or count < 1):
            raise ValueError(f"{what} is {count!r}; give a whole number from 1")
    kind, scale, offset = _frangible.bake(
        places.ravel(), corners.ravel(), name, material, size, wall, tetrahedra, modes, strings(supports), seed_of(seed), progress
    )
    return Body(kind, scale, offset)


def _both(vertices: Any, faces: ArrayLike | None) -> tuple[ArrayLike, ArrayLike]:
    """Vertices and faces of arrays, a file, or a mesh that has both."""
    if faces is not None:
        return vertices, faces
    if isinstance(vertices, str | os.PathLike):
        return read_mesh(vertices)
    try:
        return vertices.vertices, vertices.faces
    except AttributeError as error:
        raise ValueError("the faces are missing; give vertices and faces, a mesh file, or a mesh that has both") from error


def load(path: str | os.PathLike[str]) -> Body:
    """Reads a baked body, a ``.frangible`` file.

    Raises:
        ValueError: No such file, or one that is none, is cut short, damaged or of another version.
    """
    return Body(_frangible.Kind.load(os.fspath(path)))


def read_mesh(path: str | os.PathLike[str]) -> tuple[Floats, Ints]:
    """Vertices (n, 3), in the file's unit, and faces (m, 3) of a mesh file: OBJ, STL, PLY, glTF or GLB.

    Raises:
        ValueError: A file that cannot be read, with the reason.
    """
    places, corners = _frangible.read_mesh(os.fspath(path))
    return rows(places, 3), corners.reshape(-1, 3).astype(np.int32)


def box(x: float, y: float, z: float) -> tuple[Floats, Ints]:
    """Vertices and faces of a box about the origin, sides in m."""
    sides = np.array([number(side, name, above=True) for side, name in ((x, "x"), (y, "y"), (z, "z"))])
    corners = np.array([[i & 1, i >> 1 & 1, i >> 2] for i in range(8)]) - 0.5
    quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
    triangles = [t for a, b, c, d in quads for t in ([a, b, c], [a, c, d])]
    return corners * sides, np.array(triangles, dtype=np.int32)


def _seed(seed: int | None) -> int | None:
    return None if seed is None else seed_of(seed)


def _of_bytes(data: bytes, scale: float, offset: ArrayLike, factors: Floats, scatter: tuple[float, float, list[float] | None]) -> Body:
    kind = _frangible.Kind.of_bytes(data)
    kind = kind if scatter == kind.scatter() else kind.with_scatter(*scatter)
    return Body(kind.with_factors(factors) if factors.size else kind, scale, offset)
