# SPDX-License-Identifier: GPL-3.0-or-later
"""Weakness that is painted as a vertex group."""

import numpy as np
from mathutils import Vector

from .bodies import barycentric, evaluated, search_tree

# Zones of a painted body at most, and how deep they reach, in edges of its tetrahedra.
MOST_ZONES = 4000
DEPTH = 1.5
# Weights below this are taken as not painted.
FAINT = 0.01


class Weakness:
    """Weights on the surface of an object, and the strength that they leave."""

    def __init__(self, shape, weights, weakest):
        self.shape, self.weights, self.weakest = shape, weights, weakest
        self.tree = search_tree(shape.vertices, shape.triangles)

    def factor(self, weight):
        """The share of the strength that is left."""
        return 1.0 - weight * (1.0 - self.weakest)

    def at(self, places):
        """The share of the strength at places, m from the object's origin."""
        found = [self.tree.find_nearest(Vector(place)) for place in places]
        points, faces = np.array([point for point, *_ in found]), [face for _, _, face, _ in found]
        corners = self.shape.triangles[faces]
        shares = barycentric(points[:, None], self.shape.vertices[corners])[:, 0]
        return self.factor(np.clip(np.einsum("ij,ij->i", shares, self.weights[corners]), 0, 1))

    def zones(self, target):
        """Balls that cover what is painted: centres (m, body's frame), their radius and the strength in each, the weakest last."""
        edge = (target.body.volume / target.body.tetrahedra * 6 * 2**0.5) ** (1 / 3)
        corners = self.shape.vertices[self.shape.triangles]
        weights = self.weights[self.shape.triangles]
        painted = weights.max(axis=1) > FAINT
        corners, weights = corners[painted], weights[painted]
        areas = 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
        apart = max(edge, (areas.sum() / MOST_ZONES) ** 0.5)
        places, found = _samples(corners, weights, apart)
        places += self.shape.origin - target.center
        # One ball per cell of a grid: small triangles give many samples.
        order = np.argsort(-found, kind="stable")
        cells = np.floor(places[order] / apart).astype(np.int64)
        _, first = np.unique(cells, axis=0, return_index=True)
        chosen = order[first]
        chosen = chosen[np.argsort(found[chosen], kind="stable")][-MOST_ZONES:]
        chosen = chosen[found[chosen] > FAINT]
        return places[chosen], DEPTH * apart, self.factor(np.clip(found[chosen], 0, 1))


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


def _samples(corners, weights, apart):
    """Places on triangles at most so far apart, m, and their weights."""
    sides = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    places, found = [], []
    for triangle, weight, side in zip(corners, weights, sides):
        parts = min(max(1, int(np.ceil(side / apart))), 400)
        i, j = np.meshgrid(np.arange(parts + 1), np.arange(parts + 1))
        inside = (i + j <= parts).ravel()
        u, v = i.ravel()[inside] / parts, j.ravel()[inside] / parts
        shares = np.stack([1 - u - v, u, v], axis=1)
        places.append(shares @ triangle)
        found.append(shares @ weight)
    return np.concatenate(places), np.concatenate(found)
