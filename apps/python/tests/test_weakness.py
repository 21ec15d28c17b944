"""Bodies that are weaker in places, or whose strength scatters otherwise."""

import pickle

import frangible as fr
import numpy as np
import pytest


@pytest.fixture(scope="module")
def bar() -> fr.Body:
    """A bar of porcelain of 0.3 m along x."""
    return fr.bake(*fr.box(0.3, 0.03, 0.03), material="porcelain", tetrahedra=6000, modes=60)


@pytest.fixture
def blow() -> fr.Contact:
    """A steel ball of 200 g, from above onto its middle."""
    return fr.Contact((0, 0, 0.015), (0, 0, -1), speed=4.0, striker=fr.Striker(mass=0.2))


def at(blow: fr.Contact, speed: float) -> fr.Contact:
    return fr.Contact(blow.point, blow.direction, speed, blow.striker)


def same(a: fr.Outcome, b: fr.Outcome) -> bool:
    return len(a.fragments) == len(b.fragments) and all(
        np.array_equal(x.vertices, y.vertices) and np.array_equal(x.faces, y.faces) for x, y in zip(a.fragments, b.fragments, strict=True)
    )


def crack_area(fragment: fr.Fragment, side: int) -> float:
    """Area of the crack faces on one side of x = 0, m²."""
    corners = fragment.vertices[fragment.faces[fragment.is_fracture_face]]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    return float(areas[side * corners.mean(axis=1)[:, 0] > 0].sum())


def pushed(impulse: float) -> fr.Contact:
    """A push from above onto the middle; its force does not depend on the body."""
    return fr.Contact((0, 0, 0.015), (0, 0, -1), impulse=impulse, duration=1e-4)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_half_the_strength_breaks_alike_under_half_the_push(bar: fr.Body, seed: int) -> None:
    # Stress is linear in the push, and energy its square, as the toughness is of the strength: with powers of two no bit differs.
    weak = bar.weakened(strength=0.5)
    plain, half = bar.impact(pushed(2.0), seed), weak.impact(pushed(1.0), seed)
    assert len(plain.fragments) > 5 and same(plain, half)
    assert half.report["first_crack_time"] == plain.report["first_crack_time"]
    assert half.report["fracture_energy"] == pytest.approx(plain.report["fracture_energy"] / 4)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_margin_and_slowest_speed_fall_as_the_strength(bar: fr.Body, blow: fr.Contact, seed: int) -> None:
    weak = bar.weakened(strength=0.5)
    margins = [bar.margin(at(blow, speed), seed) for speed in (0.15, 0.3)]
    assert weak.margin(at(blow, 0.3), seed) == pytest.approx(margins[1] / 2, rel=1e-5)
    # The stress of a ball rises as this power of its speed, a little less where it is faster: measured, the shares agree to 6 %.
    power = np.log2(margins[0] / margins[1])
    share = weak.minimum_speed(blow, seed, 0.002) / bar.minimum_speed(blow, seed, 0.002)
    assert share == pytest.approx(0.5 ** (1 / power), rel=0.07)


def test_a_tougher_body_cracks_no_earlier_and_breaks_later(bar: fr.Body, blow: fr.Contact) -> None:
    tough = bar.weakened(toughness=1000.0)
    # As strong and tougher means larger flaws, which feel less of a narrow peak.
    assert tough.margin(at(blow, 0.3)) > bar.margin(at(blow, 0.3))
    assert tough.minimum_speed(blow) > 5 * bar.minimum_speed(blow)


@pytest.mark.parametrize("side", [-1, 1])
def test_cracks_prefer_the_weak_half(bar: fr.Body, blow: fr.Contact, side: int) -> None:
    weak = bar.weakened(strength=lambda places: np.where(side * places[:, 0] > 0.02, 0.3, 1.0))
    areas = {-1: 0.0, 1: 0.0}
    for seed in range(5):
        for fragment in weak.impact(at(blow, 2.0), seed).fragments:
            for half in areas:
                areas[half] += crack_area(fragment, half)
    assert areas[side] > 3 * areas[-side] and areas[side] > 0.03**2


def test_where_there_are_no_weak_points_no_crack_starts(bar: fr.Body, blow: fr.Contact) -> None:
    none = bar.weakened(weak_points=0)
    assert none.minimum_speed(blow) == np.inf and not none.impact(at(blow, 50)).broke
    right = bar.weakened(weak_points=lambda places: places[:, 0] > 0)
    # A crack that branches goes over to the other side; the first of each seed does not, but for the reach of a tetrahedron: its middle
    # decides, and its flaw lies anywhere on a face.
    reach = 5e-3
    firsts = [right.impact(at(blow, 6.0), seed).report["first_crack_point"][0] for seed in range(8)]
    assert min(firsts) > -reach
    assert min(bar.impact(at(blow, 6.0), seed).report["first_crack_point"][0] for seed in range(8)) < -reach


