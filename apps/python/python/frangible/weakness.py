"""Locally varying weakness: one factor for each tetrahedron, from a number, an array or a function."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .arrays import Floats, shown

Factor = ArrayLike | Callable[[Floats], ArrayLike]


def factors_of(given: Factor, name: str, vertices: Floats, tets: NDArray[np.uint32], *, zero: bool = False) -> Floats:
    """Returns the factor of each tetrahedron (t,) from a number, an array of vertex factors (n,), or a function of the centroids (t, 3)."""
    if callable(given):
        places, of = vertices[tets].mean(axis=1), "place"
        values = _numbers(given(places), f"the result of {name}", len(places), of)
    else:
        places, of = vertices, "vertex"
        values = _numbers(given, name, len(vertices), of)
    # The compiled part stores 32 bits per factor; report here what does not fit.
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
    """Returns one number for each item, or the same number for all."""
    try:
        values = np.asarray(given, dtype=np.float64)
    except (TypeError, ValueError, OverflowError) as error:
        raise ValueError(f"{name} is {shown(given)}; give a number, or one for each {of}") from error
    if values.shape not in ((), (count,)):
        raise ValueError(f"{name} has the shape {values.shape}; give a number, or an array of shape ({count},) with one for each {of}")
    return np.broadcast_to(values, (count,))
