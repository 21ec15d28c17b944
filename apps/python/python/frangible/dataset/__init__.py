"""Datasets of broken things: meshes times materials times blows, for those who put pieces together again.

    frangible dataset cup.obj vase.glb -o data --material porcelain --breaks 20

makes, under ``data``:

- ``breaking_bad/CATEGORY/OBJECT/fractured_K/piece_N.obj`` in the layout of the Breaking Bad dataset, nothing else in these folders, pieces where they
  were in the body, largest first; ``breaking_bad/CATEGORY.{train,val}.txt``, and the same in ``data_split``, name the objects, each in one of the two;
- ``meta/CATEGORY/OBJECT/fractured_K.json``: the blow, the energies, the masses, who touches whom over which area; ``.npz`` beside it: the same pieces in
  float64 with the exact neighbour of each face;
- ``manifest/SHARD.jsonl``: a row for each break, the failed ones with the reason, with the SHA-256 of what was written.

A break that is there is not made again: a run that was killed goes on where it was. ``--shard 2/8`` does the third eighth of the objects,
``--workers 8`` has eight processes, ``--ray`` gives the objects to a Ray cluster.
Lengths are metres, or with ``--normalized`` the longest side of each body, as Breaking Bad has them; JSON and ``.npz`` stay in metres.
``--hdf5`` also writes ``garf.hdf5`` as GARF reads it, with exact ``shared_faces``. The data are yours to give: we suggest CC0.
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
