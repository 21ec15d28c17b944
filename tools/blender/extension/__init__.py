# SPDX-License-Identifier: GPL-3.0-or-later
"""Frangible in Blender: objects that break where and as hard as they are hit."""

import bpy

from . import bodies, operators, panel, seeds, settings

CLASSES = [settings.FrangibleSettings, *operators.CLASSES, *seeds.CLASSES, *panel.CLASSES]


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.Scene.frangible = bpy.props.PointerProperty(type=settings.FrangibleSettings)


def unregister():
    del bpy.types.Scene.frangible
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
    bodies.forget_all()
