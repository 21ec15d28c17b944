# SPDX-License-Identifier: GPL-3.0-or-later
"""The pieces of a broken body in the world, with their velocities or paths."""

from dataclasses import dataclass

import numpy as np

from .played import SOON, play


@dataclass
class Piece:
    """A closed piece at its original position in the object."""

    vertices: np.ndarray  # (n, 3) from its centre of mass, m, along the world's axes
    faces: np.ndarray  # (m, 3)
    inner: np.ndarray  # (m,) whether a crack made the face
    mass: float  # kg
    center: np.ndarray  # (3,) its centre of mass in the world before the break, m
    # Of a blow alone: its velocity just after the break, m/s and rad/s.
    linear: np.ndarray | None = None
    angular: np.ndarray | None = None
    # Of the simulation: (seconds after the blow, place (3,) m, quaternion w, x, y, z).
    path: list | None = None


def pieces_of(target, blow, seed, settings, seconds=SOON):
    """Returns the pieces of a blow, largest first; none if the object does not break. `seconds` is the length of the keyframes."""
    if settings.motion == "KEYFRAMES":
        return [_of_recording(piece, target) for piece in play(target, blow, seed, seconds)]
    return _struck(target, blow, seed)


def _struck(target, blow, seed):
    outcome = target.body.impact(blow.contact(target.center), seed)
    if not outcome.broke:
        return []
    ball = {
        "mass": blow.mass,
        "radius": blow.radius,
        "position": blow.point + blow.radius * blow.normal,
        "linear": blow.speed * blow.direction,
    }
    motions, _ = outcome.motions(position=target.center, striker=ball)
    return [
        Piece(f.vertices - f.center, f.faces, f.is_fracture_face, f.mass, target.center + f.center, m.linear, m.angular)
        for f, m in zip(outcome.fragments, motions)
    ]


def _of_recording(piece, target):
    path = [moment for moment in zip(piece.times, piece.places, piece.turns) if moment[0] > 0]
    return Piece(piece.vertices, piece.faces, piece.inner, piece.mass, target.center + piece.birth, path=path)
