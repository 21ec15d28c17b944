"""Physically based brittle fracture: bodies break where they are hit, and as hard as they are hit.

A blow makes a body vibrate, the stress wave starts cracks at weak points, and the cracks run until their energy is spent. The model extends
Glondu, Marchal and Dumont, *Real-Time Simulation of Brittle Fracture Using Modal Analysis*, IEEE TVCG 2012.

    >>> import frangible as fr
    >>> plate = fr.bake(*fr.box(0.2, 0.2, 0.008), material="glass", tetrahedra=12000)
    >>> blow = fr.Contact(point=(0, 0, 0.004), direction=(0, 0, -1), speed=10.0, striker=fr.Striker(mass=0.1))
    >>> outcome = plate.impact(blow, seed=1)
    >>> outcome.broke, abs(sum(f.mass for f in outcome.fragments) / plate.mass - 1) < 1e-6
    (True, True)

All quantities are float64 in SI units. The same input gives bit-identical results. An invalid value raises a ``ValueError`` that names it.
The module ``frangible.dataset`` makes datasets.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from ._frangible import __version__
from .bodies import Body, Fatigue, bake, bake_parts, box, load, read_mesh
from .contacts import Contact, Striker
from .drawn import Drawn, Image, Look, Looks, TextureUse
from .outcomes import Fragment, Motion, Outcome
from .world import Thing, World

if TYPE_CHECKING:
    from . import dataset as dataset

__all__ = [
    "Body",
    "Contact",
    "Drawn",
    "Fatigue",
    "Fragment",
    "Image",
    "Look",
    "Looks",
    "Motion",
    "Outcome",
    "Striker",
    "TextureUse",
    "Thing",
    "World",
    "__version__",
    "bake",
    "bake_parts",
    "box",
    "load",
    "read_mesh",
]


def __getattr__(name: str) -> Any:
    """Imports ``dataset`` on first use, because its dependencies take longer to import than everything else."""
    if name == "dataset":
        return import_module(".dataset", __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
