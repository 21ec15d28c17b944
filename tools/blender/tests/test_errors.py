# SPDX-License-Identifier: GPL-3.0-or-later
"""Each bad input gets one sentence that names it, and nothing is lost."""

import bpy
import pytest
from conftest import add_slab

ALL = ("bake", "show_stress", "nine_seeds", "break_object")
BLOWS = ALL[1:]


@pytest.fixture
def refuses():
    """Checks that buttons refuse with a sentence, and that no data is made, lost or hidden."""

    def kept():
        kinds = (bpy.data.objects, bpy.data.meshes, bpy.data.collections, bpy.data.materials, bpy.data.actions, bpy.data.curves)
        return [sorted(item.name for item in kind) for kind in kinds] + [[thing.hide_viewport for thing in bpy.data.objects]]

    def check(sentence, names=BLOWS):
        before = kept()
        for name in names:
            with pytest.raises(RuntimeError, match=sentence) as caught:
                getattr(bpy.ops.frangible, name)()
            said = str(caught.value).strip()
            assert "Traceback" not in said and len(said.splitlines()) == 1, said
        assert kept() == before

    return check


def test_no_object(scene, refuses):
    refuses("No mesh is chosen", ALL)


def test_a_mesh_without_faces(scene, refuses):
    thing = bpy.data.objects.new("Nothing", bpy.data.meshes.new("Nothing"))
    scene.collection.objects.link(thing)
    scene.frangible.target = thing
    refuses("Nothing has no faces", ALL)


def test_a_plane_without_thickness(scene, refuses):
    bpy.ops.mesh.primitive_plane_add(size=0.2)
    refuses("Plane is flat and has no thickness", ALL)


def test_a_bent_sheet_is_refused_or_filled_but_never_a_traceback(scene):
    bpy.ops.mesh.primitive_plane_add(size=0.2)
    bpy.context.object.data.vertices[0].co.z = 0.02
    try:
        bpy.ops.frangible.bake()
    except RuntimeError as error:
        assert "Traceback" not in str(error) and "Plane cannot be baked" in str(error)


def test_a_vertex_that_is_not_finite(slab, refuses):
    slab.data.vertices[0].co.x = float("nan")
    slab.data.update()
    refuses("Slab has a vertex or a transform that is not finite", ALL)


def test_a_scale_of_zero(slab, refuses):
    slab.scale.y = 0
    bpy.context.view_layer.update()
    refuses("Slab is flat", ("bake",))


def test_a_cursor_that_is_far(slab, refuses):
    bpy.context.scene.cursor.location = (5, 0, 0)
    refuses(r"3D cursor is 4\.\d+ m from the surface of Slab")


@pytest.mark.parametrize("name", ["mass", "radius", "speed"])
def test_a_striker_with_a_zero(slab, refuses, name):
    setattr(bpy.context.scene.frangible, name, 0)
    refuses(f"The striker's {name} is 0")


def test_an_empty_that_is_missing_misses_or_points_out(slab, refuses):
    settings = bpy.context.scene.frangible
    settings.place = "EMPTY"
    refuses("No empty is chosen")
    empty = bpy.data.objects.new("Aim", None)
    bpy.context.scene.collection.objects.link(empty)
    settings.empty = empty
    empty.location = (3, 3, 3)
    bpy.context.view_layer.update()
    refuses("The -Z axis of Aim misses Slab")
    empty.location = (0.3, 0.1, 0.4)
    bpy.context.view_layer.update()
    refuses("goes along the surface of Slab or out of it")
    empty.location = (0.3, 0.1, 0.9)
    bpy.context.view_layer.update()
    assert bpy.ops.frangible.break_object() == {"FINISHED"}


def test_files_that_are_no_bodies(slab, refuses, tmp_path):
    settings = bpy.context.scene.frangible
    bpy.ops.frangible.bake()
    from extension.bodies import target_body

    whole = target_body(bpy.context, slab).body.to_bytes()
    flipped = whole[:5000] + bytes([whole[5000] ^ 1]) + whole[5001:]
    for name, data in (("text", b"solid cube"), ("empty", b""), ("cut", whole[: len(whole) // 2]), ("flipped", flipped)):
        path = tmp_path / f"{name}.frangible"
        path.write_bytes(data)
        settings.file = str(path)
        refuses(r"\w", ALL)
    settings.file = str(tmp_path / "missing.frangible")
    refuses(r"missing", ALL)
    settings.file = ""
    assert bpy.ops.frangible.break_object() == {"FINISHED"}


def test_a_group_that_is_missing_or_bare(slab, refuses):
    settings = bpy.context.scene.frangible
    settings.weakness = "gone"
    refuses("Slab has no vertex group gone")
    slab.vertex_groups.new(name="gone")
    refuses("gone of Slab has no weight anywhere")


def test_an_object_below_the_ground(scene, refuses):
    add_slab(scene, z=-0.5)
    scene.frangible.motion = "KEYFRAMES"
    refuses("reaches 0.51 m below the ground", ("nine_seeds", "break_object"))


def test_a_blow_that_is_too_soft_breaks_nothing_and_says_what_it_takes(slab):
    bpy.context.scene.frangible.speed = 0.2
    for name in ("nine_seeds", "break_object"):
        assert getattr(bpy.ops.frangible, name)() == {"CANCELLED"}
    assert not slab.hide_viewport and len(bpy.data.objects) == 1


def test_walls_too_thin_for_the_detail_are_told(scene, refuses):
    # Three sheets at one edge are no wall of two faces, so a lattice has to fill them.
    corners = [(0, 0, 0), (0, 0, 1), (1, 0, 0), (1, 0, 1), (-1, 1, 0), (-1, 1, 1), (-1, -1, 0), (-1, -1, 1)]
    mesh = bpy.data.meshes.new("Cube")
    mesh.from_pydata(corners, [], [(0, 1, 3, 2), (0, 1, 5, 4), (0, 1, 7, 6)])
    scene.collection.objects.link(cube := bpy.data.objects.new("Cube", mesh))
    bpy.context.view_layer.objects.active = cube
    cube.select_set(True)
    scene.frangible.tetrahedra, scene.frangible.wall = 600, 0.0005
    refuses("Cube cannot be baked: ", ("bake",))
