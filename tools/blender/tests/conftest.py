# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes that the tests break, in Blender's Python without a window."""

import os
import re
import sys
from pathlib import Path

import bpy
import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import extension


@pytest.fixture(scope="session", autouse=True)
def registered():
    extension.register()
    yield
    extension.unregister()


def pytest_unconfigure(config):
    """Ends the process at once: Blender's package may wait for ever when Python ends."""
    status = getattr(config, "frangible_status", 1)
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(int(status))


def pytest_sessionfinish(session, exitstatus):
    session.config.frangible_status = exitstatus


@pytest.fixture
def scene():
    """An empty scene with quick settings."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    settings = scene.frangible
    settings.tetrahedra, settings.modes = 4000, 40
    settings.motion = "STILL"
    return scene


@pytest.fixture
def slab(scene):
    """A slab of glass of 0.2 x 0.16 x 0.02 m that hangs at 0.4 m, made by the object's scale, with the cursor on its top."""
    return add_slab(scene)


def add_slab(scene, z=0.4):
    bpy.ops.mesh.primitive_cube_add(size=1, location=(0.3, 0.1, z))
    thing = bpy.context.object
    thing.name, thing.scale = "Slab", (0.2, 0.16, 0.02)
    scene.cursor.location = (0.33, 0.12, z + 0.011)
    scene.frangible.mass, scene.frangible.radius, scene.frangible.speed = 0.5, 0.025, 10
    bpy.context.view_layer.update()
    return thing


def pieces_in(name):
    """The pieces of a collection, by their number."""
    return sorted(bpy.data.collections[name].objects, key=lambda part: int(re.search(r" piece (\d+)", part.name).group(1)))


def volume(part):
    """The volume that a mesh encloses, in its own units."""
    mesh = part.data
    mesh.calc_loop_triangles()
    places = np.array([vertex.co[:] for vertex in mesh.vertices], dtype=np.float64)
    corners = places[np.array([triangle.vertices[:] for triangle in mesh.loop_triangles])]
    return float(np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() / 6)


def shape_of_pieces(name):
    """What can be compared of the pieces of a break: places and masses."""
    return [(tuple(round(x, 6) for x in part.location), round(part["frangible_mass"], 9), len(part.data.vertices)) for part in pieces_in(name)]
