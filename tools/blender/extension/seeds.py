# SPDX-License-Identifier: GPL-3.0-or-later
"""Nine variants of the break, one per seed, beside the object."""

import bpy
import numpy as np

from . import pieces
from .breaking import pieces_of
from .operators import Step, held, prepared

SHEET = "Frangible seeds"
COUNT = 9
# Distance from one variant to the next, and how far pieces are moved apart, as shares of the object's size.
APART = 1.5
EXPLODED = 0.18


def clear_sheet(scene):
    """Removes the nine variants. Returns whether there were any."""
    scene.frangible.sheet = ""
    sheet = bpy.data.collections.get(SHEET)
    if sheet is None:
        return False
    pieces.remove_collection(sheet)
    return True


def entries(scene):
    """The seeds of the sheet with their numbers of pieces."""
    words = [word.split(":") for word in scene.frangible.sheet.split()]
    return [(int(seed), int(count)) for seed, count in words]


class FRANGIBLE_OT_nine_seeds(Step):
    """Break the object with nine seeds and place the variants beside it for comparison"""

    bl_idname = "frangible.nine_seeds"
    bl_label = "Nine Seeds"

    def work(self, context):
        scene, settings = context.scene, context.scene.frangible
        thing, target, blow = prepared(context)
        seeds = range(settings.seed, settings.seed + COUNT)
        variants = {seed: pieces_of(target, blow, seed, settings) for seed in seeds}
        if not any(variants.values()):
            self.report({"WARNING"}, held(thing, target, blow, settings.seed))
            return {"CANCELLED"}
        outside = pieces.Outside(context, thing, target.shape)
        clear_sheet(scene)
        sheet = bpy.data.collections.new(SHEET)
        scene.collection.children.link(sheet)
        size, unit = target.shape.size, target.shape.unit
        inside = pieces.inside_material(settings)
        for place, (seed, found) in enumerate(variants.items()):
            row, column = divmod(place, 3)
            at = target.center + APART * size * np.array([column + 1.0, 1.0 - row, 0.0])
            _variant(sheet, thing, seed, found, outside, inside, at, size, unit)
        settings.sheet = " ".join(f"{seed}:{len(found)}" for seed, found in variants.items())
        counts = ", ".join(f"{seed}: {len(found)}" for seed, found in variants.items())
        return self.told(context, f"Pieces by seed: {counts}")


def _variant(sheet, thing, seed, found, outside, inside, at, size, unit):
    """A collection with one object, the pieces moved apart, and its seed below it."""
    collection = bpy.data.collections.new(f"{thing.name} seed {seed}")
    sheet.children.link(collection)
    if found:
        middle = sum(piece.mass * piece.center for piece in found) / sum(piece.mass for piece in found)
        offsets = [(1 + EXPLODED) * (piece.center - middle) for piece in found]
        mesh = pieces.piece_mesh(f"{thing.name} seed {seed}", found, outside, inside, unit, offsets)
        variant = bpy.data.objects.new(f"{thing.name} seed {seed}", mesh)
        variant.location = at / unit
        variant["frangible_seed"] = seed
        collection.objects.link(variant)
    text = bpy.data.curves.new(f"{thing.name} seed {seed} text", "FONT")
    text.body = f"{seed}: {len(found)} pieces" if found else f"{seed}: not broken"
    text.size, text.align_x = 0.14 * size / unit, "CENTER"
    label = bpy.data.objects.new(text.name, text)
    low = float(outside.places[:, 2].min()) + outside.origin[2]
    label.location = (at[0] / unit, (at[1] - 0.6 * size) / unit, (low + 0.01 * size) / unit)
    collection.objects.link(label)


class FRANGIBLE_OT_pick_seed(Step):
    """Use this seed and remove the nine variants"""

    bl_idname = "frangible.pick_seed"
    bl_label = "Pick Seed"

    seed: bpy.props.IntProperty(name="Seed", min=0)

    def work(self, context):
        if self.seed not in dict(entries(context.scene)):
            raise ValueError(f"Seed {self.seed} is not among the nine; press Nine Seeds first.")
        context.scene.frangible.seed = self.seed
        clear_sheet(context.scene)
        return {"FINISHED"}


class FRANGIBLE_OT_clear_seeds(Step):
    """Remove the nine variants and keep the seed"""

    bl_idname = "frangible.clear_seeds"
    bl_label = "Clear"

    def work(self, context):
        if not clear_sheet(context.scene):
            raise ValueError("There are no variants; press Nine Seeds first.")
        return {"FINISHED"}


CLASSES = [FRANGIBLE_OT_nine_seeds, FRANGIBLE_OT_pick_seed, FRANGIBLE_OT_clear_seeds]
