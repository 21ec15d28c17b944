"""Weakness that varies over a body: one factor for each tetrahedron, from what a caller finds convenient."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .arrays import Floats, shown

Factor = ArrayLike | Callable[[Floats], ArrayLike]


def factors_of(given: Factor, name: str, vertices: Floats, tets: NDArray[np.uint32], *, zero: bool = False) -> Floats:
    """The factor of each tetrahedron (t,): of a number, of one for each vertex (n,), or of a function of the middles (t, 3)."""
    if callable(given):
        places, of = vertices[tets].mean(axis=1), "place"
        values = _numbers(given(places), f"what {name} returned", len(places), of)
    else:
        places, of = vertices, "vertex"
        values = _numbers(given, name, len(vertices), of)
    # The compiled part has 32 bits for each: what is too large or too small for them is said here.
    with np.errstate(over="ignore", under="ignore"):
        single = values.astype(np.float32)
    wrong = np.flatnonzero(~(np.isfinite(single) & ((single >= 0) if zero else (single > 0))))
    if len(wrong):
        at = int(wrong[0])
        x, y, z = places[at]
        bound = "from 0" if zero else "above 0"
        raise ValueError(f"{name} is {values[at]:g} at {of} {at} ({x:.3g}, {y:.3g}, {z:.3g}); give factors {bound} that fit into 32 bits")
    return values if of == "place" else values[tets].mean(axis=1)


def _numbers(given: ArrayLike, name: str, count: int, of: str) -> Floats:
    """One number for each, or the same for all."""
    try:
        values = np.asarray(given, dtype=np.float64)
    except (TypeError, ValueError, OverflowError) as error:
        raise ValueError(f"{name} is {shown(given)}; give a number, or one for each {of}") from error
    if values.shape not in ((), (count,)):
        raise ValueError(f"{name} has the shape {values.shape}; give a number, or ({count},), one for each {of}")
    return np.broadcast_to(values, (count,))
