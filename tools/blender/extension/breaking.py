# SPDX-License-Identifier: GPL-3.0-or-later
"""What a blow makes of a body: pieces in the world, with their velocities or their paths."""

from dataclasses import dataclass

import numpy as np
from mathutils import Quaternion

from .played import SOON, play


@dataclass
class Piece:
    """A closed piece where it was in the object."""

    vertices: np.ndarray  # (n, 3) from its centre of mass, m, along the world's axes
    faces: np.ndarray  # (m, 3)
    inner: np.ndarray  # (m,) whether a crack made the face
    mass: float  # kg
    center: np.ndarray  # (3,) its centre of mass in the world before the break, m
    linear: np.ndarray  # (3,) velocity just after the break, m/s
    angular: np.ndarray  # (3,) rad/s
    path: list  # of (seconds after the blow, place (3,) m, quaternion w, x, y, z); empty if nothing was simulated


def is_played(settings, weakness):
    """Whether the simulation finds the pieces. Else the blow alone does, which is quicker."""
    return weakness is not None or settings.motion == "KEYFRAMES"


def pieces_of(target, blow, seed, weakness, settings, seconds=SOON):
    """The pieces of a blow with a seed, largest first; none if the object holds. Keyframes go on for so many seconds."""
    if not is_played(settings, weakness):
        return _struck(target, blow, seed)
    keyed = settings.motion == "KEYFRAMES"
    recorded, came = play(target, blow, seed, weakness, seconds, keyed)
    return [_of_recording(piece, target, came, keyed) for piece in recorded]


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
        Piece(f.vertices - f.center, f.faces, f.is_fracture_face, f.mass, target.center + f.center, m.linear, m.angular, [])
        for f, m in zip(outcome.fragments, motions)
    ]


def _of_recording(piece, target, came, keyed):
    linear = angular = np.zeros(3)
    first = int(np.searchsorted(piece.times, piece.broke - 1e-6))
    if len(piece.times) > first + 1:
        passed = piece.times[first + 1] - piece.times[first]
        linear = (piece.places[first + 1] - piece.places[first]) / passed
        turned = Quaternion(piece.turns[first + 1]) @ Quaternion(piece.turns[first]).inverted()
        axis, angle = turned.to_axis_angle()
        angle = (angle + np.pi) % (2 * np.pi) - np.pi
        angular = np.array(axis) * angle / passed
    moves = zip(piece.times, piece.places, piece.turns)
    path = [(t - came, at, turn) for t, at, turn in moves if t > came] if keyed else []
    return Piece(piece.vertices, piece.faces, piece.inner, piece.mass, target.center + piece.birth, linear, angular, path)
