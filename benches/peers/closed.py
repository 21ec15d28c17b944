"""Whether pieces are closed, and their volume."""

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from surfaces import signed_volume

# Corners nearer than this share of the body's longest side may count as one.
ROUNDING = 1e-6


def read_pieces(path):
    """(vertices, triangles) of each object of an OBJ file; objects without triangles are none."""
    pieces, before = [], 0
    vertices, triangles = [], []

    def finish():
        if triangles:
            pieces.append((np.array(vertices, float), np.array(triangles) - before))

    with open(path, encoding="ascii") as file:
        for line in file:
            words = line.split()
            if words[:1] == ["o"]:
                finish()
                before += len(vertices)
                vertices, triangles = [], []
            elif words[:1] == ["v"]:
                vertices.append([float(word) for word in words[1:4]])
            elif words[:1] == ["f"]:
                triangles.append([int(word) - 1 for word in words[1:4]])
    finish()
    return pieces


def is_closed(vertices, triangles, size):
    """Every edge has exactly two triangles, in opposite directions: after corners at the same place became one, or those within
    rounding."""
    same = np.unique(vertices, axis=0, return_inverse=True)[1].reshape(-1)
    return tight(same[triangles]) or tight(near(vertices, ROUNDING * size)[triangles])


def near(vertices, distance):
    """One number for all vertices linked by gaps below this distance."""
    pairs = cKDTree(vertices).query_pairs(distance, output_type="ndarray")
    links = coo_matrix((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(len(vertices),) * 2)
    return connected_components(links, directed=False)[1]


def tight(triangles):
    a, b, c = triangles.T
    # A triangle with two corners in one place is a line.
    triangles = triangles[(a != b) & (b != c) & (c != a)]
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]).astype(np.int64)
    count = np.int64(edges.max()) + 1 if len(edges) else 1
    there, back = edges[:, 0] * count + edges[:, 1], edges[:, 1] * count + edges[:, 0]
    return len(edges) > 0 and len(np.unique(there)) == len(there) and np.array_equal(np.sort(there), np.sort(back))


def figures(path, size, volume):
    """Number of pieces, share of closed ones, sum of volumes over the body's."""
    pieces = read_pieces(path)
    return {
        "pieces": len(pieces),
        "closed": sum(is_closed(*piece, size) for piece in pieces) / max(len(pieces), 1),
        "volume": sum(signed_volume(*piece) for piece in pieces) / volume,
    }
