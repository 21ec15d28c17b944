"""Drops and blows that break a body into an allowed number of pieces."""

from __future__ import annotations

import hashlib
import math
from typing import Any

import numpy as np

from ..bodies import Body
from ..contacts import Contact, Striker
from ..outcomes import Outcome
from .plan import Plan

GRAVITY = 9.81
# Heights of drops, m, masses of balls, kg, and their speeds, m/s: each is as likely at every order of magnitude.
DROPS = (0.3, 3.0)
BALLS = (0.05, 1.0)
SPEEDS = (3.0, 20.0)
# A blow that gave too few pieces, or too many, is tried again so many times as fast, or as slow; between the two at their geometric mean.
STEP = 1.6


def broken(body: Body, plan: Plan, name: str, k: int) -> tuple[Outcome, dict[str, Any]]:
    """Returns a blow that breaks the body into an allowed number of pieces, and its description."""
    digest = hashlib.sha256(f"{plan.seed} {name} {k}".encode()).digest()
    rng = np.random.default_rng(list(digest))
    contact, words = _drop(body, rng) if rng.random() < 0.5 else _blow(body, rng)
    seed = int.from_bytes(digest[:4], "little")
    fewest, most = plan.pieces
    tried = []
    slow, fast = 0.0, math.inf
    share = plan.least_share
    for _ in range(plan.tries):
        outcome = body.impact(contact, seed=seed, least_share=share)
        count = len(outcome.fragments)
        tried.append(count)
        smallest = min((fragment.volume for fragment in outcome.fragments), default=0.0)
        if fewest <= count <= most and smallest < plan.least_share * body.volume:
            # The fracture reckons by whole tetrahedra, of which a piece can have a part only.
            share *= 2
            continue
        if fewest <= count <= most:
            described = {
                **words,
                "point": [float(x) for x in np.asarray(contact.point)],
                "direction": [float(x) for x in np.asarray(contact.direction)],
                "speed": contact.speed,
                "seed": seed,
            }
            if described["kind"] == "drop":
                # Of the fall that this speed is the end of; the one drawn may have been higher or lower.
                described["height"] = float(contact.speed or 0.0) ** 2 / (2 * GRAVITY)
            return outcome, {"blow": described}
        speed = float(contact.speed or 0.0)
        slow, fast = (speed, fast) if count < fewest else (slow, speed)
        between = math.sqrt(slow * fast) if 0 < slow and fast < math.inf else speed * (STEP if count < fewest else 1 / STEP)
        contact = Contact(contact.point, contact.direction, between, contact.striker)
    raise ValueError(
        f"{plan.tries} blows gave {tried} pieces, but none gave {fewest} to {most} sufficiently large pieces; widen the limits or allow more tries"
    )


def _between(rng: np.random.Generator, limits: tuple[float, float]) -> float:
    low, high = limits
    return low * math.pow(high / low, rng.random())


def _drop(body: Body, rng: np.random.Generator) -> tuple[Contact, dict[str, Any]]:
    """Returns a fall onto stone in a random orientation."""
    down = rng.normal(size=3)
    down /= np.linalg.norm(down)
    point = body.vertices[np.argmax(body.vertices @ down)]
    height = _between(rng, DROPS)
    words = {"kind": "drop", "height_drawn": height, "striker": {"material": "stone"}}
    return Contact(point, -down, math.sqrt(2 * GRAVITY * height), "stone"), words


def _blow(body: Body, rng: np.random.Generator) -> tuple[Contact, dict[str, Any]]:
    """Returns a blow of a steel ball, normal to the surface at a random point."""
    corners = body.vertices[body.faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = np.linalg.norm(normals, axis=1)
    face = rng.choice(len(areas), p=areas / areas.sum())
    weights = rng.dirichlet((1.0, 1.0, 1.0))
    mass = _between(rng, BALLS)
    words = {"kind": "ball", "striker": {"material": "steel", "mass": mass}}
    contact = Contact(weights @ corners[face], -normals[face] / areas[face], _between(rng, SPEEDS), Striker("steel", mass))
    return contact, words
