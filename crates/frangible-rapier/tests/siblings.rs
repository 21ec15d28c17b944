//! Overlapping pieces of one body neither explode apart, nor stick, nor sink, and come out of each other.

use crate::common::{at, body, box_asset, slicer, step_to_break, world};
use frangible::glam::Vec3;
use frangible_rapier::rapier3d::dynamics::{RigidBodyBuilder, RigidBodyHandle};
use frangible_rapier::rapier3d::math::Vector;
use frangible_rapier::{Ball, BreakEvent, BreakableWorld, SurfaceProperties};

const HALF: Vec3 = Vec3::new(0.06, 0.06, 0.06);

/// A box at rest in overlapping pieces, broken by a feather.
fn broken_box(gravity: bool, height: f32, overlap: f32) -> (BreakableWorld, BreakEvent) {
    let mut world = world(gravity);
    world
        .insert_fixed_box(
            Vector::new(1.0, 0.0025, 1.0),
            at(0.0, -0.0025, 0.0),
            SurfaceProperties::STONE,
        )
        .unwrap();
    let asset = box_asset(HALF, [2, 2, 2]);
    world
        .insert(
            body(&asset),
            RigidBodyBuilder::dynamic().pose(at(0.0, height, 0.0)),
        )
        .unwrap();
    world.set_break_function(slicer(HALF, [3, 3, 3], overlap, 0.0));
    let feather = Ball {
        mass: 1e-7,
        radius: 0.002,
    };
    let start = at(0.0, height + 0.0622, 0.0);
    let feather = world
        .insert_ball(
            feather,
            SurfaceProperties::STEEL,
            start,
            Vector::new(0.0, -1.0, 0.0),
        )
        .unwrap();
    let event = step_to_break(&mut world, 5).expect("the feather touches the box");
    world.physics.remove_body(feather);
    (world, event)
}

#[test]
fn overlapping_pieces_at_rest_stay_at_rest() {
    for overlap in [0.0, 0.0005, 0.002] {
        let (mut world, event) = broken_box(false, 0.2, overlap);
        let homes: Vec<Vector> = event
            .fragments
            .iter()
            .map(|&f| world.physics.bodies[f].translation())
            .collect();
        let (mut fastest, mut farthest) = (0.0_f32, 0.0_f32);
        for _ in 0..480 {
            world.step().unwrap();
            for (&f, home) in event.fragments.iter().zip(&homes) {
                let rigid = &world.physics.bodies[f];
                fastest = fastest.max(rigid.linvel().length());
                farthest = farthest.max((rigid.translation() - home).length());
            }
        }
        println!("overlap {overlap} m: fastest {fastest:.4} m/s, farthest {farthest:.5} m");
        assert!(
            fastest < 0.05,
            "a piece reached {fastest} m/s with {overlap} m of overlap"
        );
    }
}

#[test]
fn pieces_settle_and_sleep_on_a_thin_floor() {
    for overlap in [0.0, 0.001] {
        let (mut world, event) = broken_box(true, 0.065, overlap);
        let mut steps = 0;
        while !world.at_rest() && steps < 3000 {
            world.step().unwrap();
            steps += 1;
        }
        let lowest = event
            .fragments
            .iter()
            .map(|&f| world.physics.bodies[f].translation().y)
            .fold(1.0, f32::min);
        println!("overlap {overlap} m: at rest after {steps} steps, lowest centre {lowest:.4} m");
        assert!(world.at_rest(), "still moving after {steps} steps");
        assert!(lowest > 0.005, "a piece sank to {lowest} m");
    }
}

#[test]
fn a_piece_that_is_pressed_into_another_comes_out() {
    let (mut world, event) = broken_box(false, 0.2, 0.0);
    // Until they are no longer on their way apart.
    for _ in 0..64 {
        world.step().unwrap();
    }
    // The nearest two of the pieces, one of them pushed into the other.
    let place = |world: &BreakableWorld, i: usize| {
        let piece = &world.physics.bodies[event.fragments[i]];
        piece.translation()
    };
    let [a, b] = [event.fragments[0], event.fragments[1]];
    let apart = place(&world, 1) - place(&world, 0);
    let depth = 0.003;
    let pushed = place(&world, 1) - depth * apart.normalize();
    world.physics.bodies[b].set_translation(pushed, true);
    for _ in 0..48 {
        world.step().unwrap();
    }
    let overlap = |world: &BreakableWorld| {
        let collider = |body: RigidBodyHandle| world.physics.bodies[body].colliders()[0];
        let pair = world
            .physics
            .narrow_phase
            .contact_pair(collider(a), collider(b));
        let contacts = pair.into_iter().flat_map(|pair| pair.manifolds());
        let contacts = contacts.flat_map(|manifold| &manifold.points);
        contacts.map(|contact| -contact.dist).fold(0.0, f32::max)
    };
    let left = overlap(&world);
    let fastest = event
        .fragments
        .iter()
        .map(|&f| world.physics.bodies[f].linvel().length());
    println!("{:.2} mm of {:.1} mm are left", 1e3 * left, 1e3 * depth);
    assert!(left < 3e-4, "{left} m of the overlap are left after 0.2 s");
    assert!(fastest.fold(0.0, f32::max) < 0.5, "a piece was thrown out");
}
