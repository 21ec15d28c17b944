# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials of the file, with what one sees of them from close by."""

import bpy

# Edges are rounded by this, m: no edge of a real thing is sharp, and rounded ones gleam.
ROUNDING = 3e-4

# How high ridges of crack faces stand, m, and how far apart, 1/m.
RIDGES = {"glass": (4e-5, 900), "stone": (3e-4, 700)}


def dress(ridged):
    for material in bpy.data.materials:
        if not material.use_nodes or material.node_tree is None:
            continue
        shader = material.node_tree.nodes.get("Principled BSDF")
        if shader is None:
            continue
        clear = shader.inputs["Transmission Weight"].default_value > 0
        broken = "crack face" in material.name
        normal = rounded(material)
        if broken and ridged:
            normal = ridges(material, normal, *RIDGES["glass" if clear else "stone"])
        elif broken and clear:
            shader.inputs["Roughness"].default_value = 0.02
        if clear and broken and ridged:
            # Between the ridges a crack face of glass is a mirror.
            shader.inputs["Roughness"].default_value = 0.06
        material.node_tree.links.new(normal, shader.inputs["Normal"])
        grain(material, shader)


def rounded(material):
    bevel = material.node_tree.nodes.new("ShaderNodeBevel")
    bevel.samples = 4
    bevel.inputs["Radius"].default_value = ROUNDING
    return bevel.outputs["Normal"]


def ridges(material, normal, height, scale):
    """Hackle: ridges that waver along the way of the crack, finer ones on them."""
    nodes, links = material.node_tree.nodes, material.node_tree.links
    where = nodes.new("ShaderNodeTexCoord")
    noise = nodes.new("ShaderNodeTexNoise")
    noise.inputs["Scale"].default_value = scale
    noise.inputs["Detail"].default_value = 6
    noise.inputs["Distortion"].default_value = 1.5
    stretch = nodes.new("ShaderNodeMapping")
    stretch.inputs["Scale"].default_value = (1.0, 0.22, 1.0)
    links.new(where.outputs["Object"], stretch.inputs["Vector"])
    links.new(stretch.outputs["Vector"], noise.inputs["Vector"])
    bump = nodes.new("ShaderNodeBump")
    bump.inputs["Distance"].default_value = height
    bump.inputs["Strength"].default_value = 0.8
    links.new(noise.outputs["Fac"], bump.inputs["Height"])
    links.new(normal, bump.inputs["Normal"])
    return bump.outputs["Normal"]


def grain(material, shader):
    """Differences of colour of what is no glass, by the name of its material."""
    sizes = {"brick": (450, 0.45), "concrete": (260, 0.35), "marble": (28, 0.35), "chocolate": (90, 0.12)}
    for name, (scale, strength) in sizes.items():
        if not material.name.startswith(name):
            continue
        nodes, links = material.node_tree.nodes, material.node_tree.links
        color = tuple(shader.inputs["Base Color"].default_value)
        where = nodes.new("ShaderNodeTexCoord")
        noise = nodes.new("ShaderNodeTexNoise")
        noise.inputs["Scale"].default_value = scale
        noise.inputs["Detail"].default_value = 8
        noise.inputs["Distortion"].default_value = 2.0 if name == "marble" else 0.0
        links.new(where.outputs["Object"], noise.inputs["Vector"])
        ramp = nodes.new("ShaderNodeValToRGB")
        ramp.color_ramp.elements[0].position, ramp.color_ramp.elements[1].position = 0.35, 0.62
        ramp.color_ramp.elements[0].color = (*[part * (1 - strength) for part in color[:3]], 1)
        ramp.color_ramp.elements[1].color = (*[min(1.0, part * (1 + 0.4 * strength)) for part in color[:3]], 1)
        links.new(noise.outputs["Fac"], ramp.inputs["Fac"])
        links.new(ramp.outputs["Color"], shader.inputs["Base Color"])
