"""Bakes, files and questions."""

import pickle
import threading
import time
from itertools import pairwise

import frangible as fr
import numpy as np
import pytest


def test_a_box_weighs_what_it_should(plate: fr.Body) -> None:
    assert plate.volume == pytest.approx(0.2 * 0.2 * 0.008, rel=0.02)
    assert plate.mass == pytest.approx(2500 * plate.volume, rel=0.02)
    sides = np.array([0.2, 0.2, 0.008])
    inertia = plate.mass / 12 * np.diag((sides**2).sum() - sides**2)
    np.testing.assert_allclose(plate.inertia, inertia, rtol=0.02, atol=1e-6)
    assert np.abs(plate.center).max() < 1e-6


def test_modes_are_those_of_a_thin_square_plate(plate: fr.Body) -> None:
    # Leissa, J. Sound Vib. 31, 1973: free square plate, lowest three of ν 0.3; 13.49, 19.79, 24.43 √(D/ρh)/a².
    young, poisson, density = 70e9, 0.23, plate.mass / plate.volume
    stiffness = young * 0.008**3 / 12 / (1 - poisson**2)
    unit = np.sqrt(stiffness / density / 0.008) / 0.2**2 / (2 * np.pi)
    assert plate.frequencies[0] == pytest.approx(13.49 * unit, rel=0.06)
    assert (np.diff(plate.frequencies) >= 0).all()
    modes = plate.modes
    assert modes.shape == (60, len(plate.vertices), 3)
    # Bending: the plate moves across itself.
    assert np.abs(modes[0, :, 2]).max() > 20 * np.abs(modes[0, :, 0]).max()


def test_the_place_of_the_mesh_is_known() -> None:
    vertices, faces = fr.box(1, 2, 3)
    body = fr.bake(vertices + [5, 6, 7], faces, size=0.3, material="concrete", tetrahedra=1500, modes=10)
    assert body.scale == pytest.approx(0.1)
    there = body.scale * (vertices + [5, 6, 7]) + body.offset
    np.testing.assert_allclose(there.min(axis=0), body.vertices.min(axis=0), atol=1e-3)
    np.testing.assert_allclose(there.max(axis=0), body.vertices.max(axis=0), atol=1e-3)


def test_other_kinds_of_numbers_are_taken() -> None:
    # Sides that both kinds of floating-point numbers hold exactly.
    vertices, faces = fr.box(0.125, 0.0625, 0.0625)
    bodies = [
        fr.bake(v, f, material="brick", tetrahedra=1500, modes=10)
        for v, f in ((vertices, faces), (vertices.astype(np.float32), faces.astype(np.int64)), (vertices.tolist(), faces.tolist()))
    ]
    for body in bodies[1:]:
        np.testing.assert_allclose(body.frequencies, bodies[0].frequencies, rtol=1e-5)


def test_files_and_pickles_keep_every_bit(plate: fr.Body, blow: fr.Contact, tmp_path) -> None:
    plate.save(tmp_path / "plate.frangible")
    loaded, pickled = fr.load(tmp_path / "plate.frangible"), pickle.loads(pickle.dumps(plate))
    want = plate.impact(blow, seed=3)
    for body in (loaded, pickled):
        got = body.impact(blow, seed=3)
        assert len(got.fragments) == len(want.fragments)
        for a, b in zip(got.fragments, want.fragments, strict=True):
            np.testing.assert_array_equal(a.vertices, b.vertices)
            np.testing.assert_array_equal(a.faces, b.faces)
    np.testing.assert_array_equal(pickled.offset, plate.offset)
    assert list(tmp_path.iterdir()) == [tmp_path / "plate.frangible"]


def test_the_slowest_speed_breaks_and_a_slower_one_does_not(plate: fr.Body, blow: fr.Contact) -> None:
    slowest = plate.minimum_speed(blow)
    at = lambda speed: fr.Contact(blow.point, blow.direction, speed, blow.striker)  # noqa: E731
    assert plate.would_break(at(slowest))
    assert not plate.would_break(at(0.98 * slowest))
    # The contact grows with the speed, so that the stress grows more slowly than it.
    margins = [plate.margin(at(share * slowest)) for share in (0.05, 0.1, 0.2, 0.4)]
    assert margins[-1] > 1
    for slow, fast in pairwise(margins):
        assert 1.2 < slow / fast < 2.1, margins
    assert plate.impact(at(0.05 * slowest)).margin <= margins[0] * (1 + 1e-6)
    light = fr.Contact(blow.point, blow.direction, 1, fr.Striker(mass=1e-9))
    assert plate.minimum_speed(light) == np.inf


