//! Nothing passes through anything without a contact.

use crate::common::{at, body, box_asset, slicer, step_to_break, unbreakable, world};
use frangible::glam::Vec3;
use frangible_rapier::rapier3d::dynamics::{RigidBodyBuilder, RigidBodyType};
use frangible_rapier::rapier3d::math::{Pose, Vector};
use frangible_rapier::{Ball, SurfaceProperties};

const PANE: Vec3 = Vec3::new(0.2, 0.2, 0.002);

#[test]
fn a_fast_ball_never_passes_a_fixed_pane() {
    for step in 0..40 {
        let mut world = world(false);
        let pane = Vector::new(PANE.x, PANE.y, PANE.z);
        world
            .insert_fixed_box(pane, Pose::IDENTITY, SurfaceProperties::STONE)
            .unwrap();
        let start = at(0.01, 0.02, -0.3 - 0.021 * step as f32);
        let ball = Ball {
            mass: 0.01,
            radius: 0.004,
        };
        let ball = world
            .insert_ball(
                ball,
                SurfaceProperties::STEEL,
                start,
                Vector::new(0.0, 0.0, 200.0),
            )
            .unwrap();
        for _ in 0..12 {
            world.step().unwrap();
            assert!(
                world.physics.bodies[ball].translation().z < 0.0,
                "through, from {start:?}"
            );
        }
        assert!(world.physics.bodies[ball].linvel().z < 0.0, "it bounced");
    }
}

#[test]
fn a_fast_ball_always_meets_a_breakable_pane() {
    let asset = box_asset(PANE, [4, 4, 1]);
    for (fixed, breaks) in [(false, false), (false, true), (true, false), (true, true)] {
        for step in 0..12 {
            let mut world = world(false);
            let pane = world
                .insert(body(&asset), RigidBodyBuilder::dynamic())
                .unwrap();
            if fixed {
                world.physics.bodies[pane].set_body_type(RigidBodyType::Fixed, true);
            }
            let start = at(0.01, 0.02, -0.3 - 0.07 * step as f32);
            let ball = Ball {
                mass: 0.01,
                radius: 0.004,
            };
            let ball = world
                .insert_ball(
                    ball,
                    SurfaceProperties::STEEL,
                    start,
                    Vector::new(0.0, 0.0, 200.0),
                )
                .unwrap();
            world.set_break_function(if breaks {
                slicer(PANE, [10, 10, 1], 0.0, 0.1)
            } else {
                unbreakable()
            });
            let (mut met, mut passed) = (false, false);
            for _ in 0..20 {
                met |= !world.step().unwrap().is_empty();
                met |= !world.held().is_empty();
                passed |= world.physics.bodies[ball].translation().z > 0.0;
                assert!(
                    met || !passed,
                    "through without a contact, from {start:?}, fixed {fixed}"
                );
            }
            assert!(met, "no contact from {start:?}, fixed {fixed}");
            assert_eq!(passed, breaks, "fixed {fixed}, from {start:?}");
        }
    }
}

#[test]
fn pieces_never_fall_through_a_thin_floor() {
    let half = Vec3::new(0.04, 0.04, 0.002);
    let asset = box_asset(half, [2, 2, 1]);
    for step in 0..6 {
        let mut world = world(true);
        let floor = Vector::new(2.0, 0.0025, 2.0);
        world
            .insert_fixed_box(floor, at(0.0, -0.0025, 0.0), SurfaceProperties::STONE)
            .unwrap();
        let turn = Vector::new(0.4 * step as f32, 0.3, 0.1);
        let pose = Pose::new(Vector::new(0.0, 0.5, 0.0), turn);
        let down = Vector::new(0.0, -30.0, 0.0);
        world
            .insert(
                body(&asset),
                RigidBodyBuilder::dynamic()
                    .pose(pose)
                    .linvel(down)
                    .angvel(Vector::new(30.0, 10.0, 20.0)),
            )
            .unwrap();
        world.set_break_function(slicer(half, [5, 5, 1], 0.0, 0.0));
        let event = step_to_break(&mut world, 60).expect("it hits the floor");
        for _ in 0..240 {
            world.step().unwrap();
            for &f in &event.fragments {
                let at = world
                    .physics
                    .bodies
                    .get(f)
                    .map_or(Vector::ZERO, |b| b.translation());
                let above = at.x.abs().max(at.z.abs()) < 1.99;
                assert!(!above || at.y > -0.002, "a piece is at {at} m, run {step}");
            }
        }
    }
}
