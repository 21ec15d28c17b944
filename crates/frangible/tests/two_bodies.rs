//! Two bodies that both vibrate: one force over time, whichever of them is asked, and energy that is counted once.

use crate::bodies::{block, pane, shelf};
use frangible::glam::{Quat, Vec3};
use frangible::internals::blow::Blow;
use frangible::internals::is_harmless;
use frangible::{
    Asset, Body, Breakable, Contact, FractureConfig, InputError, Material, Striker, impact,
};

/// A place on a body, m, the unit direction of the impulse on it, and friction's share of the normal impulse.
#[derive(Clone, Copy)]
struct Place(Vec3, Vec3, Vec3);

/// The contact as one of two bodies feels it: the other one strikes it at its own place.
fn met(body: &Body, here: Place, other: &Body, there: Place, speed: f32) -> Contact {
    let bare = |Place(point, normal, friction): Place, striker: Striker| {
        Contact::strike(point, normal, speed, striker).with_friction(friction)
    };
    let config = FractureConfig::default();
    let striker = Striker::flexible(other, &bare(there, Striker::rigid()), &config).unwrap();
    assert!(body.asset().mass().mass > 0.0);
    bare(here, striker)
}

fn blow(body: &Body, contact: Contact) -> Blow {
    let found = Blow::new(body, &[contact], &FractureConfig::default());
    found.unwrap().expect("a contact that pushes")
}

/// The kind without damping.
fn undamped(kind: &Breakable) -> Breakable {
    let mut asset: Asset = Asset::clone(kind.asset());
    let material = asset.parts_mut().material;
    (material.stiffness_damping, material.mass_damping) = (0.0, 0.0);
    Breakable::uniform(asset).unwrap()
}

/// Places of the three bodies: on a wall, at a corner, on a face, near a free end.
fn places() -> Vec<(&'static Breakable, Place)> {
    let still = Vec3::ZERO;
    let corner = Vec3::new(-0.105, -0.05, 0.025);
    vec![
        (
            pane(),
            Place(Vec3::new(0.03, 0.02, 0.002), Vec3::NEG_Z, still),
        ),
        (block(), Place(corner, -corner.normalize(), still)),
        (
            block(),
            Place(Vec3::new(0.02, 0.01, -0.025), Vec3::Z, still),
        ),
        (
            shelf(),
            Place(Vec3::new(0.1, 0.0, 0.005), Vec3::NEG_Z, still),
        ),
    ]
}

#[test]
fn a_symmetric_pair_finds_the_same_force_from_both_sides() {
    for (kind, place) in places().into_iter().take(3) {
        let (one, other) = (kind.body(1), kind.body(2));
        let [a, b] = [(&one, &other), (&other, &one)]
            .map(|(body, other)| blow(body, met(body, place, other, place, 6.0)));
        let [a, b] = [a, b].map(|blow| blow.reports()[0].clone());
        assert!(a.peak_force > 10.0);
        assert_eq!(a.force.len(), b.force.len());
        for (x, y) in a.force.iter().zip(&b.force) {
            assert!(
                f64::from((x - y).abs()) <= 1e-6 * a.peak_force,
                "{x} N, {y} N"
            );
        }
    }
}

#[test]
fn any_pair_finds_one_force_from_both_sides() {
    for (k, (one, here)) in places().into_iter().enumerate() {
        for (other, there) in places().into_iter().skip(k + 1) {
            for rubs in [0.0, 0.3] {
                // Friction along the contact, of the same size on both.
                let tilt = |p: Place| Place(p.0, p.1, rubs * p.1.any_orthonormal_vector());
                let (here, there) = (tilt(here), tilt(there));
                let (a, b) = (one.body(1), other.body(2));
                let from_a = blow(&a, met(&a, here, &b, there, 4.0));
                let from_b = blow(&b, met(&b, there, &a, here, 4.0));
                let [ra, rb] = [&from_a, &from_b].map(|blow| blow.reports()[0].clone());
                // Both are integrated in steps of their own: the error of a step is what is left.
                let apart = |a: f64, b: f64| (a / b - 1.0).abs();
                let name = (one.asset().name(), other.asset().name());
                assert!(
                    apart(ra.impulse, rb.impulse) < 1e-5,
                    "{name:?}: {ra:?} {rb:?}"
                );
                assert!(
                    apart(ra.peak_force, rb.peak_force) < 1e-4,
                    "{name:?}: {ra:?} {rb:?}"
                );
                assert!(
                    apart(ra.duration, rb.duration) < 0.01,
                    "{name:?}: {ra:?} {rb:?}"
                );
            }
        }
    }
}

