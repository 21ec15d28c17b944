# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel in the sidebar of the 3D view, worked from top to bottom."""

import bpy

from .bodies import metres
from .colours import view_name
from .seeds import entries
from .settings import target_of


class FRANGIBLE_PT_panel(bpy.types.Panel):
    bl_idname = "FRANGIBLE_PT_panel"
    bl_label = "Frangible"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Frangible"

    def draw(self, context):
        layout, settings = self.layout, context.scene.frangible
        layout.use_property_split = True
        layout.use_property_decorate = False
        thing = target_of(context)
        self.draw_object(layout.box(), context, settings, thing)
        self.draw_blow(layout.box(), settings)
        self.draw_stress(layout.box(), context, settings, thing)
        self.draw_seeds(layout.box(), context, settings)
        self.draw_break(layout.box(), settings)
        for line in settings.found.splitlines():
            layout.label(text=line)

    def draw_object(self, box, context, settings, thing):
        box.label(text="1. Object")
        box.prop(settings, "target")
        if thing is not None:
            unit = metres(context.scene)
            sides = " x ".join(f"{side * unit:.3g}" for side in thing.dimensions)
            box.label(text=f"{thing.name}: {sides} m")
        box.prop(settings, "file")
        if not settings.file:
            for name in ("material", "wall", "tetrahedra", "modes", "keep"):
                box.prop(settings, name)
        box.operator("frangible.bake")

    def draw_blow(self, box, settings):
        box.label(text="2. Blow")
        box.prop(settings, "place")
        if settings.place == "EMPTY":
            box.prop(settings, "empty")
        for name, text in (("striker", "Striker"), ("mass", "Mass, kg"), ("radius", "Radius, m"), ("speed", "Speed, m/s")):
            box.prop(settings, name, text=text)

    def draw_stress(self, box, context, settings, thing):
        box.label(text="3. Stress")
        if thing is not None:
            box.prop_search(settings, "weakness", thing, "vertex_groups")
            if settings.weakness:
                box.prop(settings, "weakest")
        row = box.row(align=True)
        row.operator("frangible.show_stress")
        if thing is not None and view_name(thing) in context.scene.objects:
            row.operator("frangible.hide_stress")

    def draw_seeds(self, box, context, settings):
        box.label(text="4. Seed")
        box.prop(settings, "seed")
        found = entries(context.scene)
        row = box.row(align=True)
        row.operator("frangible.nine_seeds")
        if found:
            row.operator("frangible.clear_seeds")
            grid = box.grid_flow(columns=3, row_major=True, even_columns=True, align=True)
            for seed, count in found:
                grid.operator("frangible.pick_seed", text=f"{seed}: {count}").seed = seed

    def draw_break(self, box, settings):
        box.label(text="5. Break")
        box.prop(settings, "inside")
        box.prop(settings, "motion")
        if settings.motion == "KEYFRAMES":
            box.prop(settings, "seconds")
        elif settings.motion == "RIGID":
            box.prop(settings, "ground")
        box.operator("frangible.break_object")


CLASSES = [FRANGIBLE_PT_panel]
