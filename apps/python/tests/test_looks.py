"""Colours, texture coordinates, materials and names of the file that was baked."""

from pathlib import Path

import frangible as fr
import numpy as np
import pytest

# A tile whose colours are (x, y, z) over its sides, its first texture coordinates (x, y), its second (2 y, z).
TILE = Path(__file__).parents[3] / "crates/frangible/tests/bodies/tile.frangible"
SIDES = np.array([0.1, 0.1, 0.006])


def check(drawn: fr.Drawn) -> None:
    outside = drawn.faces[~drawn.is_fracture_face]
    place = drawn.vertices / SIDES + 0.5
    used = np.unique(outside)
    assert drawn.colors is not None
    np.testing.assert_allclose(drawn.colors[used, :3], place[used], atol=0.02)
    np.testing.assert_allclose(drawn.uvs[0][used], place[used, :2], atol=0.02)
    np.testing.assert_allclose(drawn.uvs[1][used], place[used, 1:] * [2, 1], atol=0.04)
    inside = np.unique(drawn.faces[drawn.is_fracture_face])
    assert (drawn.colors[inside] == 1).all()
    assert (drawn.material[drawn.is_fracture_face] == -1).all()
    np.testing.assert_allclose(np.linalg.norm(drawn.normals, axis=1), 1, atol=1e-4)


def test_fragments_have_the_looks_of_the_mesh() -> None:
    body = fr.load(TILE)
    looks = body.looks
    assert looks is not None and looks.name == "painted tile"
    glaze, clay = looks.materials
    assert (glaze.name, clay.name) == ("glaze", "clay")
    assert glaze.double_sided and not clay.double_sided
    assert glaze.emission == (0.5, 0.25, 0.0)
    assert (glaze.blending, glaze.alpha_cutoff, clay.alpha_cutoff) == ("mask", 0.75, None)
    (texture,) = glaze.textures
    assert (texture.slot, texture.uv_set, texture.wrap) == ("base_color", 1, ("clamp", "mirror"))
    image = looks.images[texture.image]
    assert (image.name, image.type, image.data[:4]) == ("glaze.png", "image/png", b"\x89PNG")

    whole = body.drawn
    check(whole)
    assert not whole.is_fracture_face.any() and set(whole.material) == {0, 1}
    outcome = body.impact(fr.Contact((0, 0, 0.003), (0, 0, -1), 25.0, fr.Striker(mass=0.13)), seed=3)
    assert len(outcome.fragments) > 1
    area = 0.0
    for number in range(len(outcome.fragments)):
        drawn = outcome.drawn(number)
        check(drawn)
        a, b, c = drawn.vertices[drawn.faces[drawn.material == 0]].transpose(1, 0, 2)
        area += np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2
    # The glaze is the front.
    assert area == pytest.approx(0.01, rel=1e-3)
    with pytest.raises(ValueError, match="there is no fragment"):
        outcome.drawn(len(outcome.fragments))
    piece = outcome.piece(0)
    assert piece.looks == looks
    with pytest.raises(ValueError, match="drawn by the outcome"):
        _ = piece.drawn


def test_a_file_is_baked_with_its_looks_and_arrays_have_none(tmp_path: Path) -> None:
    vertices, faces = fr.box(*SIDES)
    lines = ["o painted"]
    for x, y, z in vertices:
        red, green, blue = np.array([x, y, z]) / SIDES + 0.5
        lines.append(f"v {x} {y} {z} {red} {green} {blue}")
    lines += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in faces]
    path = tmp_path / "painted.obj"
    path.write_text("\n".join(lines))
    body = fr.bake(path, material="porcelain", tetrahedra=1500, modes=10)
    colors = body.drawn.colors
    assert colors is not None
    # 0 and 1 are the same in sRGB and in linear light.
    np.testing.assert_allclose(colors[:, :3], body.drawn.vertices / SIDES + 0.5, atol=0.02)
    plain = fr.bake(vertices, faces, material="porcelain", tetrahedra=1500, modes=10)
    assert plain.looks is None and plain.drawn.colors is None
    np.testing.assert_array_equal(plain.frequencies, body.frequencies)
