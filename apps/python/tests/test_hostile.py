"""Arrays that nobody should give: each call returns, or says in one line of text what is wrong."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import frangible as fr
import numpy as np
import pytest

#: Calls of each entry.
CASES = 35
#: Numbers that arithmetic goes wrong with.
ODD = (np.nan, np.inf, -np.inf, 0.0, -0.0, -1.0, 5e-324, 1e-45, 1e-30, 3.5e38, 1e300, 2.0**31, 2.0**53)
#: Kinds of numbers, and what is none.
KINDS = ("f2", "f4", ">f8", "g", "i1", "u1", "i8", "u8", "?", "c16", "U5", "S3", "M8[s]", "m8[s]", "O")


class Rude:
    """What refuses to be an array."""

    def __array__(self, dtype: Any = None, copy: Any = None) -> np.ndarray:
        raise ValueError("no")


def hostile(rng: np.random.Generator, good: Any) -> Any:
    """A relative of an array that can be used: mostly none that can."""
    given = np.array(good)
    match rng.integers(13):
        case 0:
            return given.astype(KINDS[rng.integers(len(KINDS))])
        case 1:
            return np.zeros(rng.integers(0, 4, size=rng.integers(0, 5)), dtype=given.dtype)
        case 2:
            return np.array(rng.choice(ODD))
        case 3:
            return given[..., :-1] if rng.integers(2) else np.concatenate([given, given], axis=-1)
        case 4:
            return given.reshape(-1, 1) if rng.integers(2) else given[None]
        case 5:
            # Neither is contiguous.
            wide = np.repeat(given, 2, axis=-1)
            return wide[..., ::2] if rng.integers(2) else given[::-1, ...]
        case 6:
            return np.asfortranarray(given) if rng.integers(2) else np.broadcast_to(given.ravel()[0], given.shape)
        case 7:
            huge = given.astype(np.int64)
            huge.flat[rng.integers(huge.size)] = rng.choice([-1, 2**31, 2**32 - 1, 2**32, 2**62, -(2**63)])
            return huge
        case 8:
            others = (None, "text", b"\x00", {}, [], [[]], [1, [2, 3]], object(), Rude(), 7, 1j, ...)
            return others[rng.integers(len(others))]
        case 9:
            ragged = given.astype(object)
            ragged.flat[rng.integers(ragged.size)] = (None, "x", b"y", 10**400, 2**63, Rude())[rng.integers(6)]
            return ragged
        case 10:
            return given * rng.choice(ODD)
        case 11:
            structured = np.zeros(given.shape, dtype=[("a", "f8"), ("b", "i4")])
            return structured if rng.integers(2) else np.ma.masked_all(given.shape)
        case _:
            places = given.astype(np.float64)
            places.flat[rng.integers(places.size)] = rng.choice(ODD)
            return places


def entries(plate: fr.Body, blow: fr.Contact, tmp_path: Any) -> dict[str, tuple[list[Any], Callable[..., object]]]:
    """Everything that takes arrays: arrays that it can use, and what calls it."""
    vertices, faces = fr.box(0.1, 0.05, 0.05)
    outcome = plate.impact(replace(blow, speed=40.0))
    assert outcome.broke
    place, turn = [0.0, 0.0, 0.004], [0.0, 0.0, 0.0, 1.0]
    steel = fr.Striker(mass=0.1)

    def contact(point: Any, direction: Any) -> fr.Contact:
        return fr.Contact(point, direction, speed=2.0, striker=steel)

    def add(position: Any, rotation: Any, velocity: Any, spin: Any) -> None:
        fr.World(floor=None).add(plate, position, rotation, velocity, spin)

    def throw(start: Any, through: Any) -> None:
        world = fr.World(floor=None)
        world.add(plate, (0, 0, 0))
        world.throw(start, through, speed=5)

    def export(look_from: Any) -> None:
        world = fr.World(floor=None)
        world.add(plate, (0, 0, 0))
        world.export(tmp_path / "hostile.glb", look_from=look_from)

    def motions(*given: Any) -> object:
        return outcome.motions(*given)

    def striker(position: Any, linear: Any, inertia: Any) -> object:
        return outcome.motions(striker={"mass": 0.1, "position": position, "linear": linear, "inertia": inertia})

    down = [0.0, 0.0, -1.0]
    return {
        "bake": ([vertices, faces], lambda v, f: fr.bake(v, f, material="concrete", tetrahedra=1500, modes=6)),
        "impact": ([place, down], lambda *c: plate.impact(contact(*c))),
        "scripted": ([place, down], lambda *c: plate.impact(fr.Contact(*c, impulse=0.01, duration=1e-4))),
        "several": ([place, down], lambda *c: plate.impact([blow, contact(*c)])),
        "would_break": ([place, down], lambda *c: plate.would_break(contact(*c))),
        "margin": ([place, down], lambda *c: plate.margin(contact(*c))),
        "minimum_speed": ([place, down], lambda *c: plate.minimum_speed(contact(*c), tolerance=0.5)),
        "stress": ([place, down], lambda *c: plate.stress(contact(*c), time=1e-5)),
        "no contacts": ([place], plate.impact),
        "motions": ([place, turn, down, down], motions),
        "striker": ([place, down, np.eye(3) * 1e-5], striker),
        "weakened": (
            [np.ones(len(plate.vertices))] * 3,
            lambda *factors: plate.weakened(*factors).impact(replace(blow, speed=40.0)),
        ),
        "weakened": (
            [np.ones(len(plate.vertices))] * 3,
            lambda *factors: plate.weakened(*factors).impact(replace(blow, speed=40.0)),
        ),
        "offset": ([place], lambda offset: fr.Body(plate._kind, 1.0, offset)),
        "add": ([place, turn, down, down], add),
        "throw": ([place, down], throw),
        "export": ([place], export),
    }


@pytest.fixture(scope="module")
def small() -> fr.Body:
    """A block that breaks quickly."""
    return fr.bake(*fr.box(0.1, 0.05, 0.05), material="concrete", tetrahedra=1500, modes=10)


@pytest.mark.filterwarnings("ignore")
def test_hostile_arrays_are_refused_in_one_line_or_taken(small: fr.Body, blow: fr.Contact, tmp_path) -> None:
    rng = np.random.default_rng(20)
    taken = refused = 0
    wrong = []
    for name, (good, call) in entries(small, blow, tmp_path).items():
        for case in range(CASES):
            given = [hostile(rng, a) if rng.integers(len(good)) == 0 or i == case % len(good) else a for i, a in enumerate(good)]
            try:
                call(*given)
                taken += 1
            except (ValueError, TypeError) as error:
                refused += 1
                text = str(error)
                if not text or "\n" in text:
                    wrong.append((name, given, text))
            except BaseException as error:  # What the compiled part panics with is no Exception.
                wrong.append((name, given, repr(error)))
    assert not wrong, f"{len(wrong)} calls, of which the first: {wrong[:3]}"
    assert taken > 50 and refused > 300, f"{taken} taken, {refused} refused"
