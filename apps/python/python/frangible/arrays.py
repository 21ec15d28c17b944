"""Validates arguments and converts them to arrays."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]


def shown(value: object) -> str:
    """Returns the value as one line of at most 80 characters."""
    text = " ".join(repr(value).split())
    return text if len(text) <= 80 else f"{text[:77]}..."


def vector(value: ArrayLike, name: str, count: int = 3) -> Floats:
    """Returns a vector of ``count`` finite numbers."""
    try:
        array = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError, OverflowError) as error:
        raise ValueError(f"{name} is {shown(value)}; give {count} finite numbers") from error
    if array.shape != (count,) or not np.isfinite(array).all():
        raise ValueError(f"{name} is {shown(value)}; give {count} finite numbers")
    return array


def number(value: float, name: str, least: float = 0.0, *, above: bool = False, infinite: bool = False) -> float:
    """Returns a number, checked against its bounds."""
    try:
        given = float(value)
    except OverflowError as error:
        raise ValueError(f"{name} is {shown(value)}; give a number that fits into 64 bits") from error
    fits = given > least if above else given >= least
    if math.isnan(given) or not fits or (math.isinf(given) and not infinite):
        raise ValueError(f"{name} is {value!r}; give a number {'above' if above else 'from'} {least:g}")
    return given


def rotation(value: ArrayLike, name: str) -> Floats:
    """Returns a quaternion x, y, z, w, normalised from a length close to 1."""
    array = vector(value, name, 4)
    length = float(np.linalg.norm(array))
    if abs(length - 1.0) > 1e-3:
        raise ValueError(f"{name} is {shown(value)}; give a quaternion x, y, z, w of length 1")
    return array / length


def mesh(vertices: ArrayLike, faces: ArrayLike) -> tuple[Floats, NDArray[np.uint32]]:
    """Returns vertices (n, 3) and triangles (m, 3) of vertex indices."""
    try:
        places = np.ascontiguousarray(vertices, dtype=np.float64)
    except OverflowError as error:
        raise ValueError("a vertex coordinate is too large; every coordinate must be a finite number") from error
    if places.ndim != 2 or places.shape[1] != 3 or len(places) == 0:
        raise ValueError(f"the vertices have shape {places.shape}; give shape (n, 3)")
    if not np.isfinite(places).all():
        row = int(np.flatnonzero(~np.isfinite(places).all(axis=1))[0])
        raise ValueError(f"vertex {row} is {places[row]}; every coordinate must be a finite number")
    corners = np.asarray(faces)
    if corners.ndim != 2 or corners.shape[1] != 3 or corners.dtype.kind not in "iu":
        raise ValueError(f"the faces have dtype {corners.dtype} and shape {corners.shape}; give whole numbers of shape (m, 3)")
    if len(corners) and (corners.min() < 0 or corners.max() >= len(places)):
        raise ValueError(f"the faces refer to vertices {corners.min()} to {corners.max()}; the valid range is 0 to {len(places) - 1}")
    return places, np.ascontiguousarray(corners, dtype=np.uint32)


def seed_of(seed: int) -> int:
    """Returns a seed, checked to be a whole number of 64 bits."""
    given = int(seed)
    if given != seed or not 0 <= given < 2**64:
        raise ValueError(f"the seed is {seed!r}; give a whole number from 0 to 2**64 - 1")
    return given


def rows(array: Floats, columns: int) -> Floats:
    """Returns a flat array as rows."""
    return array.reshape(-1, columns)


def strings(value: str | Sequence[str]) -> list[str]:
    """Returns one string or several as a list."""
    return [value] if isinstance(value, str) else [str(text) for text in value]
