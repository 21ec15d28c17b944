"""A world of rigid bodies that break."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any

from numpy.typing import ArrayLike

from . import _frangible
from .arrays import Floats, number, rotation, seed_of, vector
from .bodies import Body

_REST = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Thing:
    """A body, piece or ball in a world.

    Attributes:
        name: Name of the thing.
        kind: ``"body"``, ``"piece"`` or ``"ball"``.
        mass: Mass, kg.
        position: (3,) centre of mass, m.
        rotation: (4,) quaternion x, y, z, w.
    """

    name: str
    kind: str
    mass: float
    position: Floats
    rotation: Floats


class World:
    """A simulation of rigid bodies that break when they collide, under gravity, y up.

        >>> import frangible as fr
        >>> cup = fr.bake(*fr.box(0.06, 0.06, 0.1), material="porcelain", wall=0.004, tetrahedra=8000, modes=60)
        >>> world = fr.World(floor="stone")
        >>> world.add(cup, position=(0, 2, 0), rotation=(0.3, 0.1, 0, 0.948683))
        >>> world.step(1.0)
        >>> len(world.things) > 1
        True

    Args:
        floor: Material of the floor at y = 0; None for no floor.
        seed: Random seed for all weak points.
        generations: Maximum number of times that pieces can break again.
        load_duration: Assumed duration of a sustained load when it begins, s. The time for which it has lasted in the world is added; static
            fatigue reduces the strength of glass under long loads.

    Raises:
        ValueError: A number or a name is invalid.
    """

    def __init__(self, floor: str | None = "stone", seed: int = 1, generations: int = 0, load_duration: float = 1.0) -> None:
        self._floor = floor
        self._seed = seed_of(seed)
        self._generations = int(number(generations, "generations"))
        self._load_duration = number(load_duration, "load_duration")
        self._bodies: list[dict[str, Any]] = []
        self._live: _frangible.LiveWorld | None = None

    def add(
        self,
        body: Body,
        position: ArrayLike,
        rotation: ArrayLike = (0.0, 0.0, 0.0, 1.0),
        velocity: ArrayLike = _REST,
        spin: ArrayLike = _REST,
        name: str | None = None,
    ) -> None:
        """Adds a body before the first step: position of its centre of mass (m), rotation (x, y, z, w), velocity (m/s) and spin (rad/s)."""
        if self._live is not None:
            raise ValueError("the simulation has already started; add bodies before the first step")
        placed = _placed(position, rotation, velocity, spin)
        self._bodies.append({"kind": body._kind, "name": name or f"{body.name} {len(self._bodies) + 1}", **placed})

    def throw(
        self, start: ArrayLike, through: ArrayLike, speed: float, mass: float = 0.1, radius: float = 0.015, material: str = "steel"
    ) -> None:
        """Throws a ball from ``start`` through ``through`` (m) at ``speed`` (m/s), compensating for gravity."""
        ends = [vector(start, "start").tolist(), vector(through, "through").tolist()]
        self._begun().throw(mass, radius, speed, material, *ends)

    def step(self, seconds: float = 1 / 60) -> None:
        """Advances the simulation. Internal steps are 1/240 s, and shorter around a break."""
        self._begun().advance(number(seconds, "seconds", above=True))

    @property
    def time(self) -> float:
        """Simulated time, s."""
        return self._begun().time

    @property
    def things(self) -> list[Thing]:
        """All bodies, pieces and balls in the world, in their current state."""
        return [Thing(*thing) for thing in self._begun().things()]

    def export(self, path: str | os.PathLike[str], rate: float = 60.0, look_from: ArrayLike = (0.55, 0.5, 1.0)) -> None:
        """Writes the simulation so far as an animated GLB with ``rate`` frames per second."""
        view = vector(look_from, "look_from").tolist()
        self._begun().export(os.fspath(path), number(rate, "rate", above=True), view)

    def _begun(self) -> _frangible.LiveWorld:
        if self._live is None:
            self._live = _frangible.LiveWorld(self._bodies, self._floor, self._seed, self._generations, self._load_duration)
        return self._live


def _placed(position: ArrayLike, turn: ArrayLike, velocity: ArrayLike, spin: ArrayLike) -> dict[str, Any]:
    return {
        "position": vector(position, "position").tolist(),
        "rotation": rotation(turn, "rotation").tolist(),
        "velocity": vector(velocity, "velocity").tolist(),
        "spin": vector(spin, "spin").tolist(),
    }
