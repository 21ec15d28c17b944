# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings of the panel, stored in the scene."""

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty, StringProperty

BRITTLE = [
    ("glass", "Glass", "Annealed window glass, bottles and tumblers with handling damage"),
    ("porcelain", "Porcelain", "Cups, plates and piggy banks"),
    ("brick", "Brick", "Fired clay"),
    ("concrete", "Concrete", "Normal concrete without reinforcement"),
    ("marble", "Marble", "Statues and table tops"),
    ("ice", "Ice", "Fresh-water ice at -10 °C"),
    ("sugar", "Sugar", "Boiled sweets and stunt bottles"),
    ("chocolate", "Chocolate", "Dark chocolate at room temperature"),
    ("pmma", "Acrylic", "Cast acrylic sheet"),
    # A .blend file remembers the place in this list: what is new comes last.
    ("glass-new", "Glass, new", "With its surface as it left the factory"),
    ("glass-abraded", "Glass, worn", "Old windows, and tumblers after years of use"),
    ("tempered-glass", "Glass, tempered", "Side windows of cars and shower doors; panes only"),
    ("laminated-glass", "Glass, laminated", "Windscreens and shop fronts; panes only"),
    ("heat-strengthened-glass", "Glass, heat-strengthened", "Facades; panes only"),
]
STRIKING = [
    ("steel", "Steel", "A steel ball"),
    ("stone", "Stone", "A granite pebble"),
    ("wood", "Wood", "A ball of oak"),
    ("rubber", "Rubber", "A rubber ball"),
]


def is_mesh(_settings, candidate):
    return candidate.type == "MESH"


def is_empty(_settings, candidate):
    return candidate.type == "EMPTY"


class FrangibleSettings(bpy.types.PropertyGroup):
    """The settings of the panel, from top to bottom."""

    target: PointerProperty(
        name="Object", type=bpy.types.Object, poll=is_mesh, description="Mesh that will break. Empty: the active object"
    )
    material: EnumProperty(name="Material", items=BRITTLE, default="glass", description="Material of the object")
    wall: FloatProperty(
        name="Wall", min=0, default=0, unit="LENGTH", precision=4, description="Thickness of a wall along the mesh. 0 for a solid body"
    )
    tetrahedra: IntProperty(
        name="Detail",
        min=500,
        max=500_000,
        default=15_000,
        description="Number of tetrahedra of the fracture mesh. More are finer and slower",
    )
    modes: IntProperty(
        name="Modes",
        min=10,
        max=400,
        default=100,
        description="Number of vibration modes. More represent sharper blows and take longer to bake",
    )
    keep: BoolProperty(
        name="Keep bakes beside the .blend",
        default=False,
        description="Save each baked body in the folder frangible-bodies beside the saved .blend file",
    )
    file: StringProperty(
        name="Baked body",
        subtype="FILE_PATH",
        description="A .frangible file to use instead of a bake. It must match the shape, size and orientation of the object",
    )
    place: EnumProperty(
        name="Place",
        items=[
            ("CURSOR", "3D cursor", "Hit the surface nearest to the 3D cursor, along the inward normal"),
            ("EMPTY", "Empty", "Hit the surface where the -Z axis of an empty meets it, along that axis"),
        ],
        default="CURSOR",
        description="How the position of the blow is chosen",
    )
    empty: PointerProperty(name="Empty", type=bpy.types.Object, poll=is_empty, description="Empty whose -Z axis is the direction of the striker")
    mass: FloatProperty(name="Mass", default=0.5, min=0, precision=3, description="Mass of the striker, kg")
    radius: FloatProperty(name="Radius", default=0.025, min=0, precision=4, description="Radius of curvature of the striker at the contact, m")
    striker: EnumProperty(name="Striker", items=STRIKING, default="steel", description="Material of the striker")
    speed: FloatProperty(name="Speed", default=8.0, min=0, precision=2, description="Speed of the striker at the impact, m/s")
    weakness: StringProperty(name="Weak where", description="Vertex group whose weight marks where the object is weak")
    weakest: FloatProperty(
        name="Strength there", default=0.2, min=0.01, max=1, subtype="FACTOR", description="Remaining share of the strength where the weight is 1"
    )
    seed: IntProperty(name="Seed", default=1, min=0, description="Random seed for the weak points, and so for the shape of the pieces")
    motion: EnumProperty(
        name="Pieces",
        items=[
            ("KEYFRAMES", "Keyframes", "Frangible simulates the pieces, which fall on the ground at z = 0, and writes keyframes"),
            ("RIGID", "Rigid bodies", "Blender's rigid-body simulation moves the pieces, starting with the velocities of the break"),
            ("STILL", "Still", "Pieces do not move"),
        ],
        default="KEYFRAMES",
        description="How the pieces move after the break",
    )
    seconds: FloatProperty(name="Seconds", default=3, min=0.1, max=60, description="Length of the simulation that is written as keyframes, s")
    ground: BoolProperty(name="Ground at z = 0", default=True, description="Add a ground plane for the rigid bodies")
    inside: PointerProperty(name="Inside", type=bpy.types.Material, description="Material of the crack faces. Empty: a plain material is created")
    # Results of the last operator, line by line.
    found: StringProperty()
    sheet: StringProperty()


def target_of(context):
    """The object that will break, or None."""
    active = context.active_object
    return context.scene.frangible.target or (active if active is not None and active.type == "MESH" else None)
