"""Fragments, their neighbours and their motion."""

from collections import Counter

import frangible as fr
import numpy as np
import pytest


def test_fragments_tile_the_body_and_are_closed(plate: fr.Body, blow: fr.Contact) -> None:
    outcome = plate.impact(blow, seed=1)
    assert outcome.broke and len(outcome.fragments) > 3
    assert sum(f.mass for f in outcome.fragments) == pytest.approx(plate.mass, rel=1e-6)
    for f in outcome.fragments:
        assert f.vertices.dtype == np.float64 and f.faces.dtype == np.int32
        edges = Counter(tuple(e) for t in f.faces for e in zip(t, np.roll(t, -1), strict=True))
        assert all(n == 1 and edges[b, a] == 1 for (a, b), n in edges.items())
        a, b, c = (f.vertices[f.faces[:, k]] for k in range(3))
        cones = np.einsum("ij,ij->i", a, np.cross(b, c)) / 6
        assert cones.sum() == pytest.approx(f.volume, rel=1e-4)
        assert ((a + b + c) / 4 * cones[:, None]).sum(axis=0) / cones.sum() == pytest.approx(f.center, abs=1e-6)
        assert np.linalg.eigvalsh(f.inertia).min() > 0
        assert f.hulls and all(h.shape[1] == 3 and len(h) >= 4 for h in f.hulls)


def test_neighbours_have_the_same_faces_turned_round(plate: fr.Body, blow: fr.Contact) -> None:
    fragments = plate.impact(blow, seed=1).fragments
    assert all((f.neighbour >= -1).all() and (f.neighbour < len(fragments)).all() for f in fragments)
    for i, f in enumerate(fragments):
        assert f.is_fracture_face.any()
        np.testing.assert_array_equal(f.is_fracture_face, f.neighbour >= 0)
        for j in set(f.neighbour[f.is_fracture_face]):
            g = fragments[j]
            here = f.vertices[f.faces[f.neighbour == j]].mean(axis=1)
            there = g.vertices[g.faces[g.neighbour == i]].mean(axis=1)
            assert len(here) == len(there)
            # Each has its twin at the same place.
            near = np.linalg.norm(here[:, None] - there[None], axis=2).min(axis=1)
            assert near.max() < 1e-6


def test_the_report_says_where_the_energy_went(plate: fr.Body, blow: fr.Contact) -> None:
    report = plate.impact(blow).report
    assert 0 < report["fracture_energy"] <= report["peak_strain_energy"] <= report["approach_energy"] * 1.001
    assert report["approach_energy"] <= 0.5 * 0.1 * 10**2 * 1.001
    assert report["peak_stress"] >= report["strength"]
    contact = report["contacts"][0]
    # The impulse is what the force makes of time.
    total = contact["force"].sum() * report["time_step"]
    assert contact["impulse"] == pytest.approx(total, rel=0.1)


def test_the_report_says_in_which_order_cracks_start(plate: fr.Body, blow: fr.Contact) -> None:
    report = plate.impact(blow, seed=1).report
    starts = report["starts"]
    assert len(starts) == report["cracks"] > 3
    times = [start["time"] for start in starts]
    assert times == sorted(times) and times[0] == report["first_crack_time"]
    # The first crack's flaw lies anywhere on a face of its first tetrahedron, whose edges have some 5 mm.
    np.testing.assert_allclose(starts[0]["point"], report["first_crack_point"], atol=5e-3)
    assert all(start["tetrahedra"] > 0 for start in starts)


def test_momentum_stays_and_energy_does_not_rise(plate: fr.Body, blow: fr.Contact) -> None:
    outcome = plate.impact(blow, seed=1)
    ball = {"mass": 0.1, "position": [0, 0, 0.02], "linear": [0, 0, -10.0], "radius": 0.0145}
    pieces, struck = outcome.motions(striker=ball)
    assert struck is not None and len(pieces) == len(outcome.fragments)
    momentum = sum(f.mass * m.linear for f, m in zip(outcome.fragments, pieces, strict=True)) + 0.1 * struck.linear
    np.testing.assert_allclose(momentum, [0, 0, -1], atol=1e-9)
    energy = 0.05 * struck.linear @ struck.linear + 0.2 * 0.1 * 0.0145**2 * struck.angular @ struck.angular
    for f, m in zip(outcome.fragments, pieces, strict=True):
        energy += 0.5 * f.mass * m.linear @ m.linear + 0.5 * m.angular @ f.inertia @ m.angular
    assert energy + outcome.report["fracture_energy"] <= 5.0 * (1 + 1e-6)


