# SPDX-License-Identifier: GPL-3.0-or-later
"""The stress of a blow, shown as colours on the object."""

import warnings

import bpy
import numpy as np
from mathutils import Vector
from mathutils.kdtree import KDTree

from .bodies import evaluated
from .pieces import plain_material

STRESS = "frangible_stress"
COLOUR = "frangible_colour"
# Whether the object was hidden from pictures before its stress was shown.
WAS_HIDDEN = "frangible_was_hidden"
VIEW_MATERIAL = "Frangible stress"
# Shares of the strength and their colours (sRGB), from dark blue to light yellow: the lightness alone tells the order. What
# reaches the strength is vermilion, which those who see red and green alike tell from yellow, too.
RAMP = [(0.0, (16, 34, 92)), (0.25, (35, 92, 140)), (0.5, (73, 150, 150)), (0.75, (150, 200, 135)), (1.0, (247, 236, 130))]
BREAKS = (213, 84, 10)


def colours(shares):
    """Returns linear colours (n, 4) for stresses given as shares of the strength."""
    stops = np.array([stop for stop, _ in RAMP])
    table = np.array([colour for _, colour in RAMP], dtype=np.float64)
    found = np.stack([np.interp(shares, stops, table[:, k]) for k in range(3)], axis=1)
    found[shares >= 1] = BREAKS
    found /= 255
    linear = np.where(found <= 0.04045, found / 12.92, ((found + 0.055) / 1.055) ** 2.4)
    return np.concatenate([linear, np.ones((len(found), 1))], axis=1)


def tension(target, blow, seed):
    """Returns the largest tensile stress over time at each vertex of the body, Pa."""
    body = target.body
    _, stresses = body.stress(blow.contact(target.center), seed=seed)
    with warnings.catch_warnings():
        # Faces without a flaw have no number at any time.
        warnings.simplefilter("ignore", RuntimeWarning)
        largest = np.nan_to_num(np.nanmax(stresses, axis=0), nan=0.0)
    found = np.zeros(len(body.vertices))
    for corner in range(3):
        np.maximum.at(found, body.faces[:, corner], largest)
    return np.maximum(found, 0.0)


def write_stress(context, thing, target, stresses, shares):
    """Writes the stress, Pa, and its colour on each vertex of the object's mesh."""
    places = np.empty(3 * len(thing.data.vertices), dtype=np.float32)
    with evaluated(context, thing) as (_, mesh):
        # Modifiers that keep the vertices may move them.
        source = mesh if len(mesh.vertices) == len(thing.data.vertices) else thing.data
        source.vertices.foreach_get("co", places)
    matrix = np.array(thing.matrix_world)
    world = (places.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]) * target.shape.unit
    near = nearest(target.body.vertices + target.center, world)
    for name, kind, key, values in ((STRESS, "FLOAT", "value", stresses[near]), (COLOUR, "FLOAT_COLOR", "color", colours(shares[near]))):
        attribute = thing.data.attributes.get(name)
        if attribute is not None and (attribute.domain != "POINT" or attribute.data_type != kind):
            thing.data.attributes.remove(attribute)
            attribute = None
        attribute = attribute or thing.data.attributes.new(name, kind, "POINT")
        attribute.data.foreach_set(key, values.astype(np.float32).ravel())
    thing.data.update()


def nearest(places, wanted):
    """Returns the index of the place nearest to each wanted place."""
    tree = KDTree(len(places))
    for number, place in enumerate(places):
        tree.insert(Vector(place), number)
    tree.balance()
    return np.array([tree.find(Vector(place))[1] for place in wanted], dtype=np.int64)


def show(context, thing, target, stresses, shares):
    """Shows the coloured surface of the body in place of the object."""
    clear(context.scene, thing)
    name, unit, body = view_name(thing), target.shape.unit, target.body
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata((body.vertices / unit).astype(np.float32), [], body.faces.tolist(), shade_flat=False)
    mesh.attributes.new(STRESS, "FLOAT", "POINT").data.foreach_set("value", stresses.astype(np.float32))
    colour = mesh.color_attributes.new(COLOUR, "FLOAT_COLOR", "POINT")
    colour.data.foreach_set("color", colours(shares).astype(np.float32).ravel())
    mesh.color_attributes.active_color = colour
    mesh.materials.append(_material())
    mesh.set_sharp_from_angle(angle=0.6)
    view = bpy.data.objects.new(name, mesh)
    view.location = target.center / unit
    view.hide_select = True
    for collection in thing.users_collection or [context.scene.collection]:
        collection.objects.link(view)
    view[WAS_HIDDEN] = thing.hide_render
    thing.hide_render = True
    thing.hide_set(True)
    space = context.space_data
    if space is not None and space.type == "VIEW_3D" and space.shading.type == "SOLID":
        space.shading.color_type = "VERTEX"
    return view


def view_name(thing):
    """Name of the object that shows the stress."""
    return f"{thing.name} stress"


def clear(scene, thing):
    """Removes the coloured surface and shows the object again. Returns whether there was one."""
    view = scene.objects.get(view_name(thing))
    if view is None or view.type != "MESH" or view.data.attributes.get(STRESS) is None:
        return False
    mesh = view.data
    thing.hide_render = bool(view.get(WAS_HIDDEN, False))
    bpy.data.objects.remove(view)
    if mesh.users == 0:
        bpy.data.meshes.remove(mesh)
    thing.hide_set(False)
    return True


def _material():
    material, surface, made = plain_material(VIEW_MATERIAL, 0.7)
    if made:
        attribute = material.node_tree.nodes.new("ShaderNodeAttribute")
        attribute.attribute_name = COLOUR
        material.node_tree.links.new(attribute.outputs["Color"], surface.inputs["Base Color"])
    return material
