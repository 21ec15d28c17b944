# SPDX-License-Identifier: GPL-3.0-or-later
"""A break as `frangible break` writes it, imported into Blender."""

import bpy
import mathutils

# Frames per second of the file's poses.
FRAME_RATE = 60

# Frames from the first crack to pieces on their way, as on the contact sheet.
ON_THEIR_WAY = 5

MOMENTS = ["before", "first-crack", "just-after", "at-rest"]

# What is smaller than this is hidden.
HIDDEN = 1e-4


class Recording:
    def __init__(self, path):
        scene = bpy.context.scene
        # Set before, so that keys come to lie on whole frames.
        scene.render.fps = FRAME_RATE
        bpy.ops.import_scene.gltf(filepath=str(path), merge_vertices=False)
        self.frame_rate = FRAME_RATE
        meshes = [thing for thing in bpy.data.objects if thing.type == "MESH"]
        self.floor = next((thing for thing in meshes if thing.name == "floor"), None)
        self.things = [thing for thing in meshes if thing is not self.floor]
        if not self.things:
            raise SystemExit(f"{path} has nothing to show")
        self.camera = next((thing for thing in bpy.data.objects if thing.type == "CAMERA"), None)
        # Lamps of a file are for viewers that have none of their own.
        for thing in [thing for thing in bpy.data.objects if thing.type == "LIGHT"]:
            bpy.data.objects.remove(thing)
        self.last_frame = max((int(action.frame_range[1]) for action in bpy.data.actions), default=0)

    def moment(self, name):
        """Seconds after the first frame."""
        appear = [frame for frame in map(self.first_frame, self.things) if frame > 0]
        crack = min(appear, default=self.last_frame)
        frames = {
            "before": max(0, crack - 1),
            "first-crack": crack,
            "just-after": min(crack + ON_THEIR_WAY, self.last_frame),
            "at-rest": self.last_frame,
        }
        return frames[name] / self.frame_rate

    @staticmethod
    def first_frame(thing):
        """The frame in which a thing is first seen: where its scale leaves zero."""
        for curve in curves(thing.animation_data):
            if curve.data_path == "scale":
                return next((int(key.co[0]) for key in curve.keyframe_points if key.co[1] > HIDDEN), 0)
        return 0

    def seen(self, at):
        """Corners of the boxes around the things seen at a time, each thing with its volume."""
        frame = at * self.frame_rate
        bpy.context.scene.frame_set(int(frame), subframe=frame - int(frame))
        boxes = []
        for thing in self.things:
            matrix = thing.matrix_world
            if max(matrix.to_scale()) > HIDDEN:
                corners = [matrix @ mathutils.Vector(corner) for corner in thing.bound_box]
                boxes.append((corners, thing.get("mass_kg", 0.0)))
        return boxes


def curves(data):
    """The curves of one thing: an action has those of many, each in a slot."""
    if data is None or data.action is None or data.action_slot is None:
        return []
    strips = (strip for layer in data.action.layers for strip in layer.strips)
    bags = (strip.channelbag(data.action_slot) for strip in strips)
    return [curve for bag in bags if bag is not None for curve in bag.fcurves]
