# SPDX-License-Identifier: GPL-3.0-or-later
"""Pieces as Blender objects: meshes, materials, texture coordinates."""

import bpy
import numpy as np
from mathutils import Vector

from .bodies import barycentric, evaluated, search_tree

# A sharp edge of a piece, radians.
SHARP = 0.6
# Slots of a piece's materials: what was outside, and the crack faces. Further materials of the outside follow.
OUTSIDE, INSIDE = 0, 1
INSIDE_NAME = "Frangible inside"


class Outside:
    """The surface of the object as it was: materials, texture coordinates and shading of each place."""

    def __init__(self, context, thing, shape):
        self.origin = shape.origin
        self.tree = search_tree(shape.vertices, shape.triangles)
        self.places, self.triangles = shape.vertices, shape.triangles
        self.materials = [slot.material for slot in thing.material_slots]
        with evaluated(context, thing) as (_, mesh):
            mesh.calc_loop_triangles()
            loops = np.empty(3 * len(mesh.loop_triangles), dtype=np.int32)
            polygons = np.empty(len(mesh.loop_triangles), dtype=np.int32)
            mesh.loop_triangles.foreach_get("loops", loops)
            mesh.loop_triangles.foreach_get("polygon_index", polygons)
            slots = np.empty(len(mesh.polygons), dtype=np.int32)
            smooth = np.empty(len(mesh.polygons), dtype=bool)
            mesh.polygons.foreach_get("material_index", slots)
            mesh.polygons.foreach_get("use_smooth", smooth)
            self.slots, self.smooth = slots[polygons], smooth[polygons]
            self.uvs = {}
            for layer in mesh.uv_layers:
                values = np.empty(2 * len(mesh.loops), dtype=np.float32)
                layer.uv.foreach_get("vector", values)
                self.uvs[layer.name] = values.reshape(-1, 2)[loops].reshape(-1, 3, 2)

    def nearest(self, places):
        """The triangle next to each of these places in the world, m."""
        return np.array([self.tree.find_nearest(Vector(place - self.origin))[2] for place in places], dtype=np.int64)

    def uv(self, layer, triangles, corners):
        """Texture coordinates of three corners (k, 3, 3) each, in the world, m, by the triangle next to them."""
        shares = barycentric(corners - self.origin, self.places[self.triangles[triangles]])
        return shares @ self.uvs[layer][triangles].astype(np.float64)


def plain_material(name, roughness):
    """The material of this name, made where there is none, its shader's node, and whether it was made."""
    material = bpy.data.materials.get(name)
    made = material is None
    if made:
        material = bpy.data.materials.new(name)
        if material.node_tree is None:
            material.use_nodes = True
    surface = next((node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED"), None)
    if made:
        surface.inputs["Roughness"].default_value = roughness
    return material, surface, made


def inside_material(settings):
    """The chosen material of crack faces, or a plain one."""
    if settings.inside is not None:
        return settings.inside
    material, surface, made = plain_material(INSIDE_NAME, 0.8)
    if made:
        material.diffuse_color = (0.75, 0.42, 0.2, 1)
        surface.inputs["Base Color"].default_value = material.diffuse_color
    return material


def piece_mesh(name, pieces, outside, inside, unit, offsets):
    """One mesh of some pieces, about the origin; `offsets` move each, m."""
    mesh = bpy.data.meshes.new(name)
    first = np.cumsum([0] + [len(piece.vertices) for piece in pieces])
    places = np.concatenate([piece.vertices + offset for piece, offset in zip(pieces, offsets)])
    faces = np.concatenate([piece.faces + start for piece, start in zip(pieces, first)])
    inner = np.concatenate([piece.inner for piece in pieces])
    mesh.from_pydata((places / unit).astype(np.float32), [], faces.tolist(), shade_flat=False)
    was = np.concatenate([(piece.vertices + piece.center)[piece.faces[~piece.inner]] for piece in pieces])
    near = outside.nearest(was.mean(axis=1))
    materials = outside.materials or [None]
    for material in [materials[0], inside, *materials[1:]]:
        mesh.materials.append(material)
    slots = np.full(len(faces), INSIDE, dtype=np.int32)
    given = np.minimum(outside.slots[near], len(materials) - 1)
    slots[~inner] = np.where(given == 0, OUTSIDE, given + 1)
    smooth = np.zeros(len(faces), dtype=bool)
    smooth[~inner] = outside.smooth[near]
    mesh.polygons.foreach_set("material_index", slots)
    mesh.polygons.foreach_set("use_smooth", smooth)
    for layer in outside.uvs:
        values = np.zeros((len(faces), 3, 2), dtype=np.float32)
        values[~inner] = outside.uv(layer, near, was)
        mesh.uv_layers.new(name=layer).uv.foreach_set("vector", values.ravel())
    cracks = mesh.attributes.new("frangible_crack", "BOOLEAN", "FACE")
    cracks.data.foreach_set("value", inner)
    mesh.update()
    mesh.validate()
    if smooth.any():
        mesh.set_sharp_from_angle(angle=SHARP)
    return mesh


def piece_objects(thing, pieces, outside, settings, unit, collection):
    """An object per piece, in the collection, where the pieces were in the whole."""
    inside, made = inside_material(settings), []
    for number, piece in enumerate(pieces, start=1):
        name = f"{thing.name} piece {number}"
        mesh = piece_mesh(name, [piece], outside, inside, unit, [np.zeros(3)])
        part = bpy.data.objects.new(name, mesh)
        part.location = piece.center / unit
        part.rotation_mode = "QUATERNION"
        part["frangible_mass"] = float(piece.mass)
        collection.objects.link(part)
        made.append(part)
    return made


def hide(thing):
    """Takes the whole object out of sight; nothing of it is lost."""
    thing.hide_viewport = thing.hide_render = True


def remove_collection(collection):
    """Removes a collection that we made, with what is in it."""
    for child in list(collection.children):
        remove_collection(child)
    for thing in list(collection.objects):
        data = thing.data
        bpy.data.objects.remove(thing)
        if data is not None and data.users == 0:
            kind = {"MESH": bpy.data.meshes, "CURVE": bpy.data.curves}.get(data.id_type)
            if kind is not None:
                kind.remove(data)
    bpy.data.collections.remove(collection)
