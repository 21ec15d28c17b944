# SPDX-License-Identifier: GPL-3.0-or-later
"""The blow on an object, placed by the 3D cursor or an empty."""

from dataclasses import dataclass

import frangible as fr
import numpy as np
from mathutils import Vector

from .bodies import search_tree

# How far the 3D cursor may be from the surface, as a share of the object's longest side.
NEAR = 0.1


@dataclass
class Blow:
    """A blow in the world, in metres."""

    point: np.ndarray  # (3,) on the surface
    direction: np.ndarray  # (3,) of unit length, into the object
    normal: np.ndarray  # (3,) of unit length, outwards
    mass: float
    radius: float
    material: str
    speed: float

    def contact(self, center):
        """Returns the blow in the frame of a body with this centre of mass."""
        ball = fr.Striker(self.material, mass=self.mass, radius=self.radius)
        return fr.Contact(self.point - center, self.direction, speed=self.speed, striker=ball)


def blow_of(context, thing, shape):
    """Returns the blow set in the panel. Raises ValueError if it is invalid."""
    settings = context.scene.frangible
    for name, value, unit in (("mass", settings.mass, "kg"), ("radius", settings.radius, "m"), ("speed", settings.speed, "m/s")):
        if not (np.isfinite(value) and value > 0):
            raise ValueError(f"The striker's {name} is {value:g} {unit}; it must be above zero.")
    find = _by_cursor if settings.place == "CURSOR" else _by_empty
    point, normal, direction = find(context, thing, shape, search_tree(shape.world, shape.triangles))
    if direction.dot(normal) > -0.05:
        raise ValueError(f"The blow goes along the surface of {thing.name} or out of it; turn it inwards.")
    arrays = (np.array(vector, dtype=np.float64) for vector in (point, direction, normal))
    return Blow(*arrays, settings.mass, settings.radius, settings.striker, settings.speed)


def _outward(tree, point, normal, size):
    """The normal, turned round where the face is: from outside a ray meets an even number of faces."""
    step = 1e-5 * size * normal
    start, crossed = point + step, 0
    for _ in range(64):
        hit, _, _, _ = tree.ray_cast(start, normal)
        if hit is None:
            break
        crossed += 1
        start = hit + step
    return normal if crossed % 2 == 0 else -normal


def _by_cursor(context, thing, shape, tree):
    cursor = context.scene.cursor.location * shape.unit
    point, normal, _, distance = tree.find_nearest(cursor)
    if point is None or distance > NEAR * shape.size:
        away = "far" if point is None else f"{distance:.3g} m"
        raise ValueError(f"The 3D cursor is {away} from the surface of {thing.name}; place it on the surface with Shift and the right mouse button.")
    normal = _outward(tree, point, normal, shape.size)
    return point, normal, -normal


def _by_empty(context, thing, shape, tree):
    empty = context.scene.frangible.empty
    if empty is None:
        raise ValueError("No empty is chosen; pick one in the field Empty, or use the 3D cursor.")
    matrix = empty.matrix_world
    way = matrix.to_3x3() @ Vector((0, 0, -1))
    if way.length == 0:
        raise ValueError(f"The empty {empty.name} has zero scale; set its scale above zero.")
    way.normalize()
    point, normal, _, _ = tree.ray_cast(matrix.translation * shape.unit, way)
    if point is None:
        raise ValueError(f"The -Z axis of {empty.name} misses {thing.name}; turn the empty towards it.")
    return point, _outward(tree, point, normal, shape.size), way
