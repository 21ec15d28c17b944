# SPDX-License-Identifier: GPL-3.0-or-later
"""The set: a floor that bends into a wall, lamps, and the camera."""

import math

import bpy
import mathutils

# Share of the mass that a picture shows at least; what flew off farther is left out.
SHOWN = 0.85

# Half the picture's height over the radius of what it shows, which is wider than high.
MARGIN = 0.8


def build(recording, times, given):
    centre, radius = subject(recording, times)
    camera(recording, centre, radius, given)
    if recording.floor is not None:
        level = recording.floor.matrix_world.translation.z
        bpy.data.objects.remove(recording.floor)
        floor(level, centre, radius)
    lamps(centre, radius)


def subject(recording, times):
    """Centre and radius of what most of the mass lies in."""
    boxes = [box for at in times for box in recording.seen(at)]
    total = sum(mass for _, mass in boxes)
    if total <= 0:
        boxes, total = [(corners, 1.0) for corners, _ in boxes], len(boxes)
    middles = [sum(corners, mathutils.Vector()) / 8 for corners, _ in boxes]
    # The heaviest thing is in the middle of what matters, and then what lies nearest to it.
    heaviest = max(range(len(boxes)), key=lambda i: boxes[i][1])
    near = sorted(range(len(boxes)), key=lambda i: (middles[i] - middles[heaviest]).length)
    shown, mass = [], 0.0
    for i in near:
        if boxes[i][1] <= 0 and total > 0:
            continue
        shown += boxes[i][0]
        mass += boxes[i][1]
        if mass >= SHOWN * total:
            break
    low = mathutils.Vector(map(min, zip(*shown)))
    high = mathutils.Vector(map(max, zip(*shown)))
    return (low + high) / 2, max((high - low).length / 2, 1e-3)


def camera(recording, centre, radius, given):
    lens = bpy.data.cameras.new("camera")
    eye = bpy.data.objects.new("camera", lens)
    bpy.context.scene.collection.objects.link(eye)
    bpy.context.scene.camera = eye
    lens.angle = math.radians(28)
    away = mathutils.Vector((0.4, -1.0, 0.45))
    if recording.camera is not None:
        # A camera looks along its -z axis.
        away = recording.camera.matrix_world.to_quaternion() @ mathutils.Vector((0, 0, 1))
    around = math.atan2(away.y, away.x) + math.radians(given.from_side)
    height = math.asin(max(-1.0, min(1.0, away.normalized().z)))
    if given.height is not None:
        height = math.radians(given.height)
    height = max(height, math.radians(4))
    level = math.cos(height)
    away = mathutils.Vector((level * math.cos(around), level * math.sin(around), math.sin(height)))
    width, tall = given.size
    half = math.atan(math.tan(lens.angle / 2) * min(1.0, tall / width))
    distance = MARGIN * radius / math.sin(half)
    eye.location = centre + away * distance
    eye.rotation_euler = away.to_track_quat("Z", "Y").to_euler()
    lens.clip_start, lens.clip_end = distance * 1e-3, distance * 100
    lens.dof.use_dof = True
    lens.dof.focus_distance = distance - 0.4 * radius
    # As shallow as a photograph of something of this size from this far.
    lens.dof.aperture_fstop = 0.5 * lens.lens / max(1e-3, 1000 * 0.012 * radius)


def floor(level, centre, radius):
    mesh = bpy.data.meshes.new("set")
    # A strip that runs towards the wall, bends and goes up; seen from the camera.
    eye = bpy.context.scene.camera.location
    toward = mathutils.Vector((centre.x - eye.x, centre.y - eye.y, 0)).normalized()
    across = mathutils.Vector((-toward.y, toward.x, 0))
    ahead, bend, wide = 14 * radius, 8 * radius, 90 * radius
    profile = [(-60 * radius, 0.0)]
    steps = 24
    for k in range(steps + 1):
        turn = 0.5 * math.pi * k / steps
        profile.append((ahead + bend * math.sin(turn), bend * (1 - math.cos(turn))))
    profile.append((ahead + bend, 40 * radius))
    foot = mathutils.Vector((centre.x, centre.y, level - 2e-5))
    points, faces = [], []
    for along, up in profile:
        for side in (-wide, wide):
            points.append(foot + toward * along + across * side + mathutils.Vector((0, 0, up)))
    for k in range(len(profile) - 1):
        faces.append((2 * k, 2 * k + 1, 2 * k + 3, 2 * k + 2))
    mesh.from_pydata(points, [], faces)
    mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
    thing = bpy.data.objects.new("set", mesh)
    bpy.context.scene.collection.objects.link(thing)
    mesh.materials.append(plaster(radius))


def plaster(radius):
    material = bpy.data.materials.new("plaster")
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    shader = nodes["Principled BSDF"]
    shader.inputs["Roughness"].default_value = 0.42
    where = nodes.new("ShaderNodeNewGeometry")
    noise = nodes.new("ShaderNodeTexNoise")
    noise.inputs["Scale"].default_value = 110 / radius
    noise.inputs["Detail"].default_value = 10
    links.new(where.outputs["Position"], noise.inputs["Vector"])
    ramp = nodes.new("ShaderNodeValToRGB")
    ramp.color_ramp.elements[0].position, ramp.color_ramp.elements[1].position = 0.3, 0.7
    ramp.color_ramp.elements[0].color = (0.120, 0.122, 0.126, 1)
    ramp.color_ramp.elements[1].color = (0.150, 0.150, 0.150, 1)
    links.new(noise.outputs["Fac"], ramp.inputs["Fac"])
    links.new(ramp.outputs["Color"], shader.inputs["Base Color"])
    bump = nodes.new("ShaderNodeBump")
    bump.inputs["Strength"].default_value = 0.08
    bump.inputs["Distance"].default_value = 0.004 * radius
    links.new(noise.outputs["Fac"], bump.inputs["Height"])
    links.new(bump.outputs["Normal"], shader.inputs["Normal"])
    return material


def lamps(centre, radius):
    scene = bpy.context.scene
    world = bpy.data.worlds.new("room")
    scene.world = world
    world.use_nodes = True
    background = world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (0.55, 0.62, 0.72, 1)
    background.inputs["Strength"].default_value = 0.16
    backward = scene.camera.location - centre
    backward = mathutils.Vector((backward.x, backward.y, 0)).normalized()
    right = mathutils.Vector((-backward.y, backward.x, 0))
    up = mathutils.Vector((0, 0, 1))
    # Places, sides and light, in radii: what a lamp gives falls with the square of its distance.
    for name, place, sides, watts, color in [
        ("key", -3.0 * right + 4.2 * up + 1.6 * backward, (3.2, 3.2), 430, (1.0, 0.95, 0.88)),
        ("fill", 4.2 * right + 1.6 * up + 2.0 * backward, (1.0, 4.0), 90, (0.80, 0.90, 1.0)),
        ("rim", 1.2 * right + 2.8 * up - 4.4 * backward, (5.0, 1.2), 330, (1.0, 1.0, 1.0)),
    ]:
        light = bpy.data.lights.new(name, "AREA")
        light.shape = "RECTANGLE"
        light.size, light.size_y = (side * radius for side in sides)
        light.energy = watts * radius * radius
        light.color = color
        lamp = bpy.data.objects.new(name, light)
        lamp.location = centre + place * radius
        lamp.rotation_euler = place.to_track_quat("Z", "Y").to_euler()
        scene.collection.objects.link(lamp)
