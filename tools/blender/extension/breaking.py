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
    path: list  # of (seconds after the break, place (3,) m, quaternion w, x, y, z); empty if nothing was simulated


def is_played(settings, weakness):
    """Whether the simulation finds the pieces. Else the blow alone does, which is quicker."""
    return weakness is not None or settings.motion == "KEYFRAMES"


def pieces_of(target, blow, seed, weakness, settings, seconds=None):
    """The pieces of a blow with a seed, largest first; none if the object holds."""
    if not is_played(settings, weakness):
        return _struck(target, blow, seed)
    keyed = settings.motion == "KEYFRAMES"
    recorded = play(target, blow, seed, weakness, settings.seconds if seconds is None else seconds, keyed)
    begin = min((piece.times[0] for piece in recorded), default=0.0)
    return [_of_recording(piece, target, begin, keyed) for piece in recorded]


def glimpse(target, blow, seed, weakness, settings):
    """As `pieces_of`, followed no longer than it takes to see the pieces."""
    return pieces_of(target, blow, seed, weakness, settings, SOON)


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


def _of_recording(piece, target, begin, keyed):
    linear = angular = np.zeros(3)
    if len(piece.times) > 1:
        passed = piece.times[1] - piece.times[0]
        linear = (piece.places[1] - piece.places[0]) / passed
        turned = Quaternion(piece.turns[1]) @ Quaternion(piece.turns[0]).inverted()
        axis, angle = turned.to_axis_angle()
        angle = (angle + np.pi) % (2 * np.pi) - np.pi
        angular = np.array(axis) * angle / passed
    path = [(t - begin, at, turn) for t, at, turn in zip(piece.times, piece.places, piece.turns)] if keyed else []
    return Piece(piece.vertices, piece.faces, piece.inner, piece.mass, target.center + piece.birth, linear, angular, path)
