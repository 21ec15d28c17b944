# SPDX-License-Identifier: GPL-3.0-or-later
"""Weakness painted with a vertex group."""

from dataclasses import replace

import numpy as np
from mathutils import Vector

from .bodies import barycentric, evaluated, search_tree

# Weights below this are taken as not painted.
FAINT = 0.01


class Weakness:
    """Weights on the surface of an object, and the strength that they leave."""

    def __init__(self, shape, weights, weakest):
        self.shape, self.weights, self.weakest = shape, weights, weakest
        self.tree = search_tree(shape.vertices, shape.triangles)

    def at(self, places):
        """The share of the strength that is left at places, m from the object's origin: that of the nearest place of the surface."""
        found = [self.tree.find_nearest(Vector(place)) for place in places]
        points, faces = np.array([point for point, *_ in found]), [face for _, _, face, _ in found]
        corners = self.shape.triangles[faces]
        shares = barycentric(points[:, None], self.shape.vertices[corners])[:, 0]
        weights = np.clip(np.einsum("ij,ij->i", shares, self.weights[corners]), 0, 1)
        return 1.0 - weights * (1.0 - self.weakest)

    def weakened(self, target):
        """The target with a body that is weak where it is painted."""
        left = self.at(target.body.vertices + target.center - target.shape.origin)
        return replace(target, body=target.body.weakened(strength=left), left=left)


def weakness_of(context, thing, shape):
    """The painted weakness of an object, or None; ValueError where the group is missing."""
    settings = context.scene.frangible
    if not settings.weakness:
        return None
    group = thing.vertex_groups.get(settings.weakness)
    if group is None:
        raise ValueError(f"{thing.name} has no vertex group {settings.weakness}; pick one of its groups, or clear the field Weak where.")
    with evaluated(context, thing) as (_, mesh):
        weights = np.zeros(len(mesh.vertices))
        for vertex in mesh.vertices:
            for element in vertex.groups:
                if element.group == group.index:
                    weights[vertex.index] = element.weight
    if weights.max(initial=0) <= FAINT:
        raise ValueError(f"The vertex group {group.name} of {thing.name} has no weight anywhere; paint some, or clear the field Weak where.")
    return Weakness(shape, weights, settings.weakest)
