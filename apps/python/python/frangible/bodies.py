"""Bodies: baking a mesh with a material, and breaking the result."""

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
from .drawn import Drawn, Looks, drawn_of, looks_of
from .outcomes import Outcome
from .weakness import Factor, factors_of

Contacts = Contact | Iterable[Contact]


@dataclass(frozen=True)
class Fatigue:
    """Static fatigue: the strength of glass and ceramics falls with the duration of a load, because flaws grow slowly in air.

    Attributes:
        exponent: Exponent n of the law of slow crack growth, above 2: glass 16, porcelain 20 to 40.
        rate: Stress rate of the slow strength test, Pa/s.
        increase: Inert strength, which is the strength of the material, over the strength in the slow test; above 1.
    """

    exponent: float
    rate: float
    increase: float

    def _numbers(self) -> list[float]:
        return [number(value, f"fatigue.{name}") for name, value in vars(self).items()]


class Body:
    """A kind of body that can be broken: its mesh of tetrahedra, its vibration modes and its material.

    A body is immutable: every blow acts on the intact body, with weak points drawn from the given seed.

    Attributes:
        name: Name of the body.
        material: Name of its material.
        strength: Tensile strength of its material, Pa.
        supported: True if part of it is fixed by supports.
        mass: Mass, kg.
        volume: Volume, m³.
        center: (3,) centre of mass, m: the origin of the body's frame.
        inertia: (3, 3) inertia tensor about the centre of mass, kg·m².
        vertices: (n, 3) nodes of the tetrahedra, m, in the body's frame; for a piece, the vertices of its surface.
        faces: (m, 3) int32 triangles of the surface.
        tetrahedra: Number of tetrahedra.
        frequencies: (k,) frequencies of the vibration modes in ascending order, Hz.
        scale: Scale factor from the mesh from which it was baked to the body.
        offset: (3,) offset, m: a point p of that mesh is at ``scale * p + offset`` in the body's frame.
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
        """Mass-normalised mode shapes: (k, n, 3) displacement of each vertex in each mode, 1/√kg."""
        return np.stack([rows(self._kind.mode(i), 3) for i in range(len(self.frequencies))])

    @property
    def drawn(self) -> Drawn:
        """The mesh to draw, in the body's frame: as its author drew it, if it was baked from a file.

        Raises:
            ValueError: The body is a piece; ``Outcome.drawn`` has its mesh.
        """
        return drawn_of(self._kind.drawn())

    @property
    def looks(self) -> Looks | None:
        """Name, materials and images of the file that was baked; fragments have them, too. ``None`` if it was baked from arrays."""
        given = self._kind.looks()
        return None if given is None else looks_of(given)

    def weakened(
        self,
        strength: Factor | None = None,
        toughness: Factor | None = None,
        weak_points: Factor | None = None,
        groove: Factor | None = None,
    ) -> Body:
        """Returns this body with locally varying strength, toughness or density of weak points.

        Each argument is a factor on the material's value: a number, an array (n,) with one factor for each of ``vertices``, or a function. With
        an array, each tetrahedron gets the mean of its four vertices. A function receives the centroids of all tetrahedra, (t, 3), m, in the
        body's frame, and returns an array (t,).

            >>> import frangible as fr
            >>> bar = fr.bake(*fr.box(0.3, 0.03, 0.03), material="porcelain", tetrahedra=4000, modes=40)
            >>> blow = fr.Contact(point=(0, 0, 0.015), direction=(0, 0, -1), speed=5.0, striker=fr.Striker(mass=0.2))
            >>> weak = bar.weakened(strength=lambda places: 1 - 0.7 * (abs(places[:, 0] - 0.06) < 0.02))
            >>> weak.minimum_speed(blow) < bar.minimum_speed(blow)
            True

        Blows, worlds, pieces and pickles of the new body use the factors; a ``.frangible`` file cannot store them. If a weakened body is weakened
        again, the factors multiply.

        Args:
            strength: Factor on the tensile strength, above 0.
            toughness: Factor on the fracture energy, above 0. Default: the square of the strength factor, which leaves the flaw size unchanged.
            weak_points: Factor on the density of weak points, from 0; where it is 0, no crack starts.
            groove: Depth of a groove in the surface, m, from 0 (no groove). A groove is a flaw of its depth: it sets the strength and the
                toughness in place of their factors.

        Raises:
            ValueError: A factor is out of bounds or has the wrong shape, or the body is a piece, which keeps the factors of its parent body.
        """
        tets = self._kind.tets().reshape(-1, 4)

        def of_tets(given: Factor | None, name: str, *, zero: bool = False) -> Floats:
            return np.ones(len(tets)) if given is None else factors_of(given, name, self.vertices, tets, zero=zero)

        strong = of_tets(strength, "strength")
        tough = strong**2 if toughness is None else of_tets(toughness, "toughness")
        deep = np.zeros(len(tets)) if groove is None else of_tets(groove, "groove", zero=True)
        factors = np.stack([strong, tough, of_tets(weak_points, "weak_points", zero=True), deep], axis=1)
        before = self._kind.factors()
        if before.size:
            factors[:, :3] *= rows(before, 4)[:, :3]
            factors[:, 3] = np.where(deep > 0, deep, rows(before, 4)[:, 3])
        return Body(self._kind.with_factors(factors.ravel()), self.scale, self.offset)

    def scattered(self, weibull_modulus: float | None = None, specimen: float | None = None, fatigue: Fatigue | None = None) -> Body:
        """Returns this body with another scatter of strength. Omitted arguments keep their values, which a bake takes from the material.

            >>> import frangible as fr
            >>> pane = fr.bake(*fr.box(0.2, 0.2, 0.008), material="glass", tetrahedra=4000, modes=40)
            >>> even = pane.scattered(weibull_modulus=50)

        A ``.frangible`` file cannot store the scatter, just as with :meth:`weakened`.

        Args:
            weibull_modulus: Weibull modulus, from 1: glass 7, brick 6, fine ceramics 10 to 20; a lower value means more scatter. 0 means none.
            specimen: Volume of the test specimens that have the strength of the material, m³; with scatter, larger bodies are weaker.
            fatigue: Static fatigue: the decrease of strength with the duration of a load.

        Raises:
            ValueError: A number is invalid, or the body is a piece, which keeps the scatter of its parent body.
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
        """Computes the outcome of a blow on the intact body.

        Args:
            contacts: All contacts of the blow, in the body's frame.
            seed: Random seed for the weak points and the roughness of the cracks, default 1; a piece uses the seed of its parent body.
            least_share: Smallest volume of a piece, as a share of the body's volume; smaller pieces stay with a neighbour. Default 2e-4.

        Raises:
            ValueError: A number is invalid.
        """
        share = None if least_share is None else number(least_share, "least_share")
        return Outcome(self._kind.impact(rows_of(contacts), _seed(seed), share))

    def would_break(self, contacts: Contacts, seed: int | None = None) -> bool:
        """Returns True if a blow breaks the body. Faster than :meth:`impact`, because no pieces are made."""
        return self._kind.would_break(rows_of(contacts), _seed(seed))

    def margin(self, contacts: Contacts, seed: int | None = None) -> float:
        """Returns strength over the largest stress at a weak point during a blow; above 1, no crack starts."""
        return self._kind.margin(rows_of(contacts), _seed(seed))

    def minimum_speed(self, contacts: Contacts, seed: int | None = None, tolerance: float = 0.01) -> float:
        """Finds the lowest approach speed at which the blow breaks the body.

        Args:
            contacts: Contacts of the blow; their speeds are ignored.
            seed: Random seed for the weak points.
            tolerance: Relative tolerance of the speed.

        Returns:
            The speed, m/s; infinity if 1000 m/s do not break the body.
        """
        share = number(tolerance, "tolerance", above=True)
        return self._kind.minimum_speed(rows_of(contacts), _seed(seed), share)

    def stress(self, contacts: Contacts, time: float | None = None, seed: int | None = None) -> tuple[Floats, Floats]:
        """Computes the stress on the surface during a blow without cracks.

        Args:
            contacts: The blow.
            time: Time since the start of the blow, s; the nearest time step is returned. Default: all time steps.
            seed: Random seed for the weak points, which set the flaw depths.

        Returns:
            Times (t,), s, and the largest principal tensile stress (t, m) on each face at these times, Pa; NaN where there is no flaw.
        """
        wanted = None if time is None else number(time, "time")
        times, tensions = self._kind.stress(rows_of(contacts), _seed(seed), wanted)
        return times, tensions.reshape(len(times), -1)

    def to_bytes(self) -> bytes:
        """Returns the contents of a ``.frangible`` file of the body.

        Raises:
            ValueError: The body is a piece, is weakened, or has another scatter than its material; such bodies cannot be stored in a file.
        """
        data = self._kind.to_bytes()
        if self._kind.factors().size:
            raise ValueError("a .frangible file cannot store weakness; save the body before it is weakened, or pickle this one")
        if self._kind.scatter() != _frangible.Kind.of_bytes(data).scatter():
            raise ValueError("a .frangible file cannot store scatter; save the body before its scatter is changed, or pickle this one")
        return data

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a ``.frangible`` file of the body. The write is atomic."""
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
    parts: str | None = None,
    gap: float | None = None,
    progress: Callable[[str, float], object] | None = None,
) -> Body:
    """Bakes a mesh into a body that can break. Takes seconds and can be interrupted with Ctrl-C.

    A mesh of several separate parts is refused, unless ``parts`` chooses one body; :func:`bake_parts` makes a body of each.

    Args:
        vertices: Array (n, 3), or the path of a mesh file (OBJ, STL, PLY, glTF, GLB), or an object with ``vertices`` and ``faces``, such as a
            ``trimesh.Trimesh``. Fragments keep the looks of a file: see ``Outcome.drawn`` and ``Body.looks``.
        faces: Array (m, 3) of vertex indices. Split or duplicate vertices, duplicate or inverted faces, and holes are repaired.
        material: Name of a material: ``glass`` (with handling damage; also ``glass-new``, ``glass-abraded``; for panes ``tempered-glass``,
            ``heat-strengthened-glass``, ``laminated-glass``), ``porcelain``, ``brick``, ``concrete``, ``chocolate`` …
        name: Name of the body.
        size: Length of the longest side, m. Default: the mesh is in metres.
        wall: Make a wall of this thickness, m, along the mesh instead of a solid body.
        tetrahedra: Approximate number of tetrahedra of the fracture mesh. More are finer and slower. Default 42 000; 1500 suffice for games.
        modes: Number of vibration modes to keep.
        supports: Regions in which the body is fixed, in the mesh's frame after scaling to ``size``: ``"below:z:0.01"``, ``"box:0,0,0,0.1,0.1,0.1"``,
            ``"sphere:0,0,0,0.02"``; append ``"@xy"`` to fix x and y only.
        seed: Random seed for the irregularity of the tetrahedra.
        parts: What to make of several parts: ``"largest"`` for the largest alone, ``"weld"`` for one body of all.
        gap: With ``"weld"``, fill gaps between the parts up to this width, m. Default: only parts that touch.
        progress: Called with the name of the current stage and its completed share; an exception from it cancels the bake.

    Raises:
        ValueError: The mesh does not describe a solid, or describes several, or a number is invalid.
    """
    (body,) = _baked(vertices, faces, material, name, size, wall, tetrahedra, modes, supports, seed, progress, parts, gap, single=True)
    return body


def bake_parts(
    vertices: ArrayLike | str | os.PathLike[str] | Any,
    faces: ArrayLike | None = None,
    *,
    material: str = "glass",
    name: str = "body",
    size: float | None = None,
    tetrahedra: int | None = None,
    modes: int | None = None,
    supports: str | Sequence[str] = (),
    seed: int = 1,
    parts: str | None = None,
    gap: float | None = None,
    progress: Callable[[str, float], object] | None = None,
) -> list[Body]:
    """Bakes each separate part of a mesh into a body of its own.

    Parts that overlap are one body, and so are layers that share faces, unless ``parts`` is ``"separate"``. Parts below 1 % of the volume are left
    out. Each body has the name of its part in the file. ``body.offset`` places it: the point p of the mesh is at ``body.scale * p + body.offset`` in
    the body's frame, so that ``-body.offset`` is where the body's centre stands in a world, if the mesh is in metres.

        >>> import frangible as fr
        >>> import numpy as np
        >>> places, corners = fr.box(0.1, 0.1, 0.02)
        >>> two = np.concatenate([places, places + (0.15, 0, 0)]), np.concatenate([corners, corners + len(places)])
        >>> left, right = fr.bake_parts(*two, tetrahedra=2000, modes=10)
        >>> bool(abs(left.offset[0] - right.offset[0] - 0.15) < 1e-3)
        True

    Args:
        vertices: As in :func:`bake`.
        faces: As in :func:`bake`.
        material: Name of the material of all parts.
        name: Name of the body, if the mesh is one part.
        size: Length of the longest side of the whole mesh, m. Default: the mesh is in metres.
        tetrahedra: Approximate number of tetrahedra in all; the parts share it by their volumes, with at least 1000 each. Default 42 000.
        modes: Number of vibration modes that each body keeps.
        supports: Regions in which the bodies are fixed, as in :func:`bake`. Each must contain a piece of every part.
        seed: Random seed for the irregularity of the tetrahedra.
        parts: ``"separate"`` makes a body also of each layer, ``"largest"`` only of the largest, ``"weld"`` one of all.
        gap: With ``"weld"``, fill gaps between the parts up to this width, m. Default: only parts that touch.
        progress: Called with the name of the current stage and its completed share, for one part after the other.

    Raises:
        ValueError: A part does not describe a solid, there are more than 100, or a number is invalid.
    """
    return _baked(vertices, faces, material, name, size, None, tetrahedra, modes, supports, seed, progress, parts, gap, single=False)


def _baked(
    vertices: Any,
    faces: ArrayLike | None,
    material: str,
    name: str,
    size: float | None,
    wall: float | None,
    tetrahedra: int | None,
    modes: int | None,
    supports: str | Sequence[str],
    seed: int,
    progress: Callable[[str, float], object] | None,
    parts: str | None,
    gap: float | None,
    *,
    single: bool,
) -> list[Body]:
    groups: list[tuple[str, int, int]] = []
    path = None
    if faces is None and isinstance(vertices, str | os.PathLike):
        path, places, corners = os.fspath(vertices), np.zeros((0, 3)), np.zeros((0, 3), dtype=np.uint32)
    else:
        places, corners = mesh(*_both(vertices, faces))
    for what, value in (("size", size), ("wall", wall)):
        if value is not None:
            number(value, what, above=True)
    if gap is not None:
        number(gap, "gap")
    for what, count in (("tetrahedra", tetrahedra), ("modes", modes)):
        if count is not None and (int(count) != count or count < 1):
            raise ValueError(f"{what} is {count!r}; give a whole number from 1")
    held, seeded = strings(supports), seed_of(seed)
    wanted = name, material, size, wall, tetrahedra, modes, held, seeded, progress, groups, parts, gap, single, path
    return [Body(*baked) for baked in _frangible.bake(places.ravel(), corners.ravel(), *wanted)]


def _both(vertices: Any, faces: ArrayLike | None) -> tuple[ArrayLike, ArrayLike]:
    """Returns vertices and faces from arrays, a file, or an object that has both."""
    if faces is not None:
        return vertices, faces
    if isinstance(vertices, str | os.PathLike):
        return read_mesh(vertices)
    try:
        return vertices.vertices, vertices.faces
    except AttributeError as error:
        raise ValueError("the faces are missing; give vertices and faces, a mesh file, or an object that has both") from error


def load(path: str | os.PathLike[str]) -> Body:
    """Reads a baked body, a ``.frangible`` file.

    Raises:
        ValueError: The file does not exist, is not a baked body, is truncated or damaged, or has another format version.
    """
    return Body(_frangible.Kind.load(os.fspath(path)))


def read_mesh(path: str | os.PathLike[str]) -> tuple[Floats, Ints]:
    """Reads the vertices (n, 3), in the file's unit, and the faces (m, 3) of a mesh file: OBJ, STL, PLY, glTF or GLB.

    Raises:
        ValueError: The file cannot be read; the message gives the reason.
    """
    places, corners, _ = _frangible.read_mesh(os.fspath(path))
    return rows(places, 3), corners.reshape(-1, 3).astype(np.int32)


def box(x: float, y: float, z: float) -> tuple[Floats, Ints]:
    """Returns the vertices and faces of a box centred on the origin, with sides in m."""
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
