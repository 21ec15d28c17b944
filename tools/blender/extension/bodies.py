# SPDX-License-Identifier: GPL-3.0-or-later
"""Bodies of objects: the evaluated mesh, its bake, and the cache of bakes."""

import contextlib
import hashlib
import json
import os
import re
from dataclasses import dataclass

import bpy
import frangible as fr
import numpy as np
from mathutils import Vector
from mathutils.bvhtree import BVHTree

# Bakes of this session, the latest last.
_baked = {}
MOST_KEPT = 16
# How far the sides of a loaded body may be from those of the object, as a share of the longest.
LIKE = 0.03


@dataclass
class Shape:
    """The evaluated mesh of an object, in metres and along the world's axes."""

    vertices: np.ndarray  # (n, 3) from the object's origin
    triangles: np.ndarray  # (m, 3)
    origin: np.ndarray  # (3,) of the object, in the world
    unit: float  # m per unit of the scene

    @property
    def world(self):
        return self.vertices + self.origin

    @property
    def size(self):
        return float((self.vertices.max(axis=0) - self.vertices.min(axis=0)).max())


@dataclass
class Target:
    """A baked object where it stands."""

    body: fr.Body
    shape: Shape
    center: np.ndarray  # (3,) centre of mass in the world, m
    fresh: bool  # whether the bake was made now
    left: np.ndarray | float = 1.0  # (n,) the share of the strength that paint leaves at each vertex of the body; 1 where there is no paint


def metres(scene):
    """Metres in a unit of the scene."""
    return scene.unit_settings.scale_length


@contextlib.contextmanager
def evaluated(context, thing):
    """Yields the evaluated object and its mesh. Temporarily shows a hidden object, because Blender does not evaluate its modifiers otherwise."""
    if context.view_layer.objects.get(thing.name) is not thing:
        raise ValueError(f"{thing.name} is not in this view layer; link it to the scene, or show its collection.")
    if thing.mode == "EDIT":
        thing.update_from_editmode()
    hidden = thing.hide_get(), thing.hide_viewport
    try:
        if any(hidden):
            thing.hide_viewport = False
            thing.hide_set(False)
            context.view_layer.update()
        if not thing.visible_get():
            raise ValueError(f"{thing.name} is hidden, so its modifiers cannot be evaluated; show it and its collection first.")
        seen = thing.evaluated_get(context.evaluated_depsgraph_get())
        mesh = seen.to_mesh()
        try:
            yield seen, mesh
        finally:
            seen.to_mesh_clear()
    finally:
        if any(hidden):
            thing.hide_set(hidden[0])
            thing.hide_viewport = hidden[1]


def shape_of(context, thing):
    """Returns the evaluated and transformed mesh of an object. Raises ValueError if it has none."""
    if thing is None:
        raise ValueError("No mesh is chosen; pick one in the field Object, or make one active.")
    if thing.type != "MESH":
        raise ValueError(f"{thing.name} is not a mesh; pick a mesh, or convert it to one.")
    with evaluated(context, thing) as (seen, mesh):
        mesh.calc_loop_triangles()
        places = np.empty(3 * len(mesh.vertices), dtype=np.float32)
        corners = np.empty(3 * len(mesh.loop_triangles), dtype=np.int32)
        mesh.vertices.foreach_get("co", places)
        mesh.loop_triangles.foreach_get("vertices", corners)
        matrix = np.array(seen.matrix_world, dtype=np.float64)
    if not len(corners):
        raise ValueError(f"{thing.name} has no faces; give it a closed surface.")
    unit = metres(context.scene)
    local = places.reshape(-1, 3).astype(np.float64)
    if not np.isfinite(local).all() or not np.isfinite(matrix).all():
        raise ValueError(f"{thing.name} has a vertex or a transform that is not finite; fix it first.")
    return Shape(local @ matrix[:3, :3].T * unit, corners.reshape(-1, 3), matrix[:3, 3] * unit, unit)


def search_tree(places, triangles):
    """Returns a tree for nearest-point and ray queries on a surface."""
    return BVHTree.FromPolygons([Vector(place) for place in places], triangles.tolist())


def barycentric(places, triangles):
    """The barycentric coordinates (k, n, 3) of places (k, n, 3) in the planes of triangles (k, 3, 3); the first corner's where one has no area."""
    along, across = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    to = places - triangles[:, :1]
    a, b, c = (np.einsum("ij,ij->i", *pair) for pair in ((along, along), (along, across), (across, across)))
    d, e = np.einsum("ikj,ij->ik", to, along), np.einsum("ikj,ij->ik", to, across)
    scale = (a * c - b * b)[:, None]
    scale = np.where(scale < 1e-30, np.inf, scale)
    u, v = (c[:, None] * d - b[:, None] * e) / scale, (a[:, None] * e - b[:, None] * d) / scale
    return np.stack([1 - u - v, u, v], axis=2)


