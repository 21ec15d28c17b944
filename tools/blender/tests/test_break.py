# SPDX-License-Identifier: GPL-3.0-or-later
"""The pieces of a break: what they are, and how they move."""

import bpy
import numpy as np
import pytest
from conftest import add_slab, pieces_in, shape_of_pieces, volume
from extension import bodies, motion


def coloured(thing):
    """Gives the object two materials, by the side of its faces, and returns their names."""
    for name in ("top", "sides"):
        thing.data.materials.append(bpy.data.materials.new(name))
    for polygon in thing.data.polygons:
        polygon.material_index = 0 if polygon.normal.z > 0.5 else 1
    return ["top", "sides"]


@pytest.mark.parametrize("painted", [False, True])
@pytest.mark.parametrize("way", ["STILL", "KEYFRAMES"])
def test_the_pieces_fill_the_body(slab, way, painted):
    settings = bpy.context.scene.frangible
    settings.motion = way
    if painted:
        slab.vertex_groups.new(name="weak").add(range(8), 0.3, "REPLACE")
        settings.weakness = "weak"
    assert bpy.ops.frangible.break_object() == {"FINISHED"}
    parts = pieces_in("Slab")
    body = bodies.target_body(bpy.context, slab).body
    assert len(parts) > 5
    assert sum(map(volume, parts)) == pytest.approx(body.volume, rel=1e-3)
    assert sum(part["frangible_mass"] for part in parts) == pytest.approx(body.mass, rel=1e-5)
    assert body.volume == pytest.approx(0.2 * 0.16 * 0.02, rel=0.04)
    assert slab.hide_viewport and slab.hide_render
    bpy.context.scene.frame_set(bpy.context.scene.frame_current)
    places = np.array([(part.matrix_world @ vertex.co)[:] for part in parts for vertex in part.data.vertices])
    assert places.min(axis=0) == pytest.approx([0.2, 0.02, 0.39], abs=2e-3)
    assert places.max(axis=0) == pytest.approx([0.4, 0.18, 0.41], abs=2e-3)


def test_crack_faces_alone_have_the_inner_material(slab):
    names = coloured(slab)
    bpy.ops.frangible.break_object()
    seen = set()
    for part in pieces_in("Slab"):
        assert [material.name for material in part.data.materials] == [names[0], "Frangible inside", names[1]]
        crack = part.data.attributes["frangible_crack"].data
        for polygon in part.data.polygons:
            assert (polygon.material_index == 1) == crack[polygon.index].value
            middle = part.matrix_world.translation + polygon.center
            # What is no crack lies on a side of the slab, whose edges the tetrahedra (7 mm) round off.
            outside = min(abs(abs(middle[axis] - at) - half) for axis, at, half in ((0, 0.3, 0.1), (1, 0.1, 0.08), (2, 0.4, 0.01)))
            if polygon.material_index != 1:
                assert outside < 5e-3
            if polygon.area > 1e-6 and polygon.material_index == 0:
                assert middle.z > 0.4
            seen.add(polygon.material_index)
    assert seen == {0, 1, 2}


def test_texture_coordinates_stay(slab):
    # The top's coordinates are its places.
    layer = slab.data.uv_layers[0]
    for loop in slab.data.loops:
        layer.uv[loop.index].vector = slab.data.vertices[loop.vertex_index].co.xy
    bpy.ops.frangible.break_object()
    checked = 0
    for part in pieces_in("Slab"):
        values = part.data.uv_layers["UVMap"].uv
        for polygon in part.data.polygons:
            middle = part.location + polygon.center
            inside = abs(middle.x - 0.3) < 0.09 and abs(middle.y - 0.1) < 0.07
            # The edges of the body are a little rounder than those of the object.
            if polygon.normal.z < 0.99 or polygon.material_index == 1 or not inside:
                continue
            for loop in polygon.loop_indices:
                place = part.location + part.data.vertices[part.data.loops[loop].vertex_index].co
                assert values[loop].vector[:] == pytest.approx(((place.x - 0.3) / 0.2, (place.y - 0.1) / 0.16), abs=1e-3)
                checked += 1
    assert checked > 100


@pytest.mark.parametrize("way", ["STILL", "RIGID"])
def test_a_hidden_object_breaks_again_with_its_modifiers(scene, way):
    thing = add_slab(scene)
    bpy.ops.object.transform_apply(scale=True, location=False)
    thing.modifiers.new("pair", "ARRAY").count = 1
    thickness = thing.modifiers.new("thick", "DISPLACE")
    thickness.strength = 0.004
    bpy.context.view_layer.update()
    scene.frangible.target, scene.frangible.motion = thing, way
    bpy.ops.frangible.show_stress()
    bpy.ops.frangible.break_object()
    bpy.ops.frangible.break_object()
    first, again = (sum(map(volume, pieces_in(name))) for name in ("Slab", "Slab.001"))
    assert first == pytest.approx(again, rel=1e-6)
    bare = 0.2 * 0.16 * 0.02
    assert abs(first - bare) > 0.05 * bare
    assert bodies.target_body(bpy.context, thing).fresh is False


@pytest.mark.parametrize("way", ["STILL", "KEYFRAMES"])
def test_the_same_seed_gives_the_same_pieces(slab, way):
    settings = bpy.context.scene.frangible
    settings.motion, settings.seconds = way, 0.2
    for _ in range(2):
        bpy.ops.frangible.break_object()
        slab.hide_viewport = slab.hide_render = False
    assert shape_of_pieces("Slab") == shape_of_pieces("Slab.001")
    settings.seed = 2
    bpy.ops.frangible.break_object()
    assert shape_of_pieces("Slab") != shape_of_pieces("Slab.002")


