//! The ways to find how a piece vibrates, on pieces whose answer is known.

use std::sync::Arc;

use crate::common::{breakable, frequencies, whole};
use frangible::glam::Vec3;
use frangible::internals::Portion;
use frangible::{Body, Contact, FractureConfig, Material, Outcome, Striker, impact};
use frangible_bake::Shape;
use frangible_bake::pieces::{parent_modes, reanalysis};

/// Sides of the bar, m.
const BAR: [f64; 3] = [0.2, 0.03, 0.02];

fn bar() -> Body {
    breakable(Shape::block(BAR), "porcelain", 6_000.0, 30).body(1)
}

fn assert_near(found: &[f64], expected: &[f64], tolerance: f64, what: &str) {
    for (f, e) in found.iter().zip(expected) {
        let error = f / e - 1.0;
        assert!(
            error.abs() < tolerance,
            "{what}: {found:?} and {expected:?}"
        );
    }
}

#[test]
fn a_whole_body_analysed_again_has_the_modes_of_its_bake() {
    // Elements that merely cover a body are a little too stiff, most of all in torsion; never too soft, as displacements of
    // their kind only (Ritz).
    for (shape, tolerance) in [
        (Shape::block(BAR), 0.03),
        (Shape::plate(0.2, 0.2, 0.005), 0.03),
    ] {
        let body = breakable(shape, "porcelain", 6_000.0, 30).body(1);
        let elastic = reanalysis(&whole(&body), 1500, 20).expect("modes");
        let (found, expected) = (
            frequencies(&elastic.modes),
            frequencies(body.asset().modes()),
        );
        assert_near(&found, &expected, tolerance, "reanalysis");
        let soft = found
            .iter()
            .zip(&expected)
            .filter(|(f, e)| **f < 0.998 * **e);
        assert_eq!(soft.count(), 0, "{found:?} {expected:?}");
    }
}

#[test]
fn a_cracked_body_rings_lower() {
    let kind = breakable(Shape::plate(0.15, 0.15, 0.005), "glass", 10_000.0, 40);
    let steel = Material::preset("steel").expect("a preset");
    let ball = Striker::ball(&steel, 0.02, 8e-3);
    let config = FractureConfig::default();
    let middle = Vec3::new(0.0, 0.0, 2.5e-3);
    // Of many blows the one with the most crack that parts nothing.
    let (mut most, mut state) = (0.0, None);
    for seed in 1..=8 {
        let body = kind.body(seed);
        for step in 1..=20 {
            let speed = f64::from(step);
            let hit = Contact::collision(body.asset(), middle, Vec3::NEG_Z, speed, ball.clone());
            let outcome = impact(&body, std::slice::from_ref(&hit), &config).expect("an outcome");
            let area = outcome.report().crack_area;
            if let Outcome::Held { state: Some(s), .. } = outcome
                && area > most
            {
                (most, state) = (area, Some((body.clone(), s)));
            }
        }
    }
    let (mut cracked, state) = state.expect("a blow that cracks and does not part");
    let sound = reanalysis(&whole(&cracked), 600, 10).expect("modes");
    cracked.set_state(*state).expect("its own state");
    let soft = reanalysis(&whole(&cracked), 600, 10).expect("modes");
    let (sound, soft) = (frequencies(&sound.modes), frequencies(&soft.modes));
    assert!(soft[0] < 0.9999 * sound[0], "{soft:?} {sound:?}");
    // A crack never stiffens, but for another lattice: elements are split along it.
    for (a, b) in soft.iter().zip(&sound) {
        assert!(*a < 1.005 * b, "{soft:?} {sound:?}");
    }
}

#[test]
fn the_parents_modes_of_an_uncut_whole_are_its_own() {
    let body = bar();
    let elastic = parent_modes(&whole(&body), &body).expect("modes");
    let (found, expected) = (
        frequencies(&elastic.modes),
        frequencies(body.asset().modes()),
    );
    // One point per tetrahedron integrates a curved shape a little wrong.
    assert_near(&found, &expected, 0.02, "parent's modes");
}

#[test]
fn every_way_gives_the_same_bits_on_any_number_of_threads() {
    let body = bar();
    let portion = whole(&body);
    let all = |portion: &Arc<Portion>| -> Vec<u64> {
        let mut bits = Vec::new();
        let bases = [reanalysis(portion, 150, 12), parent_modes(portion, &body)];
        for elastic in bases {
            let elastic = elastic.expect("modes");
            let modes = &elastic.modes;
            bits.extend(modes.eigenvalues.iter().map(|x| x.to_bits()));
            bits.extend(modes.shapes.iter().map(|x| u64::from(x.to_bits())));
        }
        bits
    };
    let alone = all(&portion);
    assert!(alone.len() > 1000);
    let side_by_side: Vec<Vec<u64>> = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..3).map(|_| scope.spawn(|| all(&portion))).collect();
        threads
            .into_iter()
            .map(|t| t.join().expect("no panic"))
            .collect()
    });
    assert!(side_by_side.iter().all(|bits| *bits == alone));
}
