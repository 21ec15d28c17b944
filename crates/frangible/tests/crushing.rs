//! A contact crushes the weaker body under it: no pressure passes its hardness, and what crushing takes neither rings nor comes back.

use frangible::glam::Vec3;
use frangible::internals::blow::Blow;
use frangible::{Body, Breakable, Contact, FractureConfig, impact};

use crate::bodies::{block, steel_ball};

/// The brick without damping, crushed at this pressure, Pa.
fn brick(pressure: f64) -> Body {
    let mut asset = block().asset().as_ref().clone();
    asset.parts_mut().material.stiffness_damping = 0.0;
    asset.parts_mut().material.mass_damping = 0.0;
    asset.parts_mut().material.crushing_pressure = pressure;
    Breakable::uniform(asset).unwrap().body(1)
}

/// A steel ball of 200 g falls flat on the brick.
fn hit(body: &Body, speed: f64) -> Contact {
    let top = Vec3::new(0.02, 0.01, 0.025);
    Contact::collision(body.asset(), top, Vec3::NEG_Z, speed, steel_ball(0.2))
}

fn blow(body: &Body, speed: f64) -> Blow {
    let config = FractureConfig::default();
    Blow::new(body, &[hit(body, speed)], &config)
        .unwrap()
        .unwrap()
}

#[test]
fn no_pressure_passes_the_hardness() {
    let pressure = 2e8;
    let (hard, soft) = (brick(f64::INFINITY), brick(pressure));
    for speed in [2.0, 8.0, 30.0] {
        let [elastic, crushed] = [&hard, &soft].map(|body| blow(body, speed).reports().remove(0));
        let mean = |force: f64, radius: f64| force / (std::f64::consts::PI * radius.powi(2));
        assert!(mean(crushed.peak_force, crushed.contact_radius) <= pressure * (1.0 + 1e-9));
        assert!(mean(elastic.peak_force, elastic.contact_radius) > pressure);
        assert!(crushed.peak_force < 0.9 * elastic.peak_force, "{speed}");
        assert_eq!(
            (elastic.crushing_energy, elastic.crushed_volume),
            (0.0, 0.0)
        );
        let volume = crushed.crushing_energy / pressure;
        assert!((crushed.crushed_volume / volume - 1.0).abs() < 1e-12);
        // A ball that has crushed what it hit comes back slower.
        assert!(crushed.departure_speed < elastic.departure_speed, "{speed}");
    }
}

#[test]
fn motion_vibration_and_crushing_hold_what_the_approach_brought() {
    let body = brick(2e8);
    for speed in [2.0, 8.0, 30.0] {
        let blow = blow(&body, speed);
        let crushing = blow.reports()[0].crushing_energy;
        let [rings, lost] = blow.energies();
        assert!(crushing > 0.1 * lost, "{speed}: {crushing} of {lost} J");
        let missing = (rings + crushing) / lost - 1.0;
        assert!(missing.abs() < 1e-3, "{speed}: {missing}");
    }
}

#[test]
fn a_blow_too_weak_to_crush_is_the_same_to_the_bit() {
    let speed = 1e-3;
    let [elastic, never] = [brick(f64::INFINITY), brick(4e8)].map(|body| blow(&body, speed));
    assert_eq!(elastic.reports(), never.reports());
}

#[test]
fn what_is_crushed_cracks_less() {
    let area = |pressure: f64| {
        let body = brick(pressure);
        let outcome = impact(&body, &[hit(&body, 12.0)], &FractureConfig::default());
        outcome.unwrap().report().crack_area
    };
    let [elastic, crushed] = [f64::INFINITY, 1e8].map(area);
    assert!(
        elastic > 0.0 && crushed < 0.7 * elastic,
        "{elastic} {crushed}"
    );
}

#[test]
fn pressures_that_are_none_are_refused() {
    let mut asset = block().asset().as_ref().clone();
    for wrong in [0.0, -1.0, f64::NAN] {
        asset.parts_mut().material.crushing_pressure = wrong;
        let refused = Breakable::uniform(asset.clone()).unwrap_err().to_string();
        assert!(refused.contains("crushing pressure"), "{refused}");
        let body = brick(1e8);
        let mut contact = hit(&body, 1.0);
        contact.striker.crushing_pressure = wrong as f32;
        let refused = contact.validate().unwrap_err().to_string();
        assert!(refused.contains("crushing pressure"), "{refused}");
    }
}
