//! Outcomes: fragments, their motions, pieces that break again, and bodies that are restored.

use std::ptr::{null, null_mut};

use frangible::glam::{DMat3, DQuat, DVec3};
use frangible_c::*;

use crate::{BLOCK, at_middle, ball, body, body_of, hit, kind, masses, report, sound, text};

const AT_ORIGIN: frangible_pose = frangible_pose {
    position: [0.0; 3],
    rotation: [0.0, 0.0, 0.0, 1.0],
};

#[test]
fn momentum_is_kept_over_a_break_and_energy_is_not_made() {
    let body = body(1);
    let by = ball(12.0);
    let outcome = hit(body, &[at_middle(12.0)], &by);
    let count = report(outcome).fragments;
    let mut motions = vec![frangible_motion::default(); count];
    let mut poses = vec![AT_ORIGIN; count];
    let (still, mut after) = (frangible_motion::default(), frangible_motion::default());
    let status = unsafe {
        let (poses, motions) = (poses.as_mut_ptr(), motions.as_mut_ptr());
        frangible_outcome_motions(
            outcome, &AT_ORIGIN, &still, &by, poses, motions, count, &mut after,
        )
    };
    sound(status);
    let velocity = |motion: &frangible_motion| DVec3::from_array(motion.linear);
    let mut momentum = velocity(&after) * by.mass;
    let mut energy = 0.5 * by.mass * velocity(&after).length_squared();
    for (mass, motion) in masses(outcome).iter().zip(&motions) {
        momentum += velocity(motion) * *mass;
        energy += 0.5 * mass * velocity(motion).length_squared();
    }
    let before = velocity(&by.motion) * by.mass;
    // Sums of f64, and an impulse that was summed in them.
    assert!((momentum - before).length() < 1e-9, "{momentum} {before}");
    assert!(energy < 0.5 * before.length_squared() / by.mass);
    let status = unsafe {
        let to = motions.as_mut_ptr();
        frangible_outcome_motions(
            outcome,
            &AT_ORIGIN,
            &still,
            null(),
            null_mut(),
            to,
            count - 1,
            null_mut(),
        )
    };
    assert_eq!(status, frangible_status::Range);
    sound(frangible_outcome_free(outcome));
    sound(frangible_body_free(body));
}

#[test]
fn a_body_that_holds_moves_with_its_blow() {
    let body = body(1);
    let by = ball(2.0);
    let outcome = hit(body, &[at_middle(2.0)], &by);
    let found = report(outcome);
    assert_eq!(
        (found.broke, found.contacts),
        (0, 1),
        "the pane holds a blow"
    );
    let (still, mut after) = (frangible_motion::default(), frangible_motion::default());
    let (mut pose, mut whole) = (AT_ORIGIN, frangible_motion::default());
    sound(unsafe {
        frangible_outcome_motions(
            outcome, &AT_ORIGIN, &still, &by, &mut pose, &mut whole, 1, &mut after,
        )
    });
    let (pane, ball) = (whole.linear[2], after.linear[2]);
    // Of glass, 0.2 m × 0.2 m × 4 mm: 0.4 kg. It was hit in its middle, and the ball does not approach it any more.
    assert!(
        (0.13 * (ball + 2.0) + 0.4 * pane).abs() < 1e-3,
        "{pane} {ball}"
    );
    assert!(pane < -0.1 && ball - pane > -1e-9, "{pane} {ball} m/s");
    assert_eq!(pose.position, [0.0; 3]);
    let status = unsafe {
        let (to, none) = (&mut whole as *mut frangible_motion, null_mut());
        frangible_outcome_motions(outcome, &AT_ORIGIN, &still, &by, none, to, 2, null_mut())
    };
    assert_eq!(status, frangible_status::Range);
    assert!(text().contains("the body held: give 1"), "{}", text());
    sound(frangible_outcome_free(outcome));
    sound(frangible_body_free(body));
}

#[test]
fn fragments_are_the_body_with_closed_surfaces() {
    let body = body(1);
    let outcome = hit(body, &[at_middle(12.0)], &ball(12.0));
    for k in 0..report(outcome).fragments {
        let (mut solid, mut mesh) = Default::default();
        sound(unsafe { frangible_outcome_solid(outcome, k, &mut solid) });
        sound(unsafe { frangible_outcome_surface(outcome, k, &mut mesh) });
        let frangible_geometry {
            positions, indices, ..
        } = mesh;
        let positions = unsafe { std::slice::from_raw_parts(positions, 3 * mesh.vertices) };
        let indices = unsafe { std::slice::from_raw_parts(indices, mesh.indices_count) };
        let place = |i: &u32| {
            DVec3::from_slice(
                &positions[3 * *i as usize..][..3]
                    .iter()
                    .map(|&x| f64::from(x))
                    .collect::<Vec<_>>(),
            )
        };
        let corners: Vec<DVec3> = indices.iter().map(place).collect();
        // The divergence theorem: a surface with a hole has another volume.
        let volume = |c: &[DVec3]| c[0].dot(c[1].cross(c[2])) / 6.0;
        let volume: f64 = corners.chunks(3).map(volume).sum();
        let solid: frangible_solid = solid;
        assert!(
            (volume / solid.volume - 1.0).abs() < 1e-3,
            "{volume} {}",
            solid.volume
        );
    }
    sound(frangible_outcome_free(outcome));
    sound(frangible_body_free(body));
}

