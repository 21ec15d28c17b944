//! Tests of the haptic example: equal bits in every run, forces that only push, the tick at which pieces part, and vibration that goes on between ticks.

use frangible::glam::Vec3;
use frangible::internals::asset::AssetParts;
use frangible::{Body, Breakable, FractureConfig, Material};
use frangible_bake::mode_field::mode_on_fracture_mesh;
use frangible_bake::{BakeSpec, MeshSize, Shape, bake};
use frangible_lab::bench::subjects::steel_ball;

use crate::judge::DELAY;
use crate::live::{LiveModes, SurfacePlace};
use crate::touch::{Felt, Kind, Probe, Touch};

const RADIUS: f32 = 0.0158;

/// A plate of glass 100 × 100 × 5 mm, coarse.
fn plate() -> Breakable {
    let size = |edge| Some(MeshSize { edge, layers: 1 });
    let spec = BakeSpec {
        modes: 40,
        analysis: size(0.0125),
        fracture: size(0.006),
        ..BakeSpec::new(
            "plate",
            Shape::plate(0.1, 0.1, 0.005),
            Material::preset("glass").unwrap(),
        )
    };
    Breakable::uniform(bake(&spec).unwrap()).unwrap()
}

fn touch(kind: &Breakable) -> Touch {
    let probe = Probe {
        radius: RADIUS,
        striker: steel_ball(0.13).unwrap(),
        stiffness: 20e3,
        damping: 30.0,
    };
    Touch::new(kind.body(1), probe, &FractureConfig::default()).unwrap()
}

/// A head of 130 g that falls on the plate at this speed, m/s, for so many ticks.
fn fall(touch: &mut Touch, speed: f32, ticks: usize) -> Vec<Felt> {
    let mut position = Vec3::new(0.01, 0.007, 0.0025 + RADIUS + 0.004);
    let mut velocity = Vec3::NEG_Z * speed;
    (0..ticks)
        .map(|_| {
            let felt = touch.tick(position, velocity).unwrap();
            touch.judge().hand_over();
            velocity += felt.force * (1e-3 / 0.13);
            position += velocity * 1e-3;
            felt
        })
        .collect()
}

#[test]
fn a_light_tap_is_pushed_back_and_breaks_nothing() {
    let felt = fall(&mut touch(&plate()), 0.2, 80);
    let touched: Vec<&Felt> = felt.iter().filter(|f| f.force != Vec3::ZERO).collect();
    assert!(touched.len() > 3, "{}", touched.len());
    for felt in touched {
        assert!(felt.force.z > 0.0 && felt.force.truncate().length() < 1e-3 * felt.force.z);
        // The surface gives way from the head, by less than a tenth of a millimetre.
        assert!(felt.at_rest.z < 0.0 && felt.displacement.length() < 1e-4);
    }
    let blow = |f: &&Felt| matches!(f.kind, Kind::Blow | Kind::Asked);
    assert_eq!(felt.iter().filter(blow).count(), 1);
    assert!(felt.iter().all(|f| f.pieces.is_none()));
}

#[test]
fn a_hard_blow_breaks_and_its_pieces_are_there_at_a_known_tick() {
    let kind = plate();
    let felt = fall(&mut touch(&kind), 9.0, 120);
    let at = |wanted: Kind| felt.iter().position(|f| f.kind == wanted);
    let blow = at(Kind::Asked).expect("it lands");
    let verdict = at(Kind::Verdict).expect("pieces");
    assert_eq!(verdict, blow + DELAY as usize);
    let fracture = felt[verdict].pieces.as_ref().expect("it breaks");
    assert!(fracture.fragments.len() > 1);
    // Nothing is left to touch.
    let after = &felt[verdict + 1..];
    assert!(
        after
            .iter()
            .all(|f| f.force == Vec3::ZERO && f.kind == Kind::Free)
    );
}

#[test]
fn two_runs_feel_the_same_bits() {
    let kind = plate();
    let bits = |felt: &Felt| {
        let numbers = [felt.force, felt.displacement, felt.at_rest];
        (felt.kind, numbers.map(|v| v.to_array().map(f32::to_bits)))
    };
    let run = || {
        let felt = fall(&mut touch(&kind), 9.0, 120);
        let pieces: Vec<_> = felt
            .iter()
            .filter_map(|f| f.pieces.as_ref())
            .flat_map(|fracture| &fracture.fragments)
            .map(|fragment| fragment.mesh.positions.clone())
            .collect();
        (felt.iter().map(bits).collect::<Vec<_>>(), pieces)
    };
    let (first, second) = (run(), run());
    assert!(!first.1.is_empty());
    assert_eq!(first, second);
}

