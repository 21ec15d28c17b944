# SPDX-License-Identifier: GPL-3.0-or-later
"""What a scene remembers of the panel."""

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty, StringProperty

BRITTLE = [
    ("glass", "Glass", "Annealed window glass, bottles and tumblers, handled as most are"),
    ("porcelain", "Porcelain", "Cups, plates and piggy banks"),
    ("brick", "Brick", "Fired clay"),
    ("concrete", "Concrete", "Normal concrete without reinforcement"),
    ("marble", "Marble", "Statues and table tops"),
    ("ice", "Ice", "Fresh-water ice at -10 °C"),
    ("sugar", "Sugar", "Boiled sweets and stunt bottles"),
    ("chocolate", "Chocolate", "Dark chocolate at room temperature"),
    ("pmma", "Acrylic", "Cast acrylic sheet"),
    # A .blend file remembers the place in this list: what is new comes last.
    ("glass-new", "Glass, new", "With the surface that it left the factory with"),
    ("glass-abraded", "Glass, worn", "Old windows, and tumblers after years of use"),
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
    """All that the panel asks for, from its top to its bottom."""

    target: PointerProperty(
        name="Object", type=bpy.types.Object, poll=is_mesh, description="Mesh that will break. Empty: the active object"
    )
    material: EnumProperty(name="Made of", items=BRITTLE, default="glass", description="What the object is made of, inside too")
    wall: FloatProperty(
        name="Wall", min=0, default=0, unit="LENGTH", precision=4, description="Thickness of a wall along the mesh. 0: the mesh encloses a solid"
    )
    tetrahedra: IntProperty(
        name="Detail",
        min=500,
        max=500_000,
        default=15_000,
        description="Number of tetrahedra that carry the cracks. More of them are finer and slower",
    )
    modes: IntProperty(
        name="Vibrations",
        min=10,
        max=400,
        default=100,
        description="Number of vibration modes. More of them follow sharper blows and are slower to bake",
    )
    keep: BoolProperty(
        name="Keep bakes beside the .blend",
        default=False,
        description="Write each baked body into the folder frangible-bodies beside the saved .blend",
    )
    file: StringProperty(
        name="Baked body",
        subtype="FILE_PATH",
        description="A .frangible file to use instead of a bake. It must have the object's shape, size and turn",
    )
    place: EnumProperty(
        name="Place",
        items=[
            ("CURSOR", "3D cursor", "The surface is hit next to the 3D cursor, straight inwards"),
            ("EMPTY", "Empty", "The surface is hit where the -Z axis of an empty meets it, along that axis"),
        ],
        default="CURSOR",
        description="What says where the blow lands",
    )
    empty: PointerProperty(name="Empty", type=bpy.types.Object, poll=is_empty, description="Its -Z axis is the way of the striker")
    mass: FloatProperty(name="Mass", default=0.5, min=0, precision=3, description="Mass of the striker, kg")
    radius: FloatProperty(name="Radius", default=0.025, min=0, precision=4, description="Radius of the striker where it touches, m")
    striker: EnumProperty(name="Striker", items=STRIKING, default="steel", description="What the striker is made of")
    speed: FloatProperty(name="Speed", default=8.0, min=0, precision=2, description="How fast the striker arrives, m/s")
    weakness: StringProperty(name="Weak where", description="Vertex group that is painted where the object is weak")
    weakest: FloatProperty(
        name="Strength there", default=0.2, min=0.01, max=1, subtype="FACTOR", description="Share of the strength that is left where the weight is 1"
    )
    seed: IntProperty(name="Seed", default=1, min=0, description="Another seed has other weak points and so other pieces")
    motion: EnumProperty(
        name="Pieces",
        items=[
            ("KEYFRAMES", "Keyframes", "Frangible moves the pieces, which fall on the ground at z = 0, and the result is keyframes"),
            ("RIGID", "Rigid bodies", "Blender's own rigid bodies move the pieces, which begin with the velocities of the break"),
            ("STILL", "Still", "Pieces stay where they are"),
        ],
        default="KEYFRAMES",
        description="What moves the pieces after the break",
    )
    seconds: FloatProperty(name="Seconds", default=3, min=0.1, max=60, description="Length of the simulation that becomes keyframes, s")
    ground: BoolProperty(name="Ground at z = 0", default=True, description="Add a ground that rigid pieces fall on")
    inside: PointerProperty(name="Inside", type=bpy.types.Material, description="Material of crack faces. Empty: a plain one is made")
    # What the last operators found, line by line.
    found: StringProperty()
    sheet: StringProperty()


def target_of(context):
    """The object that will break, or None."""
    active = context.active_object
    return context.scene.frangible.target or (active if active is not None and active.type == "MESH" else None)
