# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the pictures of README.md and of the book's page on kits: env/bin/python tools/blender/pictures/draw.py [stress|pieces|seeds|kit]..."""

import math
import os
import subprocess
import sys
import tempfile
import traceback
from pathlib import Path

import bpy
from mathutils import Vector

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]
sys.path.insert(0, str(HERE.parent))

import extension

SPEED = 12.0
SEED = 1
FRAME = 7


# Outside of the vase, from the foot to the lip: radius and height, m.
RADII = [0.045, 0.05, 0.066, 0.086, 0.091, 0.08, 0.058, 0.048, 0.05, 0.06]
HEIGHTS = [0, 0.008, 0.035, 0.075, 0.11, 0.15, 0.185, 0.21, 0.235, 0.26]
WALL = 0.008
AROUND = 128


def rounded(profile):
    """The profile with three more points in each part, on a smooth curve (Catmull and Rom) through all."""
    ends = [profile[0], *profile, profile[-1]]
    found = []
    for a, b, c, d in zip(ends, ends[1:], ends[2:], ends[3:]):
        for t in (0, 0.25, 0.5, 0.75):
            shares = (-0.5 * t + t**2 - 0.5 * t**3, 1 - 2.5 * t**2 + 1.5 * t**3, 0.5 * t + 2 * t**2 - 1.5 * t**3, -0.5 * t**2 + 0.5 * t**3)
            found.append(tuple(sum(share * point[k] for share, point in zip(shares, (a, b, c, d))) for k in (0, 1)))
    return [*found, profile[-1]]


