"""Bodies that break for physical reasons: where and as hard as they are hit.

A blow makes a body vibrate, the stress wave starts cracks at weak points, and cracks run until their energy is spent (after Glondu,
Marchal and Dumont, *Real-Time Simulation of Brittle Fracture Using Modal Analysis*, IEEE TVCG 2012, and beyond it).

    >>> import frangible as fr
    >>> plate = fr.bake(*fr.box(0.2, 0.2, 0.008), material="glass", tetrahedra=12000)
    >>> blow = fr.Contact(point=(0, 0, 0.004), direction=(0, 0, -1), speed=10.0, striker=fr.Striker(mass=0.1))
    >>> outcome = plate.impact(blow, seed=1)
    >>> outcome.broke, abs(sum(f.mass for f in outcome.fragments) / plate.mass - 1) < 1e-6
    (True, True)

Everything is in SI units and float64. The same input gives the same bits. A value that cannot be used is a ``ValueError`` that names it.
Datasets are made by ``frangible.dataset``.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from ._frangible import __version__
from .bodies import Body, Fatigue, bake, box, load, read_mesh
from .contacts import Contact, Striker
from .outcomes import Fragment, Motion, Outcome
from .world import Thing, World

if TYPE_CHECKING:
    from . import dataset as dataset

__all__ = [
    "Body",
    "Contact",
    "Fatigue",
    "Fragment",
    "Motion",
    "Outcome",
    "Striker",
    "Thing",
    "World",
    "__version__",
    "bake",
    "box",
    "load",
    "read_mesh",
]


def __getattr__(name: str) -> Any:
    """Datasets are imported where they are asked for: what they need takes longer to import than all the rest."""
    if name == "dataset":
        return import_module(".dataset", __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
