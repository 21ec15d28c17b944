"""Surfaces as (vertices, polygons): generated ones, and OBJ files in and out."""

from itertools import product

import numpy as np

SPHERE_LEVEL = 3  # subdivisions: 1280 triangles
WALL = 0.05  # of the hollow sphere of radius 1 m
LATTICE = 7  # voxels per side; odd, so that struts end on both sides
HOLLOW_INSIDE = (0.0, 0.0, 0.0)  # a point in the cavity of the hollow sphere


def box(low, high):
    """Six outward quads."""
    vertices = [[(low, high)[i][0], (low, high)[j][1], (low, high)[k][2]] for k, j, i in product((0, 1), repeat=3)]
    quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
    return np.array(vertices, float), quads


def sphere(radius=1.0, level=SPHERE_LEVEL):
    """Subdivided icosahedron."""
    golden = (1 + 5**0.5) / 2
    vertices = [[-1, golden, 0], [1, golden, 0], [-1, -golden, 0], [1, -golden, 0]]
    vertices += [[0, -1, golden], [0, 1, golden], [0, -1, -golden], [0, 1, -golden]]
    vertices += [[golden, 0, -1], [golden, 0, 1], [-golden, 0, -1], [-golden, 0, 1]]
    vertices = [np.array(v) / np.linalg.norm(v) for v in vertices]
    triangles = [[0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11], [1, 5, 9], [5, 11, 4]]
    triangles += [[11, 10, 2], [10, 7, 6], [7, 1, 8], [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8]]
    triangles += [[3, 8, 9], [4, 9, 5], [2, 4, 11], [6, 2, 10], [8, 6, 7], [9, 8, 1]]
    for _ in range(level):
        middles = {}

        def middle(a, b):
            key = (min(a, b), max(a, b))
            if key not in middles:
                middles[key] = len(vertices)
                sum_of_ends = vertices[a] + vertices[b]
                vertices.append(sum_of_ends / np.linalg.norm(sum_of_ends))
            return middles[key]

        finer = []
        for a, b, c in triangles:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            finer += [[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]
        triangles = finer
    return radius * np.array(vertices), triangles


def join(first, second):
    """Both in one, sharing no vertex."""
    count = len(first[0])
    return np.vstack([first[0], second[0]]), first[1] + [[i + count for i in face] for face in second[1]]


def hollow_sphere():
    vertices, triangles = sphere(1.0 - WALL)
    return join(sphere(), (vertices, [face[::-1] for face in triangles]))


def open_sphere():
    """A tenth of the height cut off at the top."""
    vertices, triangles = sphere()
    return vertices, [face for face in triangles if vertices[face, 2].mean() < 0.8]


def lattice(side=LATTICE):
    """Struts along the edges of a cubic grid, as the faces between full and empty voxels: genus 81 for 7 voxels."""
    full = {v for v in product(range(side), repeat=3) if sum(c % 2 == 0 for c in v) >= 2}
    index, quads = {}, []
    for voxel in sorted(full):
        for axis, sign in product(range(3), (-1, 1)):
            if tuple(c + sign * (a == axis) for a, c in enumerate(voxel)) in full:
                continue
            u, w = (axis + 1) % 3, (axis + 2) % 3
            corners = []
            for du, dw in [(0, 0), (1, 0), (1, 1), (0, 1)][:: sign]:
                corner = list(voxel)
                corner[axis] += sign > 0
                corner[u] += du
                corner[w] += dw
                corners.append(index.setdefault(tuple(corner), len(index)))
            quads.append(corners)
    return np.array(list(index), float) / side, quads


def generated():
    """Name to ((vertices, polygons), volume of the solid that is meant, m³, or None)."""
    overlap = 0.6 * 0.7 * 0.8
    boxes = join(box((0, 0, 0), (1, 1, 1)), box((0.4, 0.3, 0.2), (1.4, 1.3, 1.2)))
    return {
        "cube": closed(box((0, 0, 0), (1, 1, 1))),
        "sphere": closed(sphere()),
        "hollow sphere": closed(hollow_sphere()),
        "overlapping boxes": (boxes, 2.0 - overlap),
        "open sphere": (open_sphere(), None),
        "sphere twice": (join(sphere(), sphere()), closed(sphere())[1]),
        "lattice": closed(lattice()),
    }


def closed(surface):
    """The surface with its volume by the divergence theorem, m³."""
    return surface, signed_volume(surface[0], np.array(fans(surface[1])))


def signed_volume(vertices, triangles):
    return float(np.linalg.det(vertices[triangles]).sum() / 6.0)


def fans(polygons):
    return [[face[0], b, c] for face in polygons for b, c in zip(face[1:], face[2:])]


def write_obj(path, surface):
    vertices, polygons = surface
    with open(path, "w", encoding="ascii") as file:
        file.writelines("v " + " ".join(repr(float(c)) for c in v) + "\n" for v in vertices)
        file.writelines("f " + " ".join(str(i + 1) for i in p) + "\n" for p in polygons)


def read_obj(path):
    """Vertices and triangles; polygons become fans, all else is left as it is."""
    vertices, polygons = [], []
    with open(path, encoding="utf-8", errors="replace") as file:
        for line in file:
            words = line.split()
            if words[:1] == ["v"]:
                vertices.append([float(w) for w in words[1:4]])
            elif words[:1] == ["f"]:
                numbers = [int(w.split("/")[0]) for w in words[1:]]
                polygons.append([n - 1 if n > 0 else n + len(vertices) for n in numbers])
    return np.array(vertices, float), np.array(fans(polygons), np.int32)