def test_numbers_arrays_and_functions_say_the_same(bar: fr.Body, blow: fr.Contact) -> None:
    by_number = bar.weakened(strength=0.4).impact(blow)
    assert by_number.broke
    assert same(by_number, bar.weakened(strength=np.full(len(bar.vertices), 0.4)).impact(blow))
    assert same(by_number, bar.weakened(strength=lambda places: np.full(len(places), 0.4)).impact(blow))
    # What is linear is the same at a tetrahedron's middle as in the mean of its vertices, but for the rounding to 32 bits.
    slope = lambda places: 0.6 + 2 * places[:, 0]  # noqa: E731
    one, other = bar.weakened(strength=slope), bar.weakened(strength=slope(bar.vertices))
    assert one.margin(blow) == pytest.approx(other.margin(blow), rel=1e-5)


def test_weakness_adds_up_and_leaves_the_body_as_it_was(bar: fr.Body, blow: fr.Contact) -> None:
    before = bar.impact(blow)
    once = bar.weakened(strength=0.25, toughness=0.5, weak_points=3)
    twice = bar.weakened(strength=0.5, toughness=0.5).weakened(strength=0.5, toughness=1, weak_points=3)
    assert same(once.impact(blow), twice.impact(blow))
    assert same(before, bar.impact(blow)) and not same(before, once.impact(blow))
    assert same(before, bar.weakened(strength=2).weakened(strength=0.5).impact(blow))
    np.testing.assert_array_equal(once.offset, bar.offset)


def test_the_stress_is_not_changed_by_the_strength(bar: fr.Body, blow: fr.Contact) -> None:
    plain, weak = bar.stress(blow), bar.weakened(strength=0.5).stress(blow)
    for a, b in zip(plain, weak, strict=True):
        np.testing.assert_array_equal(a, b)


def test_pickles_keep_the_weakness_and_files_refuse_it(bar: fr.Body, blow: fr.Contact, tmp_path) -> None:
    weak = bar.weakened(strength=lambda places: 0.5 + places[:, 0])
    kept = pickle.loads(pickle.dumps(weak))
    assert same(weak.impact(blow), kept.impact(blow)) and weak.margin(blow) == kept.margin(blow) != bar.margin(blow)
    with pytest.raises(ValueError, match="save the body before it is weakened"):
        weak.save(tmp_path / "weak.frangible")
    assert not list(tmp_path.iterdir())


def things_after(body: fr.Body, speed: float) -> list[str]:
    world = fr.World(floor=None)
    world.add(body, position=(0, 0, 0))
    world.throw(start=(0, 0, 0.05), through=(0, 0, 0), speed=speed, mass=0.2)
    world.step(0.08)
    return [f"{thing.kind} {thing.mass} {thing.position}" for thing in world.things]


def test_a_world_minds_the_weakness(bar: fr.Body, blow: fr.Contact) -> None:
    weak = bar.weakened(strength=0.3)
    speed = 0.8 * bar.minimum_speed(blow)
    assert len(things_after(bar, speed)) == 2
    broken = things_after(weak, speed)
    assert len(broken) > 2
    assert things_after(pickle.loads(pickle.dumps(weak)), speed) == broken


def test_pieces_in_a_world_break_again_as_they_are_weak(bar: fr.Body) -> None:
    twice = []
    for body in (bar, bar.weakened(strength=0.3)):
        world = fr.World(generations=1)
        world.add(body, position=(0, 3, 0), rotation=(0, 0, 0.2, 0.9797959))
        world.step(2.5)
        twice.append(sum(thing.name.count("piece") == 2 for thing in world.things))
    assert twice[0] == 0 < twice[1]


