"""What hits a body, and where."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ._frangible import striker as material_of
from .arrays import Floats, number, shown, vector


@dataclass(frozen=True)
class Striker:
    """What hits the body: a floor that does not give way, unless it has a mass.

    Attributes:
        material: A named material, such as ``"steel"``, ``"stone"``, ``"wood"`` or any that breaks.
        mass: kg; infinite for what does not give way.
        radius: Radius of curvature where it touches, m. By default that of a ball of the mass; flat without one.
        restitution: 0 (no bounce) to 1; by default the material's.
    """

    material: str = "steel"
    mass: float = math.inf
    radius: float | None = None
    restitution: float | None = None

    def _numbers(self) -> list[float]:
        modulus, pressure, usual, density = material_of(self.material)
        mass = number(self.mass, "the striker's mass", above=True, infinite=True)
        ball = (mass / density * 0.75 / math.pi) ** (1 / 3)
        radius = number(ball if self.radius is None else self.radius, "the striker's radius", above=True, infinite=True)
        bounce = number(usual if self.restitution is None else self.restitution, "the striker's restitution")
        if bounce > 1:
            raise ValueError(f"the striker's restitution is {bounce}; give a number from 0 to 1")
        return [1 / mass, radius, modulus, pressure, bounce]


@dataclass(frozen=True)
class Contact:
    """Where and how a body is hit.

    Attributes:
        point: Where, m, in the body's frame; the nearest point of the surface is taken.
        direction: Which way the body is pushed, of any length.
        speed: How fast the two approach along it, m/s. Impulse, force and duration are then results.
        striker: What hits, or the name of its material: then it does not give way.
        impulse: Instead of a speed: the impulse of a scripted push along the direction, N·s, a half-sine of the duration.
        duration: How long the scripted push lasts, s.
    """

    point: ArrayLike
    direction: ArrayLike
    speed: float | None = None
    striker: Striker | str = "steel"
    impulse: float | None = None
    duration: float | None = None

    def _row(self, name: str) -> list[float]:
        point = vector(self.point, f"{name}.point")
        direction = vector(self.direction, f"{name}.direction")
        length = float(np.linalg.norm(direction))
        if length == 0:
            raise ValueError(f"{name}.direction is zero; give the way the body is pushed")
        direction = direction / length
        if self.impulse is not None:
            if self.speed is not None:
                raise ValueError(f"{name} has a speed and an impulse; give one of them: of a blow the impulse is a result")
            if self.duration is None:
                raise ValueError(f"{name} has an impulse and no duration; give it, s")
            push = direction * number(self.impulse, f"{name}.impulse", above=True)
            lasting = number(self.duration, f"{name}.duration", above=True)
            return [*point, *direction, 0, 0, math.inf, math.inf, math.inf, 0, *push, lasting]
        if self.speed is None:
            raise ValueError(f"{name} has no speed; give it, m/s, or an impulse and a duration")
        if self.duration is not None:
            raise ValueError(f"{name} has a speed and a duration; of a blow the duration is a result")
        speed = number(self.speed, f"{name}.speed")
        striker = Striker(self.striker) if isinstance(self.striker, str) else self.striker
        return [*point, *direction, speed, *striker._numbers(), 0, 0, 0, 0]


def rows_of(contacts: Contact | Iterable[Contact]) -> Floats:
    """All contacts of one impact as one flat array."""
    given = [contacts] if isinstance(contacts, Contact) else list(contacts)
    if not given:
        raise ValueError("there is no contact; give at least one")
    for contact in given:
        if not isinstance(contact, Contact):
            raise ValueError(f"{shown(contact)} is no frangible.Contact")
    return np.array([c._row(f"contacts[{i}]") for i, c in enumerate(given)], dtype=np.float64).ravel()
