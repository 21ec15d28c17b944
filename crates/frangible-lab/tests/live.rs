//! Bodies that vibrate from tick to tick.

use frangible::glam::Vec3;
use frangible::internals::asset::AssetParts;
use frangible::{Body, Breakable, Material};
use frangible_bake::mode_field::mode_on_fracture_mesh;
use frangible_bake::{BakeSpec, MeshSize, Shape, bake};
use frangible_lab::bench::haptic::live::{LiveModes, SurfacePlace};

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