def test_the_stress_is_that_of_the_blow(plate: fr.Body, blow: fr.Contact) -> None:
    times, tensions = plate.stress(blow)
    assert tensions.shape == (len(times), len(plate.faces))
    assert (np.diff(times) > 0).all()
    # What hit it pushes from above: it is torn below, and beyond its strength.
    middle = plate.vertices[plate.faces].mean(axis=1)
    peak = np.nanmax(tensions, axis=0)
    assert middle[np.nanargmax(peak), 2] < 0
    assert np.nanmax(peak) > plate.strength
    one, alone = plate.stress(blow, time=times[5])
    np.testing.assert_array_equal(alone[0], tensions[5])
    assert one == times[5:6]


def test_bodies_can_be_held() -> None:
    shelf = fr.bake(*fr.box(0.4, 0.1, 0.012), supports=["below:x:-0.18", "above:x:0.18"], tetrahedra=8000, modes=30)
    assert shelf.supported
    down = fr.Contact((0, 0, 0.006), (0, 0, -1), speed=6, striker=fr.Striker(mass=0.5))
    outcome = shelf.impact(down)
    assert outcome.broke and any(f.supported for f in outcome.fragments)


def test_a_bake_tells_how_far_it_is_and_can_be_stopped() -> None:
    told: list[tuple[str, float]] = []
    fr.bake(*fr.box(0.1, 0.1, 0.1), material="concrete", tetrahedra=1500, modes=10, progress=lambda *p: told.append(p))
    assert len({stage for stage, _ in told}) > 3
    assert all(0 <= share <= 1 for _, share in told)

    class Enough(Exception):
        pass

    def stop(stage: str, share: float) -> None:
        raise Enough(stage)

    with pytest.raises(Enough):
        fr.bake(*fr.box(0.1, 0.1, 0.1), progress=stop)


def test_the_interpreter_runs_on_during_a_bake() -> None:
    ticks = 0
    done = threading.Event()

    def count() -> None:
        nonlocal ticks
        while not done.is_set():
            ticks += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    fr.bake(*fr.box(0.1, 0.1, 0.1), material="concrete", tetrahedra=3000, modes=40)
    done.set()
    thread.join()
    assert ticks > 20


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"vertices": [[0, 0]]}, "shape"),
        ({"vertices": [[0, 0, np.nan], [1, 0, 0], [0, 1, 0]]}, "vertex 0"),
        ({"faces": [[0, 1, 99]]}, "99"),
        ({"faces": [[0.5, 1, 2]]}, "whole numbers"),
        ({"material": "cheese"}, "cheese"),
        ({"size": -1}, "size is -1"),
        ({"wall": 0}, "wall is 0"),
        ({"tetrahedra": 0}, "tetrahedra is 0"),
        ({"modes": 2.5}, "modes is 2.5"),
        ({"seed": -1}, "seed is -1"),
        ({"supports": "below"}, "below"),
        ({"supports": ["sphere:9,9,9,0.1"]}, "."),
        ({"vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "faces": [[0, 1, 2]]}, "."),
    ],
)
def test_what_cannot_be_baked_is_named(change: dict, words: str) -> None:
    vertices, faces = fr.box(0.1, 0.1, 0.1)
    with pytest.raises(ValueError, match=words):
        fr.bake(**{"vertices": vertices, "faces": faces, **change})


def test_wrong_files_are_named(tmp_path) -> None:
    with pytest.raises(ValueError, match="nowhere"):
        fr.load(tmp_path / "nowhere.frangible")
    (tmp_path / "torn.frangible").write_bytes(b"FRAN")
    with pytest.raises(ValueError, match="torn|short|file"):
        fr.load(tmp_path / "torn.frangible")
    with pytest.raises(ValueError):
        fr.bake(tmp_path / "nothing.obj")
    with pytest.raises(ValueError, match="faces are missing"):
        fr.bake([[0, 0, 0]])


def test_a_mesh_file_is_read(tmp_path) -> None:
    vertices, faces = fr.box(0.1, 0.2, 0.3)
    lines = [f"v {x} {y} {z}" for x, y, z in vertices] + [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in faces]
    (tmp_path / "box.obj").write_text("\n".join(lines))
    got, corners = fr.read_mesh(tmp_path / "box.obj")
    np.testing.assert_allclose(got, vertices, atol=1e-7)
    np.testing.assert_array_equal(corners, faces)


def test_separate_parts_are_bodies_of_their_own() -> None:
    places, corners = fr.box(0.06, 0.06, 0.04)
    far = places * 0.5 + (0.0, 0.08, 0.0)
    mesh = np.concatenate([places, far]), np.concatenate([corners, corners + len(places)])
    large, small = fr.bake_parts(*mesh, tetrahedra=3000, modes=8)
    assert large.mass == pytest.approx(8 * small.mass, rel=0.02)
    np.testing.assert_allclose(large.offset - small.offset, (0.0, 0.08, 0.0), atol=1e-3)
    with pytest.raises(ValueError, match="bake_parts|largest"):
        fr.bake(*mesh, tetrahedra=3000, modes=8)
    assert fr.bake(*mesh, tetrahedra=3000, modes=8, parts="largest").mass == pytest.approx(large.mass, rel=0.02)
