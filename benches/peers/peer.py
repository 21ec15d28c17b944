"""One run of one peer in a process of its own: peer.py MESHER SURFACE SIZE [HOLE x y z]

SIZE is TetGen's largest volume of a tetrahedron, m³, or fTetWild's edge length, m. Prints RESULT and a line of JSON.
"""

import json
import sys
import time

from quality import figures
from surfaces import read_obj

# TetGen's -q: largest ratio of circumradius to shortest edge, and the smallest dihedral angle, which is what we promise.
RADIUS_EDGE_RATIO, SMALLEST_DIHEDRAL = 1.5, 10.0
# TetGen's -o and -O: left alone it only works on angles above 177 degrees; this gives it better angles in the same time.
WORTH_IMPROVING, FLIP_LEVEL, ROUNDS = 160.0, 9, 9


def tetgen(vertices, triangles, size, hole):
    from tetgen import TetGen

    start = time.perf_counter()
    mesher = TetGen(vertices, triangles)
    if hole:
        mesher.add_hole(hole)
    nodes, tets, *_ = mesher.tetrahedralize(
        plc=True,
        quality=True,
        minratio=RADIUS_EDGE_RATIO,
        mindihedral=SMALLEST_DIHEDRAL,
        fixedvolume=True,
        maxvolume=size,
        optmaxdihedral=WORTH_IMPROVING,
        opt_max_flip_level=FLIP_LEVEL,
        opt_iterations=ROUNDS,
    )
    return nodes, tets, time.perf_counter() - start


def ftetwild(vertices, triangles, size, _hole):
    from pytetwild import tetrahedralize

    start = time.perf_counter()
    nodes, tets = tetrahedralize(vertices, triangles, edge_length_abs=size, num_threads=1)
    return nodes, tets, time.perf_counter() - start


def main():
    name, path, size, *hole = sys.argv[1:]
    mesher = {"TetGen": tetgen, "fTetWild": ftetwild}[name]
    nodes, tets, seconds = mesher(*read_obj(path), float(size), [float(c) for c in hole])
    if len(tets) == 0:
        sys.exit("no tetrahedra came out")
    print("\nRESULT", json.dumps({"seconds": seconds, **figures(nodes, tets)}), flush=True)


if __name__ == "__main__":
    main()
