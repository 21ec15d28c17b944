"""Outcomes of blows."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._frangible import Impact
from .arrays import Floats, Ints, number, rotation, rows, vector
from .drawn import Drawn, drawn_of

if TYPE_CHECKING:
    from .bodies import Body

_REST = (0.0, 0.0, 0.0)
_UPRIGHT = (0.0, 0.0, 0.0, 1.0)


@dataclass(frozen=True, eq=False)
class Fragment:
    """A closed piece of a broken body, at its original position in the body.

    Attributes:
        vertices: (n, 3) float64 vertices, m, in the body's frame.
        faces: (m, 3) int32 triangles, counter-clockwise seen from outside.
        neighbour: (m,) int32: for each face, the index in ``Outcome.fragments`` of the fragment on its other side, which has the same face
            reversed; -1 for a face of the body's own surface or of an earlier break.
        is_fracture_face: (m,) bool: True for each face made by a crack, in this break or an earlier one.
        mass: Mass, kg.
        volume: Volume, m³.
        center: (3,) centre of mass, m, in the body's frame.
        inertia: (3, 3) inertia tensor about the centre of mass, kg·m², in the axes of the body's frame.
        hulls: Convex parts for colliders: (k, 3) points each, m, in the body's frame.
        supported: True if the fragment is still fixed by a support.
    """

    vertices: Floats
    faces: Ints
    neighbour: Ints
    is_fracture_face: NDArray[np.bool_]
    mass: float
    volume: float
    center: Floats
    inertia: Floats
    hulls: list[Floats]
    supported: bool

    def to_trimesh(self) -> Any:
        """Returns a ``trimesh.Trimesh`` with ``neighbour`` as a face attribute."""
        return _trimesh().Trimesh(self.vertices, self.faces, face_attributes={"neighbour": self.neighbour}, process=False)


@dataclass(frozen=True)
class Motion:
    """Velocities of a body after a break.

    Attributes:
        linear: (3,) velocity of the centre of mass, m/s.
        angular: (3,) angular velocity, rad/s.
    """

    linear: Floats
    angular: Floats


class Outcome:
    """The outcome of a blow.

    Attributes:
        broke: True if the body broke into pieces.
        margin: Strength over an upper bound of the stress, which may be far above the stress itself; above 1, no crack started.
            ``Body.margin`` takes longer and gives the exact margin.
        fragments: The pieces, largest first; empty if the body did not break. Together they tile the body.
        report: Results in SI units: ``peak_stress``, ``strength``, ``fracture_energy``, ``crack_area``, ``cracks``,
            ``first_crack_time``, ``first_crack_point``, ``approach_energy``, ``peak_strain_energy``, ``contact_duration``, ``time_step``,
            ``seconds``, and ``contacts``, each with ``impulse``, ``peak_force``, ``duration``, ``contact_radius``, ``departure_speed``,
            ``crushing_energy``, ``crushed_volume`` and ``force`` at each time step. ``starts`` lists the cracks in the order in which they start, each
            with its ``time``, s, ``point``, m, the centre of its first tetrahedron, and the number of ``tetrahedra`` that it cuts.
    """

    def __init__(self, impact: Impact) -> None:
        self._impact = impact
        self.margin: float = impact.margin
        self.report: dict[str, Any] = impact.report()
        self.fragments = [_fragment(f) for f in impact.fragments()]
        self.broke = bool(self.fragments)

    def __repr__(self) -> str:
        if not self.broke:
            return f"<Outcome: held, margin {self.margin:.3g}>"
        return f"<Outcome: {len(self.fragments)} fragments, {1e4 * self.report['crack_area']:.3g} cm² of cracks>"

    def motions(
        self,
        position: ArrayLike = _REST,
        rotation_xyzw: ArrayLike = _UPRIGHT,
        linear: ArrayLike = _REST,
        angular: ArrayLike = _REST,
        striker: dict[str, Any] | None = None,
    ) -> tuple[list[Motion], Motion | None]:
        """Returns the velocities of the fragments, and of the striker, just after the break. Momentum is conserved; energy does not increase.

        Args:
            position: Position of the body's centre of mass in the world, m.
            rotation_xyzw: Rotation of the body, a quaternion.
            linear: Velocity of the body's centre of mass just before the blow, m/s.
            angular: Angular velocity of the body just before the blow, rad/s.
            striker: ``mass`` (kg) and ``position`` (m) of the striker, ``linear`` and ``angular`` velocity if not zero, and ``inertia`` (3, 3)
                in world axes or the ``radius`` of a ball.

        Returns:
            The motion of each fragment, and of the striker if one was given.

        Raises:
            ValueError: A number is invalid.
        """
        pose = np.concatenate([vector(position, "position"), rotation(rotation_xyzw, "rotation_xyzw")])
        motion = np.concatenate([vector(linear, "linear"), vector(angular, "angular")])
        row = np.zeros(0) if striker is None else _striker_row(striker)
        found = rows(self._impact.motions(pose, motion, row), 6)
        motions = [Motion(row[:3], row[3:]) for row in found]
        count = len(self.fragments)
        return motions[:count], motions[count] if striker is not None and len(motions) > count else None

    def drawn(self, number: int) -> Drawn:
        """Returns the mesh of a fragment to draw, in the body's frame, with the looks of the file that was baked (``Body.looks``).

        Raises:
            ValueError: The fragment does not exist.
        """
        if not 0 <= number < len(self.fragments):
            raise ValueError(f"there is no fragment {number}; there are {len(self.fragments)}")
        return drawn_of(self._impact.drawn(number))

    def piece(self, number: int) -> Body:
        """Returns a fragment as a body with its own vibration modes, which can break again.

        The origin of its frame is the fragment's centre of mass: a point p in the frame of the parent body is at ``p - fragment.center``. The
        piece keeps the seed, the weak points and the incomplete cracks of the parent body.

        Raises:
            ValueError: The fragment does not exist, or is too small for vibration modes.
        """
        from .bodies import Body

        return Body(self._impact.piece(number), 1.0, -self.fragments[number].center)

    def to_trimesh(self) -> Any:
        """Returns a ``trimesh.Scene`` of all fragments."""
        meshes = {f"piece_{i}": fragment.to_trimesh() for i, fragment in enumerate(self.fragments)}
        return _trimesh().Scene(meshes)


def _striker_row(striker: dict[str, Any]) -> Floats:
    unknown = set(striker) - {"mass", "position", "linear", "angular", "inertia", "radius"}
    if unknown:
        raise ValueError(f"the striker has the unknown keys {sorted(unknown)}; the keys are mass, position, linear, angular, inertia and radius")
    mass = number(striker.get("mass", np.nan), "the striker's mass", above=True)
    if "inertia" in striker:
        inertia = vector(np.asarray(striker["inertia"], dtype=np.float64).ravel(), "the striker's inertia", 9)
    else:
        inertia = (0.4 * mass * number(striker.get("radius", 0.05), "the striker's radius", above=True) ** 2 * np.eye(3)).ravel()
    place = vector(striker.get("position", np.nan), "the striker's position")
    moves = [vector(striker.get(name, _REST), f"the striker's {name}") for name in ("linear", "angular")]
    return np.concatenate([[mass], place, inertia, *moves])


def _fragment(given: dict[str, Any]) -> Fragment:
    return Fragment(
        vertices=rows(given["vertices"], 3),
        faces=given["faces"].reshape(-1, 3).astype(np.int32),
        neighbour=given["neighbour"],
        is_fracture_face=np.arange(len(given["neighbour"])) >= given["outer_faces"],
        mass=given["mass"],
        volume=given["volume"],
        center=given["center"],
        inertia=rows(given["inertia"], 3),
        hulls=[rows(hull, 3) for hull in given["hulls"]],
        supported=given["supported"],
    )


def _trimesh() -> Any:
    try:
        import trimesh
    except ImportError as error:
        raise ImportError("this needs trimesh: pip install trimesh") from error
    return trimesh