def test_a_scripted_push_and_several_contacts(plate: fr.Body, blow: fr.Contact) -> None:
    push = fr.Contact((0, 0, 0.004), (0, 0, -2.0), impulse=1.6, duration=2e-4)
    assert plate.impact(push).broke
    other = fr.Contact((0.05, 0, 0.002), (0, 0, -1), speed=10, striker=fr.Striker(mass=0.1))
    assert len(plate.impact([blow, other]).report["contacts"]) == 2


def test_a_soft_blow_holds(plate: fr.Body, blow: fr.Contact) -> None:
    outcome = plate.impact(fr.Contact(blow.point, blow.direction, 0.05, blow.striker))
    assert not outcome.broke and outcome.fragments == [] and outcome.margin > 1
    assert "held" in repr(outcome)


def test_the_same_seed_gives_the_same_pieces(plate: fr.Body, blow: fr.Contact) -> None:
    one, again, other = (plate.impact(blow, seed=s) for s in (5, 5, 6))
    assert [f.mass for f in one.fragments] == [f.mass for f in again.fragments]
    assert [f.mass for f in one.fragments] != [f.mass for f in other.fragments]


def test_pieces_break_again(plate: fr.Body, blow: fr.Contact) -> None:
    outcome = plate.impact(blow, seed=1)
    fragment = outcome.fragments[0]
    piece = outcome.piece(0)
    assert piece.mass == pytest.approx(fragment.mass)
    np.testing.assert_allclose(piece.offset, -fragment.center)
    np.testing.assert_allclose(piece.vertices + fragment.center, fragment.vertices, atol=1e-6)
    assert piece.frequencies[0] > plate.frequencies[0]
    middle = piece.vertices[piece.faces].mean(axis=1)
    top = middle[np.argmax(middle[:, 2] - np.linalg.norm(middle[:, :2], axis=1))]
    again = piece.impact(fr.Contact(top, (0, 0, -1), speed=20, striker=fr.Striker(mass=0.1)))
    assert again.broke
    assert sum(f.mass for f in again.fragments) == pytest.approx(piece.mass, rel=1e-6)
    # Faces of the first break have no neighbour in the second.
    assert any(((f.neighbour == -1) & f.is_fracture_face).any() for f in again.fragments)
    with pytest.raises(ValueError, match="no fragment 9999"):
        outcome.piece(9999)
    with pytest.raises(ValueError, match="seed of the body"):
        piece.impact(blow, seed=2)
    with pytest.raises(ValueError, match="cannot be saved"):
        piece.to_bytes()


def test_trimesh_finds_them_closed(plate: fr.Body, blow: fr.Contact) -> None:
    pytest.importorskip("trimesh")
    outcome = plate.impact(blow)
    scene = outcome.to_trimesh()
    assert len(scene.geometry) == len(outcome.fragments)
    for mesh, fragment in zip(scene.geometry.values(), outcome.fragments, strict=True):
        assert mesh.is_watertight
        assert mesh.volume == pytest.approx(fragment.volume, rel=1e-4)
        np.testing.assert_array_equal(mesh.face_attributes["neighbour"], fragment.neighbour)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"speed": np.nan}, r"contacts\[0\].speed is nan"),
        ({"speed": None}, "has no speed"),
        ({"speed": -1}, "speed is -1"),
        ({"point": (0, 0)}, "point is"),
        ({"point": (0, 0, np.inf)}, "point is"),
        ({"direction": (0, 0, 0)}, "direction is zero"),
        ({"striker": "cheese"}, "cheese"),
        ({"striker": fr.Striker(mass=0)}, "mass is 0"),
        ({"striker": fr.Striker(mass=1, radius=-1)}, "radius is -1"),
        ({"striker": fr.Striker(restitution=2)}, "restitution is 2"),
        ({"impulse": 1.0}, "a speed and an impulse"),
        ({"speed": None, "impulse": 1.0}, "no duration"),
        ({"duration": 1e-3}, "duration is a result"),
    ],
)
def test_what_is_no_contact_is_named(plate: fr.Body, change: dict, words: str) -> None:
    given = {"point": (0, 0, 0.004), "direction": (0, 0, -1), "speed": 5.0, **change}
    with pytest.raises(ValueError, match=words):
        plate.impact(fr.Contact(**given))


def test_no_contact_at_all_is_an_error(plate: fr.Body) -> None:
    with pytest.raises(ValueError, match="no contact"):
        plate.impact([])
    with pytest.raises(ValueError, match="not a frangible.Contact"):
        plate.impact([(0, 0, 0)])
