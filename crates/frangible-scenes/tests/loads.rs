//! Loads that are no impact: steady forces against beam theory, and friction.

use std::sync::Arc;

use crate::common::{self, blow, glass, pieces, stone_floor};
use frangible::glam::Vec3;
use frangible::internals::{Force, rest};
use frangible::{
    Asset, Body, Breakable, Contact, FractureConfig, Material, Outcome, impact, would_break,
};
use frangible_bake::{BakeSpec, Region, Shape, Support, bake};

const GRAVITY: Vec3 = Vec3::new(0.0, 0.0, -9.81);

/// A bar 0.4 × 0.04 × 0.01 m of strength 40 MPa; its ends held or free.
fn bar(supports: Vec<Support>) -> Body {
    let shape = Shape::block([0.4, 0.04, 0.01]);
    let spec = BakeSpec {
        modes: 120,
        supports,
        ..BakeSpec::new("bar", shape, Material::preset("glass").unwrap())
    };
    Breakable::uniform(bake(&spec).unwrap()).unwrap().body(1)
}

fn unculled() -> FractureConfig {
    let mut config = FractureConfig::default();
    config.culling = false;
    config
}

/// Force up at both ends, twice that down in the middle, spread over lines across the bar.
fn three_points(force: f32) -> Vec<Force> {
    let line = |x: f32, z: f32, total: f32| {
        (0..8).map(move |i| Force {
            point: Vec3::new(x, 0.0025 * (2.0 * i as f32 - 7.0), z),
            force: Vec3::Z * total / 8.0,
        })
    };
    line(-0.19, -0.005, force)
        .chain(line(0.19, -0.005, force))
        .chain(line(0.0, 0.005, -2.0 * force))
        .collect()
}

#[test]
fn a_bar_bent_by_three_forces_has_the_stress_of_beam_theory() {
    let body = bar(Vec::new());
    // σ = M c / I = F a · 6 / (b h²), F at distance a on either side.
    let force = 5.0;
    let expected = f64::from(force) * 0.19 * 6.0 / (0.04 * 0.01 * 0.01);
    let outcome = rest(&body, &three_points(force), GRAVITY, &unculled()).unwrap();
    let peak = outcome.report().peak_stress;
    // Centroids of weak tetrahedra lie below the surface, and 120 modes round the corner of the bending moment:
    // measured 0.88.
    println!("stress {:.3} of beam theory's", peak / expected);
    assert!(
        (0.8..1.0).contains(&(peak / expected)),
        "{peak} Pa, not {expected} Pa"
    );
    assert!(matches!(outcome, Outcome::Held { .. }));
}

#[test]
fn a_shelf_holds_less_than_its_strength_and_breaks_under_more() {
    let low = Vec3::new(0.0, -1.0, -1.0).as_dvec3();
    let ends = [(0.0, 0.02), (0.38, 0.4)].map(|(from, to)| {
        let high = Vec3::ONE.as_dvec3();
        Support::clamped(Region::Box {
            low: low.with_x(from),
            high: high.with_x(to),
        })
    });
    let body = bar(ends.into());
    let config = FractureConfig::default();
    let middle = Vec3::new(0.0, 0.0, 0.005);
    let load = |newton: f32| {
        let force = Force {
            point: middle,
            force: Vec3::NEG_Z * newton,
        };
        rest(&body, &[force], GRAVITY, &config).unwrap()
    };
    let mut last = f64::INFINITY;
    let mut broke_at = None;
    for k in 0..12 {
        let newton = 4.0 * 2.0_f32.powi(k);
        match load(newton) {
            Outcome::Held { margin, report, .. } => {
                println!("{newton} N: margin {margin:.2}, {:?}", report.looked_at);
                assert!(broke_at.is_none(), "held {newton} N after it broke");
                assert!(margin < last, "{newton} N: margin {margin}, {last} before");
                last = margin;
            }
            Outcome::Broke(fracture) => {
                println!("{newton} N: {} pieces", fracture.fragments.len());
                broke_at.get_or_insert(newton);
            }
            _ => unreachable!(),
        }
    }
    // Clamped beam: σ = 6 F L / (8 b h²) at the middle and at both ends: 40 MPa at 600 N; centroids see less.
    let broke_at = broke_at.unwrap();
    assert!((300.0..2500.0).contains(&broke_at), "{broke_at} N");
    // A load that grows slowly finds the first weak point, and the shelf falls in a few pieces.
    let (mut holds, mut breaks) = (broke_at / 2.0, broke_at);
    while breaks / holds > 1.02 {
        let middle = (holds * breaks).sqrt();
        match load(middle) {
            Outcome::Held { .. } => holds = middle,
            _ => breaks = middle,
        }
    }
    let fracture = load(breaks);
    println!("{breaks:.0} N: {} pieces", pieces(&fracture));
    assert!((2..=40).contains(&pieces(&fracture)));
}

/// A push along −x at the rim from outside is the same load whether it comes as normal impulse or as friction.
#[test]
fn friction_pushes_as_a_normal_impulse_does() {
    let asset: &Asset = glass();
    let body = Breakable::uniform(Arc::clone(glass())).unwrap().body(1);
    // Of a given impulse: one that is integrated is an outcome, and friction goes with it.
    let mut config = FractureConfig::with_given_impulses();
    config.culling = false;
    let point = common::rim_point(asset, 0.0);
    let plain = blow(asset, point, Vec3::NEG_Z, 1.0, stone_floor());
    let rubbed = Contact {
        friction: Vec3::NEG_X * 0.5 * plain.impulse,
        ..plain.clone()
    };
    let (a, b) = (
        impact(&body, std::slice::from_ref(&plain), &config).unwrap(),
        impact(&body, std::slice::from_ref(&rubbed), &config).unwrap(),
    );
    assert!(b.report().peak_elastic_energy > 1.1 * a.report().peak_elastic_energy);
    let tilted = plain.whole_impulse() + rubbed.friction;
    let as_normal = Contact {
        normal: tilted,
        impulse: tilted.length(),
        ..plain.clone()
    };
    let mut free = config.clone();
    free.admissible_duration = false;
    let energy = |c: Contact| {
        impact(&body, std::slice::from_ref(&c), &free)
            .unwrap()
            .report()
            .peak_elastic_energy
    };
    // Only the duration differs, by what the direction changes of the effective mass.
    assert!((energy(as_normal) / energy(rubbed) - 1.0).abs() < 0.3);
    assert!(
        !would_break(
            &body,
            &[Contact {
                impulse: 0.0,
                ..plain.clone()
            }],
            &config
        )
        .unwrap()
    );
}