def test_pieces_keep_the_weakness(bar: fr.Body) -> None:
    outcomes = bar.impact(pushed(1.0)), bar.weakened(strength=0.5).impact(pushed(0.5))
    strong, weak = (outcome.piece(0) for outcome in outcomes)
    np.testing.assert_array_equal(strong.vertices, weak.vertices)
    hit = fr.Contact((0, 0, 0.015), (0, 0, -1), speed=0.2, striker=fr.Striker(mass=0.05))
    assert strong.margin(hit) > 2
    assert weak.margin(hit) == pytest.approx(strong.margin(hit) / 2, rel=1e-5)
    with pytest.raises(ValueError, match="a piece cannot be weakened"):
        weak.weakened(strength=0.5)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"strength": 0}, r"strength is 0 at vertex 0 \(.*\); give factors above 0"),
        ({"strength": np.nan}, "strength is nan"),
        ({"toughness": 0}, r"toughness is 0 at vertex 0 \(.*\); give factors above 0"),
        ({"toughness": 1e300}, r"toughness is 1e\+300 .* fit into 32 bits"),
        ({"toughness": 1e-300}, r"toughness is 1e-300 .* fit into 32 bits"),
        ({"weak_points": -1}, "weak_points is -1 at vertex 0 .* from 0"),
        ({"strength": [0.5, 0.5]}, r"strength has the shape \(2,\); .*one for each vertex"),
        ({"strength": "strong"}, "strength is 'strong'"),
        ({"strength": lambda places: places}, r"the result of strength has the shape .* one for each place"),
        ({"strength": lambda places: places[:, 0]}, r"strength is -0\.\d+ at place \d+"),
        ({"strength": 1e-30}, "strength and toughness must be finite and above 0"),
    ],
)
def test_factors_that_cannot_be_used_are_named(bar: fr.Body, given: dict, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        bar.weakened(**given)


def test_the_strength_of_larger_specimens_makes_a_stronger_body(bar: fr.Body, blow: fr.Contact) -> None:
    margins = [bar.scattered(specimen=volume).margin(at(blow, 0.3)) for volume in (1e-5, 1e-4, 1e-3)]
    assert margins[0] < margins[1] < margins[2]
    assert bar.scattered().margin(blow) == bar.margin(blow)
    weak = bar.weakened(strength=0.5)
    assert weak.scattered(weibull_modulus=5).margin(blow) == bar.scattered(weibull_modulus=5).weakened(strength=0.5).margin(blow)


def test_pickles_keep_the_scatter_and_files_refuse_it(bar: fr.Body, blow: fr.Contact, tmp_path) -> None:
    other = bar.scattered(weibull_modulus=5, specimen=1e-6, fatigue=fr.Fatigue(20, 1e6, 1.3))
    kept = pickle.loads(pickle.dumps(other))
    assert other.margin(blow) == kept.margin(blow) != bar.margin(blow)
    assert other._kind.scatter() == kept._kind.scatter() == (5, 1e-6, [20, 1e6, 1.3])
    with pytest.raises(ValueError, match="save the body before its scatter is changed"):
        other.save(tmp_path / "other.frangible")
    assert not list(tmp_path.iterdir())
    bar.scattered().save(tmp_path / "bar.frangible")
    with pytest.raises(ValueError, match="a piece has no scatter of its own"):
        bar.impact(pushed(1.0)).piece(0).scattered(weibull_modulus=5)


def pieces_of_a_shelf(shelf: fr.Body, stone: fr.Body, duration: float) -> int:
    world = fr.World(floor=None, load_duration=duration)
    world.add(shelf, position=(0, 0, 0))
    world.add(stone, position=(0.12, 0.0531, 0))
    world.step(0.5)
    return sum(thing.kind == "piece" for thing in world.things)


def test_what_carries_for_a_second_may_not_carry_for_years() -> None:
    shelf = fr.bake(*fr.box(0.3, 0.006, 0.025), tetrahedra=6000, modes=60, supports=["box:-1,-1,-1,-0.12,1,1"])
    stone = fr.bake(*fr.box(0.1, 0.1, 0.1), material="marble", tetrahedra=1500, modes=20)
    years = 3e8
    assert pieces_of_a_shelf(shelf, stone, 1) == 0
    assert pieces_of_a_shelf(shelf, stone, years) > 1
    # The harder it is for a flaw to grow, the less it tires.
    assert pieces_of_a_shelf(shelf.scattered(fatigue=fr.Fatigue(150, 2e6, 1.52)), stone, years) == 0


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"weibull_modulus": 0.5}, "Weibull modulus is 0.5; .* 1 or above"),
        ({"weibull_modulus": np.inf}, "weibull_modulus is inf"),
        ({"specimen": 0}, "specimen is 0; give a number above 0"),
        ({"specimen": np.inf}, "specimen is inf"),
        ({"fatigue": fr.Fatigue(0, 2e6, 1.52)}, "fatigue exponent is 0"),
        ({"fatigue": fr.Fatigue(16, np.nan, 1.52)}, "fatigue.rate is nan"),
        ({"fatigue": fr.Fatigue(16, 2e6, 1)}, "inert strength over that of the slow test is 1"),
    ],
)
def test_scatter_that_cannot_be_used_is_named(bar: fr.Body, given: dict, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        bar.scattered(**given)


def test_a_deeper_groove_is_weaker_and_replaces_factors(bar: fr.Body) -> None:
    middle = np.abs(bar.vertices[:, 0]) < 0.01
    # Light enough that nothing cracks: cracks change the motion, and with it the largest stress.
    push = pushed(0.001)

    def margin(depth: float, **factors: float) -> float:
        return bar.weakened(groove=np.where(middle, depth, 0.0), **factors).margin(push, 1)

    plain, shallow, deep = bar.margin(push, 1), margin(2e-3), margin(8e-3)
    # A flaw of 2 mm lies below the strength of porcelain; its strength falls with the root of the depth, and with the remaining height.
    assert 1 < deep < 0.7 * shallow < 0.7 * plain
    again = bar.weakened(strength=3.0).weakened(groove=np.full(len(bar.vertices), 8e-3))
    assert again.margin(push, 1) <= deep * 1.001
    with pytest.raises(ValueError, match="groove is -1"):
        bar.weakened(groove=-1.0)
