# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators of the panel. Everything is computed before the file changes, so an error loses nothing."""

import math

import bpy
import numpy as np

from . import colours, motion, pieces
from .blow import blow_of
from .bodies import shape_of, target_body
from .breaking import pieces_of
from .played import SOON
from .settings import target_of
from .weakness import weakness_of

# Friction and restitution of rigid pieces.
SURFACE = (0.6, 0.1)


class Step(bpy.types.Operator):
    """Base class of the operators: `work` does the work, and its ValueError is shown to the user."""

    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        try:
            return self.work(context)
        except ValueError as error:
            self.report({"ERROR"}, " ".join(str(error).split()))
            return {"CANCELLED"}

    def told(self, context, *lines):
        """Writes lines below the buttons, and the last into the status bar."""
        context.scene.frangible.found = "\n".join(lines)
        self.report({"INFO"}, lines[-1])
        return {"FINISHED"}


class Progress:
    """A bake's progress at the mouse pointer."""

    def __init__(self, context):
        self.manager = context.window_manager

    def __enter__(self):
        self.manager.progress_begin(0, 100)
        return lambda _stage, share: self.manager.progress_update(int(100 * min(max(share, 0.0), 1.0)))

    def __exit__(self, *_):
        self.manager.progress_end()


def prepared(context):
    """Returns the object, its body with the painted weakness, and the blow set in the panel."""
    thing = target_of(context)
    shape = shape_of(context, thing)
    # What is wrong with the blow or the paint is said before the bake, which takes seconds.
    blow, weakness = blow_of(context, thing, shape), weakness_of(context, thing, shape)
    with Progress(context) as tell:
        target = target_body(context, thing, tell)
    return thing, target if weakness is None else weakness.weakened(target), blow


def about(target):
    """One line about a body."""
    body = target.body
    return f"{body.mass:.4g} kg of {body.material}, {body.tetrahedra} tetrahedra, lowest frequency {body.frequencies[0]:.0f} Hz"


def held(thing, target, blow, seed):
    """Returns the message about a blow that does not break the object."""
    speed = target.body.minimum_speed(blow.contact(target.center), seed)
    if math.isinf(speed):
        return f"The blow does not break {thing.name} at any speed up to 1000 m/s; use a harder or heavier striker."
    return f"The blow does not break {thing.name} at {blow.speed:.3g} m/s; at this point it takes {speed:.3g} m/s."


class FRANGIBLE_OT_bake(Step):
    """Bake the object: compute its tetrahedra and vibration modes. The other buttons bake automatically when needed"""

    bl_idname = "frangible.bake"
    bl_label = "Bake"
    bl_options = {"REGISTER"}

    def work(self, context):
        thing = target_of(context)
        with Progress(context) as tell:
            target = target_body(context, thing, tell)
        begin = "Baked" if target.fresh else "Already baked"
        return self.told(context, f"{begin}: {about(target)}")


class FRANGIBLE_OT_show_stress(Step):
    """Colour the object by the tensile stress that the blow would cause"""

    bl_idname = "frangible.show_stress"
    bl_label = "Show Stress"

    def work(self, context):
        thing, target, blow = prepared(context)
        seed = context.scene.frangible.seed
        contact = blow.contact(target.center)
        stresses = colours.tension(target, blow, seed)
        shares = stresses / (target.body.strength * target.left)
        margin = target.body.margin(contact, seed)
        speed = target.body.minimum_speed(contact, seed)
        colours.write_stress(context, thing, target, stresses, shares)
        colours.show(context, thing, target, stresses, shares)
        lines = [
            f"{about(target)}",
            f"Tensile stress up to {stresses.max() / 1e6:.3g} MPa; strength {target.body.strength / 1e6:.3g} MPa",
        ]
        if np.ndim(target.left):
            lines.append(f"With the painted weakness the stress is up to {shares.max():.3g} times the strength there")
        slowest = "It does not break up to 1000 m/s" if math.isinf(speed) else f"It breaks from {speed:.3g} m/s"
        lines.append(f"{slowest}; margin {margin:.3g} at {blow.speed:.3g} m/s")
        return self.told(context, *lines)


class FRANGIBLE_OT_hide_stress(Step):
    """Remove the coloured surface and show the object again"""

    bl_idname = "frangible.hide_stress"
    bl_label = "Hide Stress"

    def work(self, context):
        thing = target_of(context)
        if thing is None or not colours.clear(context.scene, thing):
            raise ValueError("No stress is shown for this object; press Show Stress first.")
        return {"FINISHED"}


class FRANGIBLE_OT_break(Step):
    """Break the object with the blow. The pieces go into a new collection, and the object is hidden"""

    bl_idname = "frangible.break_object"
    bl_label = "Break"

    def work(self, context):
        settings, scene = context.scene.frangible, context.scene
        thing, target, blow = prepared(context)
        seconds = settings.seconds if settings.motion == "KEYFRAMES" else SOON
        found = pieces_of(target, blow, settings.seed, settings, seconds)
        if not found:
            self.report({"WARNING"}, held(thing, target, blow, settings.seed))
            return {"CANCELLED"}
        unit = target.shape.unit
        outside = pieces.Outside(context, thing, target.shape)
        colours.clear(scene, thing)
        collection = bpy.data.collections.new(thing.name)
        scene.collection.children.link(collection)
        parts = pieces.piece_objects(thing, found, outside, settings, unit, collection)
        told = f"{len(found)} pieces, the largest {found[0].mass:.3g} kg, in the collection {collection.name}"
        if settings.motion == "RIGID":
            if settings.ground:
                motion.add_ground(scene, target.shape.size / unit)
            broke = motion.as_rigid_bodies(scene, thing, parts, found, unit, SURFACE)
            told += f"; the break is in frame {broke}"
        else:
            if settings.motion == "KEYFRAMES":
                motion.as_keyframes(scene, parts, found, unit)
            pieces.hide(thing)
        return self.told(context, about(target), told)


CLASSES = [FRANGIBLE_OT_bake, FRANGIBLE_OT_show_stress, FRANGIBLE_OT_hide_stress, FRANGIBLE_OT_break]
