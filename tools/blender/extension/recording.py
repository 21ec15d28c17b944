# SPDX-License-Identifier: GPL-3.0-or-later
"""What frangible's simulation wrote as a GLB: pieces, and how they move. Its axes have y up; here z is up."""

import json
import struct
from dataclasses import dataclass

import numpy as np
from mathutils import Quaternion

# Name of the body that breaks.
BODY = "body"
# Blender's (x, y, z) is (x, z, -y) there: this takes vectors from there.
UPRIGHT = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
# A quarter turn about x, which takes Blender's axes to those of the file: (x, y, z, w).
TO_FILE = (-(0.5**0.5), 0.0, 0.0, 0.5**0.5)

_TYPES = {5121: np.uint8, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


@dataclass
class Recorded:
    """A piece in a recording. Its mesh has the axes of the body that it comes from and its own centre of mass as origin."""

    vertices: np.ndarray  # (n, 3) m
    faces: np.ndarray  # (m, 3)
    inner: np.ndarray  # (m,) whether a crack made the face
    mass: float
    birth: np.ndarray  # (3,) its centre of mass in the body's frame, m
    broke: float  # when it is first seen on its own, s after the beginning
    times: np.ndarray  # (k,) s after the beginning, rising
    places: np.ndarray  # (k, 3) of its centre of mass in the world, m, z up
    turns: np.ndarray  # (k, 4) quaternions w, x, y, z that turn the piece from where it was in the body as baked


def to_file(vector):
    """A vector with y up."""
    return UPRIGHT.T @ np.asarray(vector, dtype=np.float64)


def read_pieces(path):
    """The pieces of the body in a recording, largest first. The path of each begins as a part of the whole body."""
    with open(path, "rb") as file:
        data = file.read()
    length = struct.unpack_from("<I", data, 12)[0]
    tree = json.loads(data[20 : 20 + length])
    numbers = data[28 + length :]
    moves = _moves(tree, numbers)
    pieces, whole = [], None
    for number, node in enumerate(tree["nodes"]):
        if node.get("name") == BODY:
            whole = whole or _path(node, moves.get(number, {}), 0.0)
        elif node.get("name", "").startswith(f"{BODY} piece "):
            pieces.append(_piece(tree, numbers, node, moves.get(number, {})))
    for piece in pieces:
        _begin_whole(piece, *whole)
    return sorted(pieces, key=lambda piece: -piece.mass)


def _begin_whole(piece, times, places, turns):
    """Puts the way of the whole body before that of a piece."""
    kept = times < piece.broke
    times, places, turns = times[kept], places[kept], turns[kept]
    matrices = np.array([Quaternion(turn).to_matrix() for turn in turns]).reshape(-1, 3, 3)
    piece.times = np.concatenate([times, piece.times])
    piece.places = np.concatenate([places + matrices @ piece.birth, piece.places])
    piece.turns = np.concatenate([turns, piece.turns])


def _array(tree, numbers, index):
    accessor = tree["accessors"][index]
    view = tree["bufferViews"][accessor["bufferView"]]
    width = _WIDTHS[accessor["type"]]
    begin = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    found = np.frombuffer(numbers, _TYPES[accessor["componentType"]], accessor["count"] * width, begin)
    return found.reshape(-1, width) if width > 1 else found


def _moves(tree, numbers):
    """The times and values of each moving property of each node."""
    moves = {}
    for animation in tree.get("animations", []):
        for channel in animation["channels"]:
            sampler = animation["samplers"][channel["sampler"]]
            values = [_array(tree, numbers, sampler[end]).astype(np.float64) for end in ("input", "output")]
            moves.setdefault(channel["target"]["node"], {})[channel["target"]["path"]] = values
    return moves


def _piece(tree, numbers, node, moves):
    parts = tree["meshes"][node["mesh"]]["primitives"]
    places = _array(tree, numbers, parts[0]["attributes"]["POSITION"]).astype(np.float64)
    marks = _array(tree, numbers, parts[0]["attributes"]["TEXCOORD_0"]).astype(np.float64)
    corners, inner = [], []
    for part in parts:
        cracked = " crack" in tree["materials"][part["material"]]["name"]
        if cracked and inner and inner[-1].all():
            # What follows the crack faces are cracks that part nothing.
            break
        corners.append(_array(tree, numbers, part["indices"]).reshape(-1, 3).astype(np.int64))
        inner.append(np.full(len(corners[-1]), cracked))
    faces, inner = np.concatenate(corners), np.concatenate(inner)
    birth = _birth(places, marks, faces)
    first = float(moves.get("scale", [np.zeros(1)])[0][-1])
    times, at, turns = _path(node, moves, first)
    places, faces = _joined(places, faces)
    return Recorded(places, faces, inner, node["extras"]["mass_kg"], birth, first, times, at, turns)


def _path(node, moves, first):
    """Times, places and turns of a node; what stands still has no track."""
    still = np.array([first])
    when, where = moves.get("translation", (still, np.array([node["translation"]], dtype=np.float64)))
    turned, turns = moves.get("rotation", (still, np.array([node["rotation"]], dtype=np.float64)))
    times = np.union1d(when, turned)
    at = np.stack([np.interp(times, when, where[:, axis]) for axis in range(3)], axis=1)
    spun = np.stack([np.interp(times, turned, turns[:, axis]) for axis in range(4)], axis=1)
    spun /= np.linalg.norm(spun, axis=1, keepdims=True)
    # The turn of a piece in Blender's axes, after that which laid the body into the file's.
    back = Quaternion((TO_FILE[3], -TO_FILE[0], 0.0, 0.0))
    return times, at @ UPRIGHT.T, np.array([back @ Quaternion(turn) for turn in spun[:, [3, 0, 1, 2]]])


def _birth(places, marks, faces):
    """Where the piece's origin lay in the body: texture coordinates are places of the body seen along its axes."""
    corners = places[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    axes = np.abs(normals).argmax(axis=1)
    sums, counts = np.zeros(3), np.zeros(3)
    # Of each axis that a face looks along: which coordinates lie in (u, v), with their signs on the positive side.
    seen = {0: ((2, -1), (1, -1)), 1: ((0, 1), (2, 1)), 2: ((0, 1), (1, -1))}
    clear = np.sort(np.abs(normals), axis=1)
    clear = clear[:, 2] > 1.001 * clear[:, 1]
    for axis, columns in seen.items():
        chosen = clear & (axes == axis)
        side = np.where(normals[chosen, axis] < 0, -1.0, 1.0)
        for column, (coordinate, sign) in enumerate(columns):
            found = marks[faces[chosen, 0], column] * sign * (side if column == 0 else 1.0) - corners[chosen, 0, coordinate]
            if len(found):
                sums[coordinate] += np.median(found) * len(found)
                counts[coordinate] += len(found)
    return sums / np.maximum(counts, 1)


def _joined(places, faces):
    """The mesh with vertices that lie in the same place made one, without those that no face has."""
    unique, inverse = np.unique(places[faces.ravel()].astype(np.float32), axis=0, return_inverse=True)
    return unique.astype(np.float64), inverse.reshape(-1, 3)
