"""Figures of a tetrahedral mesh, one way of measuring for all meshers."""

import numpy as np

EDGES = [(0, 1, 2, 3), (0, 2, 1, 3), (0, 3, 1, 2), (1, 2, 0, 3), (1, 3, 0, 2), (2, 3, 0, 1)]


def dihedral_angles(nodes, tets):
    """Six angles per tetrahedron, degrees; nodes (n, 3), tets (m, 4). A flat tetrahedron has 0 or 180."""
    x = nodes[tets]
    angles = []
    for a, b, c, d in EDGES:
        edge = x[:, b] - x[:, a]
        edge = edge / np.linalg.norm(edge, axis=1, keepdims=True)
        to_c, to_d = x[:, c] - x[:, a], x[:, d] - x[:, a]
        to_c = to_c - (to_c * edge).sum(1, keepdims=True) * edge
        to_d = to_d - (to_d * edge).sum(1, keepdims=True) * edge
        across = np.linalg.norm(np.cross(to_c, to_d), axis=1)
        angles.append(np.degrees(np.arctan2(across, (to_c * to_d).sum(1))))
    return np.stack(angles, axis=1)


def signed_volumes(nodes, tets):
    x = nodes[tets]
    sides = x[:, 1:] - x[:, :1]
    return np.linalg.det(sides) / 6.0


def figures(nodes, tets):
    """What the table shows. `inverted`: tetrahedra turned against the rest, or without volume."""
    angles, volumes = dihedral_angles(nodes, tets), signed_volumes(nodes, tets)
    right = max(int((volumes > 0).sum()), int((volumes < 0).sum()))
    return {
        "tets": len(tets),
        "nodes": len(np.unique(tets)),
        "smallest_angle": float(angles.min()),
        "largest_angle": float(angles.max()),
        "volume": float(np.abs(volumes).sum()),
        "inverted": len(tets) - right,
    }


def read_medit(path):
    """Nodes and tetrahedra of an ASCII .mesh file as `mesh_file` writes it: one entity per line."""
    with open(path, encoding="ascii") as file:
        lines = file.read().split("\n")

    def section(name, kind, columns):
        start = lines.index(name)
        rows = lines[start + 2 : start + 2 + int(lines[start + 1])]
        return np.array([row.split()[:columns] for row in rows], dtype=kind)

    return section("Vertices", float, 3), section("Tetrahedra", np.int64, 4) - 1
