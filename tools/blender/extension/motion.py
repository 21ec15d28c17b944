# SPDX-License-Identifier: GPL-3.0-or-later
"""How pieces move after the break: by keyframes, or as rigid bodies."""

import bpy
import numpy as np
from mathutils import Quaternion

# Frames for which a rigid piece is led, so that it has its velocity when it is let go.
LED = 2
GROUND_NAME = "Frangible ground"


def as_keyframes(scene, parts, pieces, unit):
    """Gives each piece the path that the simulation found, from the current frame on. Returns the last frame."""
    begin, rate = scene.frame_current, scene.render.fps / scene.render.fps_base
    last = begin
    for part, piece in zip(parts, pieces):
        times = np.array([time for time, _, _ in piece.path])
        frames = begin + 1 + times * rate
        places = np.array([at for _, at, _ in piece.path]) / unit
        turns = np.array([turn for _, _, turn in piece.path])
        for i in range(1, len(turns)):
            if turns[i] @ turns[i - 1] < 0:
                turns[i] = -turns[i]
        # A piece rests in the whole until the break.
        frames = np.concatenate([[begin], frames])
        places = np.concatenate([[np.array(part.location)], places])
        turns = np.concatenate([[[1.0, 0, 0, 0] if turns[0][0] >= 0 else [-1.0, 0, 0, 0]], turns])
        _key(part, "location", frames, places)
        _key(part, "rotation_quaternion", frames, turns)
        last = max(last, int(np.ceil(frames[-1])))
    scene.frame_end = max(scene.frame_end, last)
    return last


def as_rigid_bodies(scene, parts, pieces, unit, material):
    """Makes each piece a rigid body of its mass, which leaves the current frame with the velocities of the break."""
    world = rigid_world(scene)
    begin, step = scene.frame_current, scene.render.fps_base / scene.render.fps
    world.point_cache.frame_start = min(world.point_cache.frame_start, begin)
    world.point_cache.frame_end = max(world.point_cache.frame_end, scene.frame_end)
    for part, piece in zip(parts, pieces):
        world.collection.objects.link(part)
        rigid = part.rigid_body
        rigid.type = "ACTIVE"
        rigid.mass = max(piece.mass, 1e-3)
        rigid.collision_shape = "CONVEX_HULL"
        rigid.friction, rigid.restitution = material
        rigid.use_margin = True
        rigid.collision_margin = 0.0
        frames = begin + np.arange(LED + 1)
        after = np.arange(LED + 1) * step
        places = (piece.center + after[:, None] * piece.linear) / unit
        speed = float(np.linalg.norm(piece.angular))
        axis = piece.angular / speed if speed > 0 else np.array([0.0, 0, 1])
        turns = np.array([Quaternion(axis, speed * time) for time in after])
        _key(part, "location", frames, places)
        _key(part, "rotation_quaternion", frames, turns)
        rigid.kinematic = True
        rigid.keyframe_insert("kinematic", frame=begin)
        rigid.kinematic = False
        rigid.keyframe_insert("kinematic", frame=begin + LED + 1)


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
    half = 20 * size
    mesh = bpy.data.meshes.new(GROUND_NAME)
    # A slab: pieces that are led fast do not pass through it.
    corners = [(x, y, z) for z in (0.0, -2 * size) for x, y in ((-half, -half), (half, -half), (half, half), (-half, half))]
    mesh.from_pydata(corners, [], [(0, 1, 2, 3), (7, 6, 5, 4), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)])
    ground = bpy.data.objects.new(GROUND_NAME, mesh)
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