#[test]
fn what_the_motion_loses_is_in_the_vibration_of_both_and_what_was_crushed() {
    for (k, (one, here)) in places().into_iter().enumerate() {
        for (other, there) in places().into_iter().skip(k) {
            let [a, b] = [one, other].map(|kind| undamped(kind).body(3));
            let from_a = blow(&a, met(&a, here, &b, there, 5.0));
            let from_b = blow(&b, met(&b, there, &a, here, 5.0));
            let [held, lost] = from_a.energies();
            let [theirs, _] = from_b.energies();
            let [crushed, theirs_crushed] =
                [&from_a, &from_b].map(|blow| blow.reports()[0].crushing_energy);
            assert!((crushed - theirs_crushed).abs() < 1e-3 * lost);
            let whole = held + from_a.strikers_energy() + crushed;
            assert!((whole / lost - 1.0).abs() < 1e-3, "{whole} J of {lost} J");
            // Each takes as much as the other says it does.
            assert!((theirs - from_a.strikers_energy()).abs() < 1e-3 * lost);
            assert!((held - from_b.strikers_energy()).abs() < 1e-3 * lost);
        }
    }
}

#[test]
fn a_stiff_and_heavy_body_strikes_as_one_that_cannot_move() {
    let (kind, here) = places()[2];
    let there = Place(Vec3::new(0.02, 0.01, 0.025), Vec3::NEG_Z, Vec3::ZERO);
    let body = kind.body(1);
    let mut rigid = met(&body, here, &body, there, 5.0);
    rigid.striker.receptance = None;
    rigid.striker.inverse_effective_mass = 0.0;
    // In steps of the same length.
    let blow = |contact| {
        let (contacts, config) = ([contact], FractureConfig::default());
        let blow = Blow::with_substep(&body, &contacts, &config, Some(2e-8)).unwrap();
        blow.unwrap().reports()[0].clone()
    };
    let fixed = blow(rigid);
    let mut apart = f64::INFINITY;
    for stiffness in [1e2, 1e4, 1e6] {
        let mut asset = Asset::clone(kind.asset());
        // λ ∝ E/ρ stays as it is, and shapes go with 1/√ρ.
        let rows = asset.parts_mut().modes.shapes.iter_mut();
        rows.for_each(|x| *x /= f32::sqrt(stiffness));
        let striker = Breakable::uniform(asset).unwrap().body(2);
        let mut contact = met(&body, here, &striker, there, 5.0);
        contact.striker.inverse_effective_mass = 0.0;
        let found = blow(contact);
        let now = (found.impulse / fixed.impulse - 1.0).abs();
        assert!(now < 0.2 * apart, "{stiffness}: {now}");
        apart = now;
    }
    assert!(apart < 1e-5, "{apart}");
}

#[test]
fn a_striker_that_vibrates_takes_some_of_the_blow() {
    let (kind, here) = places()[0];
    let pane = kind.body(1);
    let contact = met(&pane, here, &pane, here, 5.0);
    let mut rigid = contact.clone();
    rigid.striker.receptance = None;
    let [flexible, rigid] = [contact, rigid].map(|c| blow(&pane, c).reports()[0].clone());
    assert!(flexible.peak_force < 0.95 * rigid.peak_force);
    assert!(flexible.duration > rigid.duration);
}