def vase():
    """A vase of porcelain of 0.26 m that stands on the ground, and a blow on its belly."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    outer = rounded(list(zip(RADII, HEIGHTS)))
    inner = [(radius - WALL, max(height, WALL)) for radius, height in reversed(outer) if height > WALL or radius == outer[0][0]]
    middle, height = outer[-1][0] - WALL / 2, outer[-1][1]
    lip = [(middle + WALL / 2 * math.cos(turn), height + WALL / 2 * math.sin(turn)) for turn in (math.pi * i / 8 for i in range(1, 8))]
    rows = [(0, 0), *outer, *lip, *inner, (0, WALL)]
    places, rings = [], []
    for radius, height in rows:
        count = AROUND if radius > 0 else 1
        turns = (2 * math.pi * i / AROUND for i in range(count))
        rings.append(range(len(places), len(places) + count))
        places += [(radius * math.cos(turn), radius * math.sin(turn), height) for turn in turns]
    faces = []
    for low, high in zip(rings, rings[1:]):
        for i in range(AROUND):
            corners = [low[i % len(low)], low[(i + 1) % len(low)], high[(i + 1) % len(high)], high[i % len(high)]]
            faces.append(list(dict.fromkeys(corners)))
    mesh = bpy.data.meshes.new("Vase")
    mesh.from_pydata(places, [], faces, shade_flat=False)
    thing = bpy.data.objects.new("Vase", mesh)
    mesh.set_sharp_from_angle(angle=0.6)
    scene.collection.objects.link(thing)
    bpy.context.view_layer.objects.active = thing
    paint(mesh, "Glaze", (0.09, 0.25, 0.42, 1), 0.15)
    settings = scene.frangible
    settings.material, settings.tetrahedra, settings.modes = "porcelain", 30000, 120
    settings.mass, settings.radius, settings.speed = 0.05, 0.012, SPEED
    bpy.context.view_layer.update()
    hit, place, *_ = scene.ray_cast(bpy.context.evaluated_depsgraph_get(), Vector((0.23, -1, 0.125)), Vector((-0.2, 1, 0)))
    assert hit
    scene.cursor.location = place
    return scene, thing


def paint(mesh, name, colour, roughness):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    surface = next(node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    surface.inputs["Base Color"].default_value = colour
    surface.inputs["Roughness"].default_value = roughness
    mesh.materials.append(material)


def ball(at, radius, colour):
    bpy.ops.mesh.primitive_uv_sphere_add(segments=48, ring_count=24, radius=radius, location=at)
    bpy.ops.object.shade_smooth()
    paint(bpy.context.object.data, "Ball", colour, 0.25)


def studio(scene, look, eye, width, size=(720, 450)):
    """A floor, lamps and a camera; `width` is how much of the world, m, the picture is wide."""
    bpy.ops.mesh.primitive_plane_add(size=30, location=(0, 0, 0))
    paint(bpy.context.object.data, "Floor", (0.28, 0.29, 0.31, 1), 0.9)
    for place, energy, wide in (((-1.2, -1.2, 1.8), 34, 1.2), ((1.6, -0.6, 1.0), 12, 0.8), ((0.3, 1.8, 1.4), 16, 0.8)):
        lamp = bpy.data.objects.new("Lamp", bpy.data.lights.new("Lamp", "AREA"))
        lamp.data.energy, lamp.data.size = energy * (width / 0.6) ** 2, wide * width / 0.6
        lamp.location = Vector(look) + Vector(place) * width / 0.6
        lamp.rotation_euler = (Vector(look) - lamp.location).to_track_quat("-Z", "Y").to_euler()
        scene.collection.objects.link(lamp)
    scene.world = bpy.data.worlds.new("World")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs[0].default_value = (0.6, 0.65, 0.7, 1)
    scene.world.node_tree.nodes["Background"].inputs[1].default_value = 0.35
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.data.lens = 70
    away = Vector(eye).normalized()
    camera.location = Vector(look) + away * width * camera.data.lens / camera.data.sensor_width
    camera.rotation_euler = (-away).to_track_quat("-Z", "Y").to_euler()
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.resolution_x, scene.render.resolution_y = size
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising = 32, True
    scene.view_settings.view_transform = "Standard"
    scene.render.image_settings.file_format = "JPEG"
    scene.render.image_settings.quality = 82


def render(scene, name, folder=HERE):
    scene.render.filepath = str(folder / f"{name}.jpg")
    bpy.ops.render.render(write_still=True)


def stress():
    scene, _ = vase()
    print(bpy.ops.frangible.show_stress(), scene.frangible.found)
    place = scene.cursor.location
    # The ball is drawn on its way, so that what it hits is seen.
    ball(place + 0.045 * Vector((place.x, place.y, 0)).normalized(), 0.012, (0.02, 0.02, 0.02, 1))
    studio(scene, (0.02, 0, 0.128), (-0.1, -1, 0.3), 0.49)
    render(scene, "stress")


def pieces():
    scene, _ = vase()
    scene.frangible.seconds, scene.frangible.seed = 2, SEED
    print(bpy.ops.frangible.break_object(), scene.frangible.found)
    scene.frame_set(FRAME)
    studio(scene, (0.02, -0.04, 0.1), (0.1, -1, 0.45), 0.58)
    render(scene, "pieces")


def seeds():
    scene, thing = vase()
    print(bpy.ops.frangible.nine_seeds(), scene.frangible.found)
    for text in bpy.data.curves:
        paint(text, "Text", (0.9, 0.9, 0.9, 1), 0.5)
    middle = bpy.data.collections["Vase seed 5"].objects[0].location
    thing.hide_render = True
    bpy.context.view_layer.update()
    studio(scene, (middle.x, middle.y - 0.04, 0.1), (0.0, -1, 2.0), 1.42, (800, 720))
    render(scene, "seeds")


def kit():
    """The steps of the book's page on kits: the model of seven parts is imported, and a column is broken."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    with tempfile.TemporaryDirectory() as folder:
        model = Path(folder) / "temple.obj"
        subprocess.run([sys.executable, ROOT / "apps/python/examples/temple.py", model], check=True)
        bpy.ops.wm.obj_import(filepath=str(model))
    parts = {thing.name: thing for thing in scene.objects}
    print(sorted(parts))
    for thing in parts.values():
        thing.data.materials.clear()
        paint(thing.data, "Marble", (0.75, 0.73, 0.68, 1), 0.4)
    settings = scene.frangible
    settings.material, settings.tetrahedra, settings.modes, settings.motion = "porcelain", 9000, 40, "KEYFRAMES"
    settings.mass, settings.radius, settings.seconds = 0.3, 0.02, 1
    # The cursor on the front of the column.
    thing = parts["column_1"]
    corners = [thing.matrix_world @ Vector(corner) for corner in thing.bound_box]
    scene.cursor.location = (sum(corner.x for corner in corners) / 8, min(corner.y for corner in corners), 0.1)
    settings.target, settings.speed = thing, 8
    print(bpy.ops.frangible.break_object(), settings.found)
    scene.frame_set(FRAME)
    studio(scene, (0, 0, 0.09), (-0.45, -1, 0.35), 0.42)
    render(scene, "temple-blender", ROOT / "book/src/how-to/pictures")


if __name__ == "__main__":
    extension.register()
    status = 1
    try:
        for wanted in sys.argv[1:] or ["stress", "pieces", "seeds", "kit"]:
            {"stress": stress, "pieces": pieces, "seeds": seeds, "kit": kit}[wanted]()
        status = 0
    except Exception:
        traceback.print_exc()
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
        # Blender's package may wait for ever when Python ends.
        os._exit(status)
