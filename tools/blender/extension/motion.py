# SPDX-License-Identifier: GPL-3.0-or-later
"""How pieces move after the break: by keyframes, or as rigid bodies."""

import bpy
import numpy as np
from mathutils import Quaternion

# Frames for which a rigid piece is led, so that it has its velocity when it is let go.
LED = 2
# The least mass that Blender takes, kg.
LEAST_MASS = 1e-3
GROUND_NAME = "Frangible ground"


def as_keyframes(scene, parts, pieces, unit):
    """Gives each piece the path that the simulation found, from the current frame on. Returns the last frame."""
    begin, rate = scene.frame_current, scene.render.fps / scene.render.fps_base
    last = begin
    for part, piece in zip(parts, pieces):
        times = np.array([time for time, _, _ in piece.path])
        frames = begin + times * rate
        places = np.array([at for _, at, _ in piece.path]) / unit
        turns = np.array([turn for _, _, turn in piece.path])
        for i in range(1, len(turns)):
            if turns[i] @ turns[i - 1] < 0:
                turns[i] = -turns[i]
        # A piece rests in the whole until the blow.
        frames = np.concatenate([[begin], frames])
        places = np.concatenate([[np.array(part.location)], places])
        turns = np.concatenate([[[1.0, 0, 0, 0] if turns[0][0] >= 0 else [-1.0, 0, 0, 0]], turns])
        _key(part, "location", frames, places)
        _key(part, "rotation_quaternion", frames, turns)
        last = max(last, int(np.ceil(frames[-1])))
    scene.frame_end = max(scene.frame_end, last)
    return last


def as_rigid_bodies(scene, thing, parts, pieces, unit, surface):
    """Makes each piece a rigid body of its mass, which leaves its place with the velocity of the break. Returns the frame of the break.

    A body that is let go keeps the velocity with which its keyframes led it. So each piece is led to its place in the last frames before
    the break, out of sight, while the whole object is still seen.
    """
    world = rigid_world(scene)
    first, step = scene.frame_current, scene.render.fps_base / scene.render.fps
    broke = first + LED
    world.point_cache.frame_start = min(world.point_cache.frame_start, first)
    scene.frame_end = max(scene.frame_end, broke + 1)
    world.point_cache.frame_end = max(world.point_cache.frame_end, scene.frame_end)
    before = np.arange(-LED, 1) * step
    for part, piece in zip(parts, pieces):
        world.collection.objects.link(part)
        rigid = part.rigid_body
        rigid.type = "ACTIVE"
        rigid.mass = max(piece.mass, LEAST_MASS)
        rigid.collision_shape = "CONVEX_HULL"
        rigid.friction, rigid.restitution = surface
        rigid.use_margin = True
        rigid.collision_margin = 0.0
        speed = float(np.linalg.norm(piece.angular))
        axis = piece.angular / speed if speed > 0 else np.array([0.0, 0, 1])
        frames = first + np.arange(LED + 1)
        _key(part, "location", frames, (piece.center + before[:, None] * piece.linear) / unit)
        _key(part, "rotation_quaternion", frames, np.array([Quaternion(axis, speed * time) for time in before]))
        rigid.kinematic = True
        rigid.keyframe_insert("kinematic", frame=first)
        rigid.kinematic = False
        rigid.keyframe_insert("kinematic", frame=broke + 1)
        _hide_between(part, first, broke, hidden_first=True)
    _hide_between(thing, first, broke, hidden_first=False)
    scene.frame_set(broke)
    return broke


def _hide_between(thing, first, broke, hidden_first):
    """Keys that hide an object before the break, or from it on."""
    for path in ("hide_viewport", "hide_render"):
        for frame, hidden in ((first, hidden_first), (broke, not hidden_first)):
            setattr(thing, path, hidden)
            thing.keyframe_insert(path, frame=frame)


def rigid_world(scene):
    """The rigid body world of a scene; one is made where there is none."""
    if scene.rigidbody_world is None:
        bpy.ops.rigidbody.world_add()
        scene.rigidbody_world.substeps_per_frame = 20
        scene.rigidbody_world.solver_iterations = 20
    world = scene.rigidbody_world
    if world.collection is None:
        world.collection = bpy.data.collections.new("RigidBodyWorld")
    return world


def add_ground(scene, size):
    """A ground at z = 0 for rigid bodies; one that is there is kept."""
    if bpy.data.objects.get(GROUND_NAME) in list(scene.objects):
        return
    # Splinters fly far: within the seconds of a scene none may leave it.
    half = 100 * size
    mesh = bpy.data.meshes.new(GROUND_NAME)
    # A slab, which fast pieces do not pass through. Blender lays the box of a rigid body about the object's origin.
    corners = [(x, y, z) for z in (size, -size) for x, y in ((-half, -half), (half, -half), (half, half), (-half, half))]
    mesh.from_pydata(corners, [], [(0, 1, 2, 3), (7, 6, 5, 4), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)])
    ground = bpy.data.objects.new(GROUND_NAME, mesh)
    ground.location.z = -size
    ground.display_type, ground.hide_render = "WIRE", True
    scene.collection.objects.link(ground)
    rigid_world(scene).collection.objects.link(ground)
    ground.rigid_body.type = "PASSIVE"
    ground.rigid_body.collision_shape = "BOX"
    ground.rigid_body.use_margin = True
    ground.rigid_body.collision_margin = 0.0


def _key(part, path, frames, values):
    """Linear keyframes of a property, all at once."""
    part.keyframe_insert(path, frame=float(frames[0]))
    for curve in curves_of(part):
        if curve.data_path != path:
            continue
        points = curve.keyframe_points
        points.clear()
        points.add(len(frames))
        coordinates = np.stack([frames, values[:, curve.array_index]], axis=1)
        points.foreach_set("co", coordinates.astype(np.float32).ravel())
        # 1 is LINEAR.
        points.foreach_set("interpolation", np.ones(len(frames), dtype=np.int32))
        curve.update()


def curves_of(part):
    """The curves of an object's action, in every Blender since 4.2."""
    data = part.animation_data
    if data is None or data.action is None:
        return []
    if not hasattr(data, "action_slot"):
        return list(data.action.fcurves)
    strips = (strip for layer in data.action.layers for strip in layer.strips)
    bags = (strip.channelbag(data.action_slot) for strip in strips)
    return [curve for bag in bags if bag is not None for curve in bag.fcurves]
