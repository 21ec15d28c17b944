# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects become bodies of their size, once."""

import bpy
import extension
import frangible as fr
import numpy as np
import pytest
from extension import bodies


@pytest.fixture
def bakes(monkeypatch):
    """Counts how often something is baked."""
    bodies.forget_all()
    made = []
    bake = fr.bake
    monkeypatch.setattr(fr, "bake", lambda *given, **named: made.append(named["name"]) or bake(*given, **named))
    return made


def body_of(thing):
    return bodies.target_body(bpy.context, thing)


def test_it_can_be_taken_away_and_put_back():
    extension.unregister()
    assert not hasattr(bpy.types.Scene, "frangible") and not hasattr(bpy.types, "FRANGIBLE_OT_break_object")
    extension.register()
    assert hasattr(bpy.types, "FRANGIBLE_OT_break_object") and hasattr(bpy.types, "FRANGIBLE_PT_panel")


def test_a_cube_has_the_mass_of_its_size(scene):
    bpy.ops.mesh.primitive_cube_add(size=0.1, location=(1, 2, 3))
    assert bpy.ops.frangible.bake() == {"FINISHED"}
    target = body_of(bpy.context.object)
    assert target.body.mass == pytest.approx(2500 * 0.1**3, rel=0.03)
    assert target.center == pytest.approx([1, 2, 3], abs=1e-3)
    assert "glass" in scene.frangible.found


def test_scale_turn_modifiers_and_the_unit_of_the_scene_count(scene):
    bpy.ops.mesh.primitive_plane_add(size=1, location=(0, 0, 10))
    thing = bpy.context.object
    thing.scale, thing.rotation_euler = (20, 10, 1), (0, 0, np.pi / 2)
    thickness = thing.modifiers.new("thick", "SOLIDIFY")
    thickness.thickness = 2
    scene.unit_settings.scale_length = 0.01
    bpy.context.view_layer.update()
    body = body_of(thing).body
    sides = body.vertices.max(axis=0) - body.vertices.min(axis=0)
    assert sides == pytest.approx([0.1, 0.2, 0.02], rel=0.01)
    assert body.mass == pytest.approx(2500 * 0.1 * 0.2 * 0.02, rel=0.03)


def test_a_bake_is_made_once_and_again_when_the_mesh_or_a_setting_changes(slab, bakes):
    assert body_of(slab).fresh and not body_of(slab).fresh
    slab.location.x += 5
    bpy.context.view_layer.update()
    moved = body_of(slab)
    assert not moved.fresh and moved.center[0] == pytest.approx(5.3, abs=1e-3)
    slab.data.vertices[0].co.x *= 0.9
    assert body_of(slab).fresh
    bpy.context.scene.frangible.material = "porcelain"
    assert body_of(slab).fresh and body_of(slab).body.material == "porcelain"
    assert len(bakes) == 3


def test_glass_is_as_strong_as_its_surface(slab):
    strengths = []
    for material in ("glass-abraded", "glass", "glass-new"):
        bpy.context.scene.frangible.material = material
        strengths.append(body_of(slab).body.strength)
    assert strengths[0] < strengths[1] < strengths[2]


def test_a_bake_is_kept_beside_the_blend(slab, bakes, tmp_path):
    settings = bpy.context.scene.frangible
    settings.keep = True
    with pytest.raises(RuntimeError, match="save it before"):
        bpy.ops.frangible.bake()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "slab.blend"))
    first = body_of(slab)
    assert len(list((tmp_path / "frangible-bodies").glob("Slab-*.frangible"))) == 1
    bodies.forget_all()
    second = body_of(slab)
    assert len(bakes) == 1
    assert second.center == pytest.approx(first.center) and second.body.to_bytes() == first.body.to_bytes()


def test_a_baked_file_is_loaded_where_it_fits(slab, bakes, tmp_path):
    baked = body_of(slab)
    path = tmp_path / "slab.frangible"
    baked.body.save(path)
    bodies.forget_all()
    bpy.context.scene.frangible.file = str(path)
    loaded = body_of(slab)
    assert len(bakes) == 1
    assert loaded.center == pytest.approx(baked.center, abs=1e-3)
    slab.scale.x = 0.5
    bpy.context.view_layer.update()
    with pytest.raises(RuntimeError, match=r"measures 0\.2 x 0\.16 x 0\.02 m and Slab 0\.5 x"):
        bpy.ops.frangible.bake()


def test_progress_is_told(slab):
    bodies.forget_all()
    told = []
    bodies.target_body(bpy.context, slab, lambda stage, share: told.append((stage, share)))
    assert len(told) > 3 and all(0 <= share <= 1 for _, share in told)
