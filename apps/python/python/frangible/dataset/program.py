"""The command ``frangible dataset``."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from .garf import write_hdf5
from .plan import Plan
from .run import make


def _shard(text: str) -> tuple[int, int]:
    part, parts = text.split("/")
    return int(part), int(parts)


def _limits(text: str) -> tuple[int, int]:
    fewest, most = text.split("-")
    return int(fewest), int(most)


def main(words: Sequence[str]) -> int:
    """``frangible dataset``."""
    usual = Plan()
    parser = argparse.ArgumentParser(prog="frangible dataset", description="Make a dataset of broken meshes for research on reassembly.")
    parser.add_argument("meshes", nargs="+", type=Path, help="mesh files: OBJ, STL, PLY, glTF, GLB")
    parser.add_argument("-o", "--out", type=Path, required=True, help="output folder; existing breaks are not made again")
    parser.add_argument("--material", action="append", help="name of a material; repeat it to make several bodies of each mesh (default porcelain)")
    parser.add_argument("--breaks", type=int, default=usual.breaks, help="number of breaks of each body (default %(default)s)")
    parser.add_argument("--category", default=usual.category, help="name of the folder of the objects (default %(default)s)")
    parser.add_argument("--seed", type=int, default=usual.seed, help="random seed for all blows (default %(default)s)")
    parser.add_argument("--size", type=float, help="length of the longest side in m (default: meshes are in metres)")
    parser.add_argument("--wall", type=float, help="make a wall of this thickness along the mesh, in m (default: a solid body)")
    parser.add_argument("--pieces", type=_limits, default=usual.pieces, metavar="2-20", help="smallest and largest number of pieces (default 2-20)")
    parser.add_argument("--least-share", type=float, default=usual.least_share, help="smallest share of the body's volume that is a piece of its own (default %(default)s)")
    parser.add_argument("--tetrahedra", type=int, default=usual.tetrahedra, help="approximate number of tetrahedra of the fracture mesh (default %(default)s)")
    parser.add_argument("--shard", type=_shard, default=(0, 1), metavar="I/N", help="process every Nth object, starting with the Ith (default 0/1)")
    parser.add_argument("--workers", type=int, default=1, help="number of processes (default %(default)s)")
    parser.add_argument("--modes", type=int, default=usual.modes, help="number of vibration modes (default %(default)s)")
    parser.add_argument("--val-share", type=float, default=usual.val_share, help="share of the objects in the val split (default %(default)s)")
    parser.add_argument("--normalized", action="store_true", help="write OBJ and HDF5 in units of the longest side of each body, as in Breaking Bad, instead of metres")
    parser.add_argument("--ray", action="store_true", help="use a Ray cluster, or start one on this machine")
    parser.add_argument("--hdf5", action="store_true", help="also write garf.hdf5 with all categories in the folder")
    parser.add_argument("--quiet", action="store_true", help="print no progress")
    given = parser.parse_args(words)
    try:
        plan = Plan(
            materials=tuple(given.material or usual.materials),
            breaks=given.breaks,
            category=given.category,
            seed=given.seed,
            size=given.size,
            wall=given.wall,
            pieces=given.pieces,
            least_share=given.least_share,
            tetrahedra=given.tetrahedra,
            modes=given.modes,
            val_share=given.val_share,
            normalized=given.normalized,
        )
        summary = make(given.meshes, given.out, plan, shard=given.shard, workers=given.workers, ray=given.ray, quiet=given.quiet)
        if given.hdf5:
            write_hdf5(given.out, given.out / "garf.hdf5")
    except (ValueError, ImportError, OSError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    print(f"{summary.made} breaks made in {summary.seconds:.1f} s, {summary.there} already existed, {len(summary.failed)} failed")
    for row in summary.failed[:10]:
        print(f"failed: {row['object']} {row['break']}: {row['failed']}", file=sys.stderr)
    return 0