def key_of(shape, settings):
    """Returns a key that changes whenever a new bake is needed. Moving the object does not change it."""
    words = [settings.material, f"{settings.wall * shape.unit:.9g}", settings.tetrahedra, settings.modes, fr.__version__]
    digest = hashlib.sha256(json.dumps(words).encode())
    digest.update(shape.vertices.astype(np.float32).tobytes())
    digest.update(shape.triangles.tobytes())
    return digest.hexdigest()[:24]


def target_body(context, thing, tell=None):
    """Returns the object as a body: from the chosen file, the memory, the folder beside the .blend, or a new bake."""
    settings = context.scene.frangible
    shape = shape_of(context, thing)
    if settings.file:
        body, offset = _loaded(bpy.path.abspath(settings.file), shape, thing.name)
        return Target(body, shape, shape.origin - offset, False)
    key = key_of(shape, settings)
    fresh = key not in _baked
    if fresh:
        _remember(key, _read_kept(settings, thing, key) or _bake(shape, settings, thing.name, tell))
    body, offset = _baked[key]
    if settings.keep:
        _keep(thing, key, body, offset)
    return Target(body, shape, shape.origin - offset, fresh)


def forget_all():
    """Clears the bakes in memory; files are kept."""
    _baked.clear()


def _remember(key, entry):
    _baked[key] = entry
    while len(_baked) > MOST_KEPT:
        _baked.pop(next(iter(_baked)))


def _bake(shape, settings, name, tell):
    sides = shape.vertices.max(axis=0) - shape.vertices.min(axis=0)
    if sides.min() <= 1e-6 * sides.max():
        raise ValueError(f"{name} is flat and has no thickness; give it thickness, for example with a Solidify modifier.")
    try:
        body = fr.bake(
            shape.vertices,
            shape.triangles,
            material=settings.material,
            name=name,
            wall=settings.wall * shape.unit or None,
            tetrahedra=settings.tetrahedra,
            modes=settings.modes,
            progress=tell,
        )
    except ValueError as error:
        raise ValueError(f"{name} cannot be baked: {error}") from error
    return body, body.offset


def _loaded(path, shape, name):
    body = fr.load(path)
    low, high = body.vertices.min(axis=0), body.vertices.max(axis=0)
    given = shape.vertices.max(axis=0) - shape.vertices.min(axis=0)
    if np.abs(high - low - given).max() > LIKE * given.max():
        sizes = [" x ".join(f"{side:.3g}" for side in sides) for sides in (high - low, given)]
        raise ValueError(
            f"The body in {os.path.basename(path)} measures {sizes[0]} m and {name} {sizes[1]} m along the world's axes; load a body of this shape."
        )
    # The frame of a body begins at its centre of mass: the boxes around both show where that is in the object.
    return body, 0.5 * (low + high) - 0.5 * (shape.vertices.min(axis=0) + shape.vertices.max(axis=0))


def _folder():
    return bpy.path.abspath("//frangible-bodies") if bpy.data.filepath else None


def _paths(thing, key):
    name = re.sub(r"[^\w-]", "_", thing.name)
    stem = os.path.join(_folder(), f"{name}-{key}")
    return f"{stem}.frangible", f"{stem}.json"


def _read_kept(settings, thing, key):
    if not settings.keep or _folder() is None:
        return None
    body, offset = _paths(thing, key)
    try:
        with open(offset, encoding="utf-8") as file:
            return fr.load(body), np.array(json.load(file)["offset"], dtype=np.float64)
    except (OSError, ValueError, KeyError):
        # What is kept can be made again.
        return None


def _keep(thing, key, body, offset):
    if _folder() is None:
        raise ValueError("The .blend file has no folder yet; save it before keeping bakes beside it.")
    paths = _paths(thing, key)
    if all(map(os.path.exists, paths)):
        return
    try:
        os.makedirs(_folder(), exist_ok=True)
        body.save(paths[0])
        with open(paths[1], "w", encoding="utf-8") as file:
            json.dump({"offset": [float(x) for x in offset]}, file)
    except OSError as error:
        raise ValueError(f"The bake cannot be kept in {_folder()}: {error.strerror}.") from error
