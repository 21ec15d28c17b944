"""What came of a blow."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._frangible import Impact
from .arrays import Floats, Ints, number, rotation, rows, vector

if TYPE_CHECKING:
    from .bodies import Body

_REST = (0.0, 0.0, 0.0)
_UPRIGHT = (0.0, 0.0, 0.0, 1.0)


@dataclass(frozen=True, eq=False)
class Fragment:
    """A closed piece of a broken body, where it was in the body.

    Attributes:
        vertices: (n, 3) float64, m, in the body's frame.
        faces: (m, 3) int32, counter-clockwise seen from outside.
        neighbour: (m,) int32: of each face the fragment on its other side, by its place in ``Outcome.fragments``; -1 where the face is of
            the body's own surface or was made by an earlier break. That fragment has the same face, turned round.
        is_fracture_face: (m,) bool: whether each face was made by a crack, of this break or an earlier one.
        mass: kg.
        volume: m³.
        center: (3,) centre of mass, m, in the body's frame.
        inertia: (3, 3) about the centre, kg·m², axes of the body's frame.
        hulls: Convex parts for colliders: (k, 3) points each, m, in the body's frame.
        supported: Whether something outside still holds it.
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
        """A ``trimesh.Trimesh``, with ``neighbour`` among its face attributes."""
        return _trimesh().Trimesh(self.vertices, self.faces, face_attributes={"neighbour": self.neighbour}, process=False)


@dataclass(frozen=True)
class Motion:
    """How something moves after a break.

    Attributes:
        linear: (3,) velocity of the centre of mass, m/s.
        angular: (3,) rad/s.
    """

    linear: Floats
    angular: Floats


class Outcome:
    """What came of a blow.

    Attributes:
        broke: Whether the body is in pieces now.
        margin: Strength over a bound of the stress, which may be far above the stress itself: above 1 nothing happened. ``Body.margin``
            takes longer and gives the margin itself.
        fragments: The pieces, largest first; none if the body held. Together they tile the body.
        report: Numbers of the blow, SI: ``peak_stress``, ``strength``, ``fracture_energy``, ``crack_area``, ``cracks``,
            ``first_crack_time``, ``first_crack_point``, ``approach_energy``, ``peak_strain_energy``, ``contact_duration``, ``time_step``,
            ``seconds``, and ``contacts``: of each ``impulse``, ``peak_force``, ``duration``, ``contact_radius``, ``departure_speed``,
            ``crushing_energy``, ``crushed_volume`` and ``force`` at each time step. ``starts`` are the cracks in the order in which they start:
            ``time``, s, ``point``, m, the centre of its first tetrahedron, and how many ``tetrahedra`` each cuts.
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
        """How the fragments move just afterwards, and the striker: momentum stays, energy does not rise.

        Args:
            position: Where the body's centre of mass is in the world, m.
            rotation_xyzw: How the body is turned, a quaternion.
            linear: Velocity of its centre of mass just before, m/s.
            angular: rad/s.
            striker: ``mass`` (kg), ``position`` (m) and, if they are not zero, ``linear`` and ``angular`` of what hit it; ``inertia`` (3, 3)
                in world axes or ``radius`` of a ball.

        Returns:
            The motion of each fragment, and that of the striker if one was given.

        Raises:
            ValueError: A number that cannot be used.
        """
        pose = np.concatenate([vector(position, "position"), rotation(rotation_xyzw, "rotation_xyzw")])
        motion = np.concatenate([vector(linear, "linear"), vector(angular, "angular")])
        row = np.zeros(0) if striker is None else _striker_row(striker)
        found = rows(self._impact.motions(pose, motion, row), 6)
        motions = [Motion(row[:3], row[3:]) for row in found]
        count = len(self.fragments)
        return motions[:count], motions[count] if striker is not None and len(motions) > count else None

    def piece(self, number: int) -> Body:
        """A fragment as a body that breaks again, with vibration modes of its own.

        Its frame has its origin at the fragment's centre of mass: a place p in the frame of this body is at ``p - fragment.center``. It has
        the seed of this body, its weak points and the cracks that part nothing.

        Raises:
            ValueError: No such fragment, or one that is too small to have modes.
        """
        from .bodies import Body

        return Body(self._impact.piece(number), 1.0, -self.fragments[number].center)

    def to_trimesh(self) -> Any:
        """A ``trimesh.Scene`` of all fragments."""
        meshes = {f"piece_{i}": fragment.to_trimesh() for i, fragment in enumerate(self.fragments)}
        return _trimesh().Scene(meshes)


def _striker_row(striker: dict[str, Any]) -> Floats:
    unknown = set(striker) - {"mass", "position", "linear", "angular", "inertia", "radius"}
    if unknown:
        raise ValueError(f"the striker has {sorted(unknown)}; there are mass, position, linear, angular, inertia and radius")
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
