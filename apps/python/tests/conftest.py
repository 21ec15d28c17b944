"""Bodies that several tests break."""

import frangible as fr
import pytest


@pytest.fixture(scope="session")
def plate() -> fr.Body:
    """A glass plate of 0.2 m, 8 mm thick."""
    return fr.bake(*fr.box(0.2, 0.2, 0.008), material="glass", tetrahedra=12000, modes=60)


@pytest.fixture(scope="session")
def blow() -> fr.Contact:
    """A steel ball of 100 g, from above onto its middle."""
    return fr.Contact((0, 0, 0.004), (0, 0, -1), speed=10.0, striker=fr.Striker(mass=0.1))
