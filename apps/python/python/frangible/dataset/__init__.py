"""Datasets of broken objects, from meshes, materials and blows, for research on reassembly.

    frangible dataset cup.obj vase.glb -o data --material porcelain --breaks 20

makes, under ``data``:

- ``breaking_bad/CATEGORY/OBJECT/fractured_K/piece_N.obj`` in the layout of the Breaking Bad dataset, with no other files in these folders; pieces are at their
  original positions, largest first; ``breaking_bad/CATEGORY.{train,val}.txt``, and copies of them in ``data_split`` list the objects, each in one of the two splits;
- ``meta/CATEGORY/OBJECT/fractured_K.json``: the blow, the energies, the masses, and the contact area of adjacent pieces; ``.npz`` beside it: the same pieces
  in float64 with the exact neighbour of each face;
- ``manifest/SHARD.jsonl``: a row for each break with the SHA-256 of its files, or with the reason why it failed.

Existing breaks are not made again, so an interrupted run continues where it stopped. ``--shard 2/8`` processes the third eighth of the
objects, ``--workers 8`` uses eight processes, and ``--ray`` distributes the objects over a Ray cluster.
Lengths are in metres, or with ``--normalized`` in units of the longest side of each body, as in Breaking Bad; JSON and ``.npz`` stay in
metres. ``--hdf5`` also writes ``garf.hdf5`` in the format of GARF, with exact ``shared_faces``. You choose the licence of the data; we
suggest CC0.
"""

from .files import breaks, split_of, touching, write_splits
from .garf import write_hdf5
from .plan import Plan, objects
from .program import main
from .run import Summary, break_object, make

__all__ = [
    "Plan",
    "Summary",
    "break_object",
    "breaks",
    "main",
    "make",
    "objects",
    "split_of",
    "touching",
    "write_hdf5",
    "write_splits",
]