def test_keyframes_let_the_pieces_fall_on_the_ground(slab):
    scene, settings = bpy.context.scene, bpy.context.scene.frangible
    settings.motion, settings.seconds = "KEYFRAMES", 2
    bpy.ops.frangible.break_object()
    parts = pieces_in("Slab")
    start = np.array([part.matrix_world.translation[:] for part in parts])
    scene.frame_set(scene.frame_current + int(2 * scene.render.fps))
    end = np.array([part.matrix_world.translation[:] for part in parts])
    assert (np.linalg.norm(end - start, axis=1) > 0.1).all()
    low = np.array([min((part.matrix_world @ vertex.co).z for vertex in part.data.vertices) for part in parts])
    assert (end[:, 2] > 0).all() and low.min() > -5e-3 and np.median(np.abs(low)) < 5e-3
    assert not scene.rigidbody_world


def test_a_scene_of_another_unit_has_the_same_pieces(scene):
    """The unit is a power of two of a metre, so that no number is rounded another way."""
    add_slab(scene)
    scene.frangible.motion, scene.frangible.seconds = "KEYFRAMES", 0.5
    bpy.ops.frangible.break_object()
    metres = pieces_in("Slab")
    scene.unit_settings.scale_length = 1 / 128
    thing = bpy.data.objects["Slab"]
    thing.hide_viewport = False
    thing.name = "Smaller"
    thing.location, thing.scale, scene.cursor.location = thing.location * 128, thing.scale * 128, scene.cursor.location * 128
    bpy.context.view_layer.update()
    bpy.ops.frangible.break_object()
    smaller = pieces_in("Smaller")
    assert len(smaller) == len(metres)
    for a, b in zip(metres, smaller):
        assert b.location[:] == pytest.approx([128 * x for x in a.location], abs=1e-3)


def test_rigid_pieces_have_the_masses_and_fly_off(scene):
    add_slab(scene, z=0.6)
    scene.frangible.motion = "RIGID"
    bpy.ops.frangible.break_object()
    parts = pieces_in("Slab")
    body = bodies.target_body(bpy.context, bpy.data.objects["Slab"]).body
    masses = [part.rigid_body.mass for part in parts]
    assert sum(masses) == pytest.approx(body.mass, rel=0.02) and min(masses) >= 1e-3 * 0.999
    heavy = [part for part in parts if part["frangible_mass"] > 2e-3]
    assert all(part.rigid_body.mass == pytest.approx(part["frangible_mass"], rel=1e-5) for part in heavy)
    assert {part.rigid_body.collision_shape for part in parts} == {"CONVEX_HULL"}
    broke = scene.frame_current
    start = {part.name: part.location.copy() for part in parts}
    paths = {part.name: [] for part in parts}
    for frame in range(1, 60):
        scene.frame_set(frame)
        for part in parts:
            paths[part.name].append(part.matrix_world.translation.copy())
    for part in parts:
        assert (paths[part.name][broke - 1] - start[part.name]).length < 1e-4
        assert paths[part.name][-1].z < 0.3
        assert paths[part.name][-1].z > -0.02
    # The middle is pushed down by the ball, faster than it would fall.
    step = [min(path[frame].z for path in paths.values()) for frame in (broke - 1, broke)]
    assert step[1] - step[0] < -3 * 9.81 * (1 / 24) ** 2
    scene.frame_set(1)
    assert not bpy.data.objects["Slab"].hide_viewport and all(part.hide_viewport for part in parts)
    scene.frame_set(broke)
    assert bpy.data.objects["Slab"].hide_viewport and not any(part.hide_viewport for part in parts)
    assert motion.GROUND_NAME in scene.objects


@pytest.mark.parametrize("way", ["STILL", "KEYFRAMES"])
def test_paint_says_where_it_breaks(scene, way):
    """A bar that is hit at its middle breaks first where it is painted, on either side."""
    middles = {}
    for side in (-1, 1):
        thing = add_slab(scene, z=0.5)
        thing.scale = (0.3, 0.05, 0.03)
        scene.cursor.location = (0.3, 0.1, 0.515)
        # Edges across the bar, so that paint can end.
        grid = thing.modifiers.new("fine", "SUBSURF")
        grid.subdivision_type, grid.levels = "SIMPLE", 4
        bpy.ops.object.modifier_apply(modifier="fine")
        group = thing.vertex_groups.new(name="weak")
        band = [vertex.index for vertex in thing.data.vertices if abs(vertex.co.x - 0.2 * side) < 0.08]
        group.add(band, 1.0, "REPLACE")
        scene.frangible.weakness, scene.frangible.weakest = "weak", 0.15
        scene.frangible.material, scene.frangible.motion, scene.frangible.seconds = "porcelain", way, 0.2
        scene.frangible.mass, scene.frangible.speed = 0.2, 3.0
        assert bpy.ops.frangible.break_object() == {"FINISHED"}
        name = next(c.name for c in bpy.data.collections if c.name.startswith(thing.name))
        area, sums = 0.0, 0.0
        for part in pieces_in(name):
            for polygon in part.data.polygons:
                if polygon.material_index == 1:
                    area += polygon.area
                    sums += polygon.area * (part.location + polygon.center).x
        middles[side] = sums / area - 0.3
        bpy.data.collections.remove(bpy.data.collections[name])
        bpy.data.objects.remove(thing)
    assert middles[-1] < -0.02 and middles[1] > 0.02
