# SPDX-License-Identifier: GPL-3.0-or-later
"""Where an object would break, as colours and numbers."""

import re

import bpy
import numpy as np
import pytest
from extension import colours


def subdivide(thing):
    grid = thing.modifiers.new("fine", "SUBSURF")
    grid.subdivision_type, grid.levels = "SIMPLE", 4
    bpy.context.view_layer.objects.active = thing
    bpy.ops.object.modifier_apply(modifier="fine")


def written(thing):
    attribute = thing.data.attributes[colours.STRESS]
    values = np.empty(len(thing.data.vertices), dtype=np.float32)
    attribute.data.foreach_get("value", values)
    return values


def shown_numbers():
    """The slowest speed, m/s, and the margin that the panel tells."""
    bpy.ops.frangible.show_stress()
    found = re.search(r"It breaks from (\S+) m/s; margin (\S+) at", bpy.context.scene.frangible.found)
    return float(found.group(1)), float(found.group(2))


def test_the_stress_is_written_and_is_largest_near_the_blow(slab):
    subdivide(slab)
    before = len(bpy.data.objects)
    assert bpy.ops.frangible.show_stress() == {"FINISHED"}
    stress = written(slab)
    assert np.isfinite(stress).all() and (stress >= 0).all() and stress.max() > 1e7
    places = np.array([(slab.matrix_world @ vertex.co)[:] for vertex in slab.data.vertices])
    cursor = np.array(bpy.context.scene.cursor.location)
    # On a face of the rim, which bending pulls at one end only, a single flaw may feel more.
    inner = (np.abs(places - [0.3, 0.1, 0.4]) < [0.09, 0.07, 1]).all(axis=1)
    assert np.linalg.norm((places[inner][stress[inner].argmax()] - cursor)[:2]) < 0.03
    far = np.linalg.norm(places - cursor, axis=1) > 0.08
    assert stress[far].mean() < 0.5 * stress.max()
    assert slab.data.attributes[colours.COLOUR].data_type == "FLOAT_COLOR"
    assert slab.hide_get() and slab.hide_render and len(bpy.data.objects) == before + 1
    found = bpy.context.scene.frangible.found
    assert "margin 0." in found and "It breaks from" in found
    assert bpy.ops.frangible.hide_stress() == {"FINISHED"}
    assert not slab.hide_get() and not slab.hide_render and len(bpy.data.objects) == before


def test_the_coloured_surface_lies_where_the_object_is(slab):
    bpy.ops.frangible.show_stress()
    view = bpy.data.objects[colours.view_name(slab)]
    bpy.context.view_layer.update()
    places = np.array([(view.matrix_world @ vertex.co)[:] for vertex in view.data.vertices])
    assert places.min(axis=0) == pytest.approx([0.2, 0.02, 0.39], abs=2e-3)
    assert places.max(axis=0) == pytest.approx([0.4, 0.18, 0.41], abs=2e-3)
    bpy.ops.frangible.show_stress()
    assert sum(thing.name.endswith("stress") for thing in bpy.data.objects) == 1


def test_a_harder_blow_has_less_margin(slab):
    _, soft = shown_numbers()
    bpy.context.scene.frangible.speed = 20
    assert shown_numbers()[1] < 0.8 * soft


def test_the_ramp_rises_in_lightness_and_breaking_stands_out():
    ramp = colours.colours(np.linspace(0, 0.999, 20))
    light = ramp[:, :3] @ [0.2126, 0.7152, 0.0722]
    assert (np.diff(light) > 0).all()
    breaks = colours.colours(np.array([1.0, 3.0]))
    assert (breaks[0] == breaks[1]).all() and np.abs(breaks[0] - ramp[-1]).max() > 0.3


def test_paint_raises_the_share_of_the_strength(slab):
    subdivide(slab)
    group = slab.vertex_groups.new(name="weak")
    group.add([vertex.index for vertex in slab.data.vertices if vertex.co.x > 0.2], 1.0, "REPLACE")
    bpy.ops.frangible.show_stress()
    plain = np.array([c.color[:] for c in slab.data.attributes[colours.COLOUR].data])
    bpy.context.scene.frangible.weakness = "weak"
    bpy.ops.frangible.show_stress()
    assert "times the strength there" in bpy.context.scene.frangible.found
    painted = np.array([c.color[:] for c in slab.data.attributes[colours.COLOUR].data])
    changed = np.abs(painted - plain).max(axis=1) > 1e-4
    weak = np.array([vertex.co.x > 0.2 for vertex in slab.data.vertices])
    assert changed[weak].any() and not changed[np.array([vertex.co.x < 0.05 for vertex in slab.data.vertices])].any()


def test_margin_and_slowest_speed_are_those_of_the_painted_object(slab):
    settings = bpy.context.scene.frangible
    settings.speed = 1
    speed, margin = shown_numbers()
    slab.vertex_groups.new(name="weak").add(range(8), 1.0, "REPLACE")
    settings.weakness, settings.weakest = "weak", 0.5
    slower, less = shown_numbers()
    assert slower < 0.8 * speed
    assert less > 1
    # Painted all over it has half the strength everywhere; numbers are told to three digits.
    assert less == pytest.approx(0.5 * margin, rel=0.01)
    for share, done in ((1.1, {"FINISHED"}), (0.9, {"CANCELLED"})):
        settings.speed = share * slower
        assert bpy.ops.frangible.break_object() == done