#[test]
fn bounds_refuse_no_blow_of_a_striker_that_vibrates_which_breaks() {
    let config = FractureConfig::default();
    let mut slow = config.clone();
    slow.culling = false;
    let (mut refused, mut cracked) = (0, 0);
    for (k, (one, here)) in places().into_iter().enumerate() {
        for (l, (other, there)) in places().into_iter().enumerate() {
            for step in 0..15 {
                let speed = 3e-3 * 1.9_f32.powi(step);
                let rubs = if step % 3 == 0 { 0.2 } else { 0.0 };
                let turn = Quat::from_axis_angle(here.1, (k + l) as f32);
                let beside = rubs * (turn * here.1.any_orthonormal_vector());
                let here = Place(here.0, here.1, beside);
                let body = one.body((k + 7 * l) as u64);
                let contact = met(&body, here, &other.body(2), there, speed);
                let mut stiff = contact.clone();
                stiff.striker.receptance = None;
                let refuses = |c: &Contact| is_harmless(&body, std::slice::from_ref(c), &config);
                assert_eq!(
                    refuses(&contact),
                    refuses(&stiff),
                    "a bound that hangs on vibration"
                );
                if refuses(&contact) {
                    refused += 1;
                    let found = impact(&body, &[contact], &slow).unwrap();
                    assert_eq!(found.report().cracks, 0);
                } else if speed > 5.0 {
                    cracked += usize::from(
                        impact(&body, &[contact], &config).unwrap().report().cracks > 0,
                    );
                }
            }
        }
    }
    println!("{refused} refused, {cracked} cracked");
    assert!(refused > 20 && cracked > 10, "{refused} {cracked}");
}

#[test]
fn a_striker_at_several_points_swings_as_one_body() {
    // A block falls flat on the pane: two contacts of one body, asked of either.
    let (one, other) = (undamped(block()).body(1), undamped(pane()).body(2));
    let config = FractureConfig::default();
    let places = [-0.04_f32, 0.04].map(|x| {
        let on_block = Place(Vec3::new(x, 0.0, -0.025), Vec3::Z, Vec3::ZERO);
        let on_pane = Place(Vec3::new(x, 0.0, 0.002), Vec3::NEG_Z, Vec3::ZERO);
        (on_block, on_pane)
    });
    let shares = |body: &Body, place: Place| {
        let mass = &body.asset().mass();
        let inertia = mass.inertia.inverse();
        let columns = [inertia.x_axis, inertia.y_axis, inertia.z_axis].map(|c| c.as_vec3());
        let velocity = place.1 / (mass.mass as f32).sqrt();
        frangible::internals::contact::SharedMass::of(0, velocity, columns, place.0.cross(place.1))
    };
    let on_block = places.map(|(here, there)| {
        let mut contact = met(&one, here, &other, there, 2.0);
        contact.striker.shared = Some(shares(&other, there));
        contact
    });
    let on_pane = places.map(|(there, here)| {
        let mut contact = met(&other, here, &one, there, 2.0);
        contact.striker.shared = Some(shares(&one, there));
        contact
    });
    let a = Blow::new(&one, &on_block, &config)
        .unwrap()
        .unwrap()
        .reports();
    let b = Blow::new(&other, &on_pane, &config)
        .unwrap()
        .unwrap()
        .reports();
    for (a, b) in a.iter().zip(&b) {
        assert!(
            (a.impulse / b.impulse - 1.0).abs() < 1e-3,
            "{} {}",
            a.impulse,
            b.impulse
        );
        assert!((a.peak_force / b.peak_force - 1.0).abs() < 2e-2);
    }
}

#[test]
fn a_striker_that_cannot_be_made_is_an_error() {
    let body = block().body(1);
    let config = FractureConfig::default();
    let there = |point: Vec3, normal: Vec3| {
        let contact = Contact::strike(point, normal, 1.0, Striker::rigid());
        Striker::flexible(&body, &contact, &config)
    };
    assert!(there(Vec3::Z, Vec3::NEG_Z).is_ok());
    assert!(matches!(
        there(Vec3::NAN, Vec3::Z),
        Err(InputError::NotFinite { .. })
    ));
    assert!(there(Vec3::Z, Vec3::ZERO).is_err());
    let steel = Material::preset("steel").unwrap();
    assert!(Striker::ball(&steel, 1.0, 0.01).receptance.is_none());
}
