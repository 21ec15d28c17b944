//! Blows through the interface for C against those of the core.

use std::ptr::null;

use frangible::glam::{DMat3, DVec3, Vec3};
use frangible::{Asset, Breakable, Contact, FractureConfig, Material, Outcome, Striker, impact};
use frangible_c::*;

use crate::{PANE, at_middle, ball, body, hit, masses, pane, report, sound, text};

#[test]
fn a_blow_gives_the_pieces_of_the_core_to_the_bit() {
    let asset = Asset::from_bytes(PANE).expect("a sound asset");
    let direct = Breakable::new(asset).expect("a sound kind").body(3);
    let steel = Material::preset("steel").expect("a preset");
    let striker = Striker::ball(&steel, 0.13, 0.0158);
    let point = Vec3::new(0.0, 0.0, 0.003);
    let contact = Contact::strike(point, Vec3::NEG_Z, 12.0, striker);
    let outcome = impact(&direct, &[contact], &FractureConfig::default()).expect("a sound blow");
    let Outcome::Broke(fracture) = outcome else {
        panic!("it breaks");
    };
    let expected: Vec<f64> = fracture.fragments.iter().map(|f| f.mass.mass).collect();
    let body = body(3);
    let outcome = hit(body, &[at_middle(12.0)], &ball(12.0));
    assert_eq!(masses(outcome), expected);
    sound(frangible_outcome_free(outcome));
    sound(frangible_body_free(body));
}

#[test]
fn a_pose_moves_the_blow_with_the_body() {
    let body = body(1);
    // A quarter turn about x takes −z to y.
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let pose = frangible_pose {
        position: [5.0, -2.0, 1.0],
        rotation: [half, 0.0, 0.0, half],
    };
    let contact = frangible_contact {
        point: [5.0, -2.003, 1.0],
        normal: [0.0, 1.0, 0.0],
        ..at_middle(12.0)
    };
    let (by, mut outcome) = (ball(12.0), frangible_outcome::default());
    sound(unsafe { frangible_body_impact(body, &contact, 1, &by, 1, &pose, &mut outcome) });
    let own = hit(body, &[at_middle(12.0)], &by);
    let energy = |o| report(o).fracture_energy;
    // The rotation and the way back round to a few units of f32.
    assert!((energy(outcome) / energy(own) - 1.0).abs() < 0.05);
    assert_eq!(report(outcome).fragments, report(own).fragments);
    for outcome in [outcome, own] {
        sound(frangible_outcome_free(outcome));
    }
    sound(frangible_body_free(body));
}

#[test]
fn contacts_of_one_striker_share_its_mass() {
    let body = body(1);
    let mut contacts = [at_middle(2.0); 2];
    contacts[0].point[0] = 0.01;
    contacts[1].point[0] = -0.01;
    let mut by = ball(2.0);
    by.kind = FRANGIBLE_STRIKER_BODY;
    by.inertia = DMat3::from_diagonal(DVec3::splat(1e-4)).to_cols_array();
    let outcome = hit(body, &contacts, &by);
    // Two strikers would bring twice the energy of one: ½ m v².
    let most = 0.5 * by.mass * 4.0;
    assert!(report(outcome).approach_energy <= 1.001 * most);
    assert_eq!(report(outcome).contacts, 2);
    sound(frangible_outcome_free(outcome));
    sound(frangible_body_free(body));
}

#[test]
fn threads_break_bodies_of_one_kind_alike_while_others_free_theirs() {
    let kind = pane();
    let broken = |_: usize| {
        let mut body = frangible_body::default();
        sound(unsafe { frangible_body_new(kind, 3, &mut body) });
        let outcome = hit(body, &[at_middle(12.0)], &ball(12.0));
        let masses = masses(outcome);
        sound(frangible_outcome_free(outcome));
        sound(frangible_body_free(body));
        masses
    };
    let alone = broken(0);
    let broken = &broken;
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..4).map(|k| scope.spawn(move || broken(k))).collect();
        for thread in threads {
            assert_eq!(thread.join().expect("no panic"), alone);
        }
    });
    sound(frangible_breakable_free(kind));
}

#[test]
fn friction_counts_and_its_part_along_the_normal_does_not() {
    let body = body(1);
    let with = |friction| {
        let contact = frangible_contact {
            friction,
            ..at_middle(12.0)
        };
        let outcome = hit(body, &[contact], &ball(12.0));
        let masses = masses(outcome);
        sound(frangible_outcome_free(outcome));
        masses
    };
    let plain = with([0.0; 3]);
    assert_eq!(with([0.0, 0.0, 0.5]), plain);
    assert_ne!(with([0.5, 0.0, 0.0]), plain);
    sound(frangible_body_free(body));
}

#[test]
fn would_break_and_the_margin_agree_with_the_impact() {
    for speed in [0.2, 1.0, 6.0, 12.0] {
        let (body, contact, by) = (body(1), at_middle(speed), ball(speed));
        let (mut breaks, mut margin) = (-1, -1.0);
        let ask = frangible_body_would_break;
        sound(unsafe { ask(body, &contact, 1, &by, 1, null(), &mut breaks) });
        let ask = frangible_body_margin;
        sound(unsafe { ask(body, &contact, 1, &by, 1, null(), &mut margin) });
        let outcome = hit(body, &[contact], &by);
        let report = report(outcome);
        assert_eq!(breaks, report.broke as i32, "{speed} m/s");
        assert_eq!(margin < 1.0, report.cracks > 0, "{margin} at {speed} m/s");
        sound(frangible_outcome_free(outcome));
        sound(frangible_body_free(body));
    }
}

#[test]
fn a_push_of_a_script_and_a_breakable_striker_break_a_pane() {
    let [body, other] = [1, 2].map(body);
    let mut outcome = frangible_outcome::default();
    let push = frangible_contact {
        impulse: [0.0, 0.0, -1.5],
        duration: 1e-4,
        ..at_middle(0.0)
    };
    sound(unsafe { frangible_body_impact(body, &push, 1, null(), 0, null(), &mut outcome) });
    assert_eq!(report(outcome).broke, 1);
    sound(frangible_outcome_free(outcome));
    // Another pane comes with its edge first: its frame is turned so that its −y is the way that it flies.
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let striker = frangible_striker {
        kind: FRANGIBLE_STRIKER_BREAKABLE,
        mass: 0.4,
        inertia: DMat3::from_diagonal(DVec3::splat(2e-3)).to_cols_array(),
        centre: [0.0, 0.0, 0.153],
        body: other,
        rotation: [half, 0.0, 0.0, half],
        ..ball(12.0)
    };
    let flexible = hit(body, &[at_middle(12.0)], &striker);
    let rigid = frangible_striker {
        kind: FRANGIBLE_STRIKER_BODY,
        radius: 0.003,
        ..striker
    };
    let rigid = hit(body, &[at_middle(12.0)], &rigid);
    assert_eq!(report(flexible).broke, 1);
    // It vibrates, so it pushes otherwise.
    assert_ne!(report(flexible).impulse, report(rigid).impulse);
    for outcome in [flexible, rigid] {
        sound(frangible_outcome_free(outcome));
    }
    let freed = frangible_striker {
        body: frangible_body::default(),
        ..striker
    };
    let status = unsafe {
        let contact = at_middle(12.0);
        frangible_body_impact(body, &contact, 1, &freed, 1, null(), &mut outcome)
    };
    assert_eq!(status, frangible_status::Handle);
    assert!(text().starts_with("contacts[0]: "), "{}", text());
}
