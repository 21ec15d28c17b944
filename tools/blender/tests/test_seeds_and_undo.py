# SPDX-License-Identifier: GPL-3.0-or-later
"""Nine seeds to choose from, and steps that are undone."""

import bpy
import pytest
from conftest import pieces_in
from extension import seeds


def counts():
    return dict(seeds.entries(bpy.context.scene))


def test_nine_seeds_lie_beside_the_object_and_one_is_picked(slab):
    scene, settings = bpy.context.scene, bpy.context.scene.frangible
    assert bpy.ops.frangible.nine_seeds() == {"FINISHED"}
    sheet = bpy.data.collections[seeds.SHEET]
    assert len(sheet.children) == 9 and sorted(counts()) == list(range(1, 10))
    assert len(set(counts().values())) >= 2
    places = {tuple(round(x, 3) for x in child.objects[0].location) for child in sheet.children}
    assert len(places) == 9 and all(x > 0.4 for x, _, _ in places)
    wanted = counts()[5]
    assert bpy.ops.frangible.pick_seed(seed=5) == {"FINISHED"}
    assert settings.seed == 5 and seeds.SHEET not in bpy.data.collections
    assert [thing.name for thing in scene.objects] == ["Slab"] and not bpy.data.curves
    bpy.ops.frangible.break_object()
    assert len(pieces_in("Slab")) == wanted


def test_the_sheet_shows_what_keyframes_will_break(slab):
    settings = bpy.context.scene.frangible
    settings.motion, settings.seconds = "KEYFRAMES", 0.3
    bpy.ops.frangible.nine_seeds()
    wanted = counts()[2]
    bpy.ops.frangible.pick_seed(seed=2)
    bpy.ops.frangible.break_object()
    assert len(pieces_in("Slab")) == wanted


def test_the_sheet_can_be_cleared(slab):
    bpy.ops.frangible.nine_seeds()
    bpy.ops.frangible.nine_seeds()
    assert sum(collection.name.startswith(seeds.SHEET) for collection in bpy.data.collections) == 1
    bpy.ops.frangible.clear_seeds()
    assert len(bpy.data.objects) == 1 and bpy.context.scene.frangible.seed == 1
    with pytest.raises(RuntimeError, match="There are no variants"):
        bpy.ops.frangible.clear_seeds()
    with pytest.raises(RuntimeError, match="Seed 3 is not among the nine"):
        bpy.ops.frangible.pick_seed(seed=3)


@pytest.mark.parametrize("motion", ["STILL", "KEYFRAMES", "RIGID"])
def test_a_break_is_undone(slab, motion):
    bpy.context.scene.frangible.motion = motion
    bpy.context.scene.frangible.seconds = 0.2
    bpy.ops.ed.undo_push(message="before")
    bpy.ops.frangible.break_object()
    bpy.ops.ed.undo_push(message="break")
    assert len(bpy.data.objects) > 5
    bpy.ops.ed.undo()
    assert [thing.name for thing in bpy.data.objects] == ["Slab"]
    thing = bpy.data.objects["Slab"]
    assert not thing.hide_viewport and not thing.hide_render and "Slab" not in bpy.data.collections
    bpy.ops.ed.redo()
    assert len(pieces_in("Slab")) > 5 and bpy.data.objects["Slab"].hide_viewport


def test_shown_stress_is_undone(slab):
    bpy.ops.ed.undo_push(message="before")
    bpy.ops.frangible.show_stress()
    bpy.ops.ed.undo_push(message="stress")
    bpy.ops.ed.undo()
    assert [thing.name for thing in bpy.data.objects] == ["Slab"]
    assert "frangible_stress" not in bpy.data.objects["Slab"].data.attributes
