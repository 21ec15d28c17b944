"""Breaks a surface with Blender's Cell Fracture: blender --background --python cells.py -- SURFACE.obj SEEDS.json RUNS OUT.obj

Prints RESULT and a line of JSON: processor seconds of each run, or why it cannot be had. The pieces go to OUT.obj, one object each.
"""

import json
import random
import sys
import time

import addon_utils
import bpy

ADD_ON = "object_fracture_cell"


def main():
    surface, seeds, runs, out = sys.argv[sys.argv.index("--") + 1 :]
    if addon_utils.enable(ADD_ON) is None:
        return {"skipped": f"Blender {bpy.app.version_string} comes without the add-on Cell Fracture"}
    for known in list(bpy.data.objects):
        bpy.data.objects.remove(known)
    body = add("body", *read(surface))
    with open(seeds, encoding="ascii") as file:
        points = add("seeds", json.load(file), [])
    points.parent = body
    seconds, pieces = [], []
    for _ in range(int(runs)):
        for piece in pieces:
            bpy.data.objects.remove(piece)
        bpy.ops.object.select_all(action="DESELECT")
        body.select_set(True)
        bpy.context.view_layer.objects.active = body
        random.seed(1)
        start = time.process_time()
        bpy.ops.object.add_fracture_cell_objects(source={"VERT_CHILD"}, source_limit=0)
        seconds.append(time.process_time() - start)
        pieces = [piece for piece in bpy.data.objects if piece not in (body, points)]
    write(out, pieces)
    return {"seconds": seconds, "version": bpy.app.version_string}


def add(name, vertices, triangles):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices, [], triangles)
    made = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(made)
    return made


def read(path):
    vertices, triangles = [], []
    with open(path, encoding="ascii") as file:
        for line in file:
            words = line.split()
            if words[:1] == ["v"]:
                vertices.append([float(word) for word in words[1:4]])
            elif words[:1] == ["f"]:
                triangles.append([int(word) - 1 for word in words[1:4]])
    return vertices, triangles


def write(path, pieces):
    before = 1
    with open(path, "w", encoding="ascii") as file:
        for number, piece in enumerate(pieces):
            mesh = piece.data
            mesh.calc_loop_triangles()
            file.write(f"o piece{number}\n")
            file.writelines("v " + " ".join(repr(c) for c in vertex.co) + "\n" for vertex in mesh.vertices)
            for triangle in mesh.loop_triangles:
                file.write("f " + " ".join(str(v + before) for v in triangle.vertices) + "\n")
            before += len(mesh.vertices)


print("\nRESULT", json.dumps(main()), flush=True)
