"""Contacts: strikers, and where they hit a body."""

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
    """The object that hits the body. Without a mass, it is an immovable floor.

    Attributes:
        material: Name of a material, such as ``"steel"``, ``"stone"`` or ``"wood"``, or a breakable one.
        mass: Mass, kg; infinite for an immovable striker.
        radius: Radius of curvature at the contact, m. Default: the radius of a ball with this mass; flat if the mass is infinite.
        restitution: Coefficient of restitution, 0 (no bounce) to 1. Default: the value of the material.
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
    """A contact of a body with a striker.

    Attributes:
        point: Contact point, m, in the body's frame; moved to the nearest point of the surface.
        direction: Direction in which the body is pushed, of any length.
        speed: Approach speed along the direction, m/s. Impulse, force and duration are then results.
        striker: The striker, or the name of a material for an immovable one.
        impulse: Impulse of a scripted push along the direction, N·s, instead of a speed; the force is a half-sine in time.
        duration: Duration of the scripted push, s.
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
            raise ValueError(f"{name}.direction is zero; give the direction in which the body is pushed")
        direction = direction / length
        if self.impulse is not None:
            if self.speed is not None:
                raise ValueError(f"{name} has a speed and an impulse; give only one: with a speed, the impulse is a result")
            if self.duration is None:
                raise ValueError(f"{name} has an impulse but no duration; give the duration in s")
            push = direction * number(self.impulse, f"{name}.impulse", above=True)
            lasting = number(self.duration, f"{name}.duration", above=True)
            return [*point, *direction, 0, 0, math.inf, math.inf, math.inf, 0, *push, lasting]
        if self.speed is None:
            raise ValueError(f"{name} has no speed; give a speed in m/s, or an impulse and a duration")
        if self.duration is not None:
            raise ValueError(f"{name} has a speed and a duration; omit the duration: with a speed, the duration is a result")
        speed = number(self.speed, f"{name}.speed")
        striker = Striker(self.striker) if isinstance(self.striker, str) else self.striker
        return [*point, *direction, speed, *striker._numbers(), 0, 0, 0, 0]


def rows_of(contacts: Contact | Iterable[Contact]) -> Floats:
    """Returns all contacts of one impact as a flat array."""
    given = [contacts] if isinstance(contacts, Contact) else list(contacts)
    if not given:
        raise ValueError("no contact given; give at least one")
    for contact in given:
        if not isinstance(contact, Contact):
            raise ValueError(f"{shown(contact)} is not a frangible.Contact")
    return np.array([c._row(f"contacts[{i}]") for i, c in enumerate(given)], dtype=np.float64).ravel()