#[test]
fn principal_moments_and_axes_are_the_inertia() {
    let body = body(1);
    let outcome = hit(body, &[at_middle(12.0)], &ball(12.0));
    for k in 0..report(outcome).fragments {
        let mut solid = frangible_solid::default();
        sound(unsafe { frangible_outcome_solid(outcome, k, &mut solid) });
        let axes = DMat3::from_quat(DQuat::from_array(solid.axes));
        let moments = DMat3::from_diagonal(DVec3::from_array(solid.moments));
        let (again, whole) = (
            axes * moments * axes.transpose(),
            DMat3::from_cols_array(&solid.inertia),
        );
        let largest = solid.moments.into_iter().fold(0.0, f64::max);
        // A few roundings of f64.
        assert!(again.abs_diff_eq(whole, 1e-13 * largest), "{again} {whole}");
    }
    sound(frangible_outcome_free(outcome));
    sound(frangible_body_free(body));
}

#[test]
fn a_body_that_is_restored_breaks_as_the_one_that_was_saved() {
    let mut stone = frangible_striker::default();
    sound(unsafe { frangible_striker_of(c"stone".as_ptr(), &mut stone) });
    let corner = frangible_contact {
        point: [0.105, 0.05, -0.025],
        normal: [-0.105, -0.05, 0.025],
        ..Default::default()
    };
    let cracked = |seed: u64| {
        let body = body_of(kind(BLOCK), seed);
        let speed = 1.0 + 0.05 * seed as f64;
        let outcome = hit(body, &[frangible_contact { speed, ..corner }], &stone);
        let report = report(outcome);
        sound(frangible_outcome_free(outcome));
        (report.broke == 0 && report.cracks > 0).then_some((seed, body))
    };
    let cracked = (0..200).find_map(cracked);
    let (seed, first) = cracked.expect("a blow that leaves cracks");
    let mut length = 0;
    sound(unsafe { frangible_body_save(first, null_mut(), 0, &mut length) });
    let mut state = vec![0; length];
    let too_short = unsafe { frangible_body_save(first, state.as_mut_ptr(), length - 1, &mut 0) };
    assert_eq!(too_short, frangible_status::Range);
    assert!(state.iter().all(|&b| b == 0));
    sound(unsafe { frangible_body_save(first, state.as_mut_ptr(), length, &mut length) });
    let [second, fresh] = [0; 2].map(|_| body_of(kind(BLOCK), seed));
    sound(unsafe { frangible_body_restore(second, state.as_ptr(), length) });
    let hard = frangible_contact {
        speed: 12.0,
        ..corner
    };
    let broken = [first, second, fresh].map(|body| hit(body, &[hard], &stone));
    let [first, second, fresh] = broken.map(masses);
    assert!(first.len() > 1);
    assert_eq!(first, second);
    // The cracks count: the body as it was made breaks otherwise.
    assert_ne!(first, fresh);
}

#[test]
fn a_piece_breaks_again() {
    let parent = body(1);
    let outcome = hit(parent, &[at_middle(12.0)], &ball(12.0));
    let mut piece = frangible_body::default();
    sound(unsafe { frangible_outcome_piece(outcome, 0, &mut piece) });
    let mut mesh = frangible_geometry::default();
    sound(unsafe { frangible_outcome_surface(outcome, 0, &mut mesh) });
    let mut corner = [0.0; 3];
    for (k, x) in corner.iter_mut().enumerate() {
        *x = f64::from(unsafe { *mesh.positions.add(k) });
    }
    let contact = frangible_contact {
        point: corner,
        normal: corner.map(|x| -x),
        ..at_middle(30.0)
    };
    let again = hit(piece, &[contact], &ball(30.0));
    assert_eq!(report(again).broke, 1, "{}", text());
    let whole = masses(outcome)[0];
    let sum: f64 = masses(again).iter().sum();
    assert!((sum / whole - 1.0).abs() < 1e-6, "{sum} of {whole}");
    // A fragment of a gram or so has no modes, or few: it is a body or a code, never a panic.
    let last = report(outcome).fragments - 1;
    let status = unsafe { frangible_outcome_piece(outcome, last, &mut piece) };
    assert!(matches!(
        status,
        frangible_status::Ok | frangible_status::TooSmall
    ));
    let status = unsafe { frangible_outcome_piece(outcome, last + 1, &mut piece) };
    assert_eq!(status, frangible_status::Range);
}