/// A pane of glass 300 × 200 × 6 mm, 40 modes.
fn pane() -> Body {
    let spec = BakeSpec {
        modes: 40,
        analysis: Some(MeshSize {
            edge: 0.025,
            layers: 1,
        }),
        fracture: Some(MeshSize {
            edge: 0.012,
            layers: 1,
        }),
        ..BakeSpec::new(
            "pane",
            Shape::plate(0.3, 0.2, 0.006),
            Material::preset("glass").unwrap(),
        )
    };
    let asset = bake(&spec).unwrap();
    Breakable::uniform(asset).unwrap().body(1)
}

#[test]
fn a_steady_push_ends_at_the_static_displacement() {
    let body = pane();
    let place = SurfacePlace::nearest(&body, Vec3::new(0.05, 0.03, 0.01)).unwrap();
    assert!((place.normal - Vec3::Z).length() < 1e-5);
    assert!((place.position - Vec3::new(0.05, 0.03, 0.003)).length() < 1e-5);
    let mut live = LiveModes::new(&body, 1e-3).unwrap();
    for _ in 0..20_000 {
        live.push(&place, Vec3::NEG_Z);
        live.step();
    }
    let (now, rest) = (live.displacement(&place), live.static_displacement(&place));
    // A force never moves the place it acts on against itself.
    assert!(rest.z < 0.0);
    assert!((now - rest).length() < 1e-4 * rest.length(), "{now} {rest}");
    // Σ φ φᵀ f / λ once more, from the modes as they are drawn.
    let node = |p: &Vec3| (*p - place.position).length_squared();
    let positions = &body.asset().fracture().positions;
    let corner = (0..positions.len())
        .min_by(|&a, &b| node(&positions[a]).total_cmp(&node(&positions[b])))
        .unwrap();
    let there = SurfacePlace::nearest(&body, positions[corner]).unwrap();
    let mut live = LiveModes::new(&body, 1e-3).unwrap();
    live.push(&there, Vec3::NEG_Z);
    live.step();
    let modes = body.asset().modes();
    let expected: Vec3 = (0..modes.count())
        .map(|i| {
            let phi = mode_on_fracture_mesh(body.asset(), i).displacements[corner];
            phi * (-phi.z / modes.eigenvalues[i] as f32)
        })
        .sum();
    let found = live.static_displacement(&there);
    assert!(
        (found - expected).length() < 1e-3 * expected.length(),
        "{found} {expected}"
    );
}

#[test]
fn vibration_holds_the_work_that_was_done_on_it() {
    let mut material = Material::preset("glass").unwrap();
    material.stiffness_damping = 0.0;
    material.mass_damping = 0.0;
    let asset = (**pane().asset()).clone();
    let body = Breakable::uniform(frangible::Asset::from_parts(AssetParts {
        material,
        ..asset.into_parts()
    }))
    .unwrap()
    .body(1);
    let place = SurfacePlace::nearest(&body, Vec3::new(0.1, 0.06, 0.003)).unwrap();
    // A tick of a twentieth of the highest mode's period, so that the trapezoidal rule serves for the work.
    let highest = body.asset().modes().frequency(39);
    let tick = 0.05 / highest;
    let mut live = LiveModes::new(&body, tick).unwrap();
    let (mut work, mut before) = (0.0, 0.0);
    for k in 1..=400 {
        let force = if k < 200 {
            Vec3::new(1.0, 0.5, -10.0) * (k as f32 * 0.05).sin()
        } else {
            Vec3::ZERO
        };
        live.push(&place, force);
        live.step();
        let power = f64::from(force.dot(live.velocity(&place)));
        work += 0.5 * (before + power) * tick;
        before = power;
    }
    let energy = live.energy();
    assert!(
        energy > 0.0 && (work / energy - 1.0).abs() < 0.02,
        "{work} {energy}"
    );
}

#[test]
fn ticks_and_places_that_mean_nothing_are_refused() {
    let body = pane();
    for tick in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(LiveModes::new(&body, tick).is_err(), "{tick}");
    }
    assert!(SurfacePlace::nearest(&body, Vec3::new(0.0, f32::NAN, 0.0)).is_err());
}
