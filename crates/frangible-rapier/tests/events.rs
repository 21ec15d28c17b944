//! Events of impacts and breaks, and the contacts that the world hands to the fracture.

use crate::common::{at, body, box_asset, slicer, step_to_break, unbreakable, world};
use frangible::glam::Vec3;
use frangible_rapier::rapier3d::dynamics::RigidBodyBuilder;
use frangible_rapier::rapier3d::math::{Pose, Vector};
use frangible_rapier::{Ball, SurfaceProperties};

const HALF: Vec3 = Vec3::new(0.05, 0.05, 0.05);

/// Head-on hit of a ball on a box that is turned a quarter about x: all numbers are known in closed form.
#[test]
fn a_contact_holds_the_numbers_of_the_impact() {
    let mut world = world(false);
    let pose = Pose::new(
        Vector::new(1.0, 2.0, 3.0),
        Vector::new(std::f32::consts::FRAC_PI_2, 0.0, 0.0),
    );
    let asset = box_asset(HALF, [2, 2, 2]);
    let handle = world
        .insert(
            body(&asset),
            RigidBodyBuilder::dynamic()
                .pose(pose)
                .linvel(Vector::new(0.0, 0.0, 1.0)),
        )
        .unwrap();
    world.set_break_function(unbreakable());
    let ball = Ball {
        mass: 0.3,
        radius: 0.015,
    };
    let start = at(1.0, 2.0, 2.8);
    let ball = world
        .insert_ball(
            ball,
            SurfaceProperties::STEEL,
            start,
            Vector::new(0.0, 0.0, 6.0),
        )
        .unwrap();
    let held = (0..60).find_map(|_| {
        world.step().unwrap();
        world.held().first().cloned()
    });
    let held = held.expect("the ball hits the box");
    assert_eq!(
        (held.body, held.contacts.len()),
        (handle, 1),
        "the four cells that meet there report one contact"
    );
    let contact = held.contacts[0].clone();
    println!("{contact:?}");
    // World z is body y after a quarter turn about x: the ball comes from −y and pushes towards +y.
    assert!(
        (contact.point - Vec3::new(0.0, -0.05, 0.0)).length() < 1e-3,
        "{}",
        contact.point
    );
    assert!(
        (contact.normal - Vec3::Y).length() < 1e-3,
        "{}",
        contact.normal
    );
    assert!((contact.approach_speed - 5.0).abs() < 1e-3);
    let m = asset.mass().mass as f32;
    let e = contact.striker.restitution;
    let expected = (1.0 + e) * 5.0 / (1.0 / m + 1.0 / 0.3);
    assert!(
        (contact.impulse / expected - 1.0).abs() < 0.02,
        "{} N·s, not {expected}",
        contact.impulse
    );
    assert!((contact.striker.inverse_effective_mass - 1.0 / 0.3).abs() < 1e-3);
    assert_eq!(contact.striker.curvature_radius, 0.015);
    assert_eq!(
        contact.striker.contact_modulus,
        SurfaceProperties::STEEL.contact_modulus
    );
    let mean = 0.5 * (SurfaceProperties::STEEL.restitution + asset.material().restitution as f32);
    assert!((e - mean).abs() < 1e-6);
    // The impulse is what the ball lost.
    let lost = 0.3 * (6.0 - world.physics.bodies[ball].linvel().z);
    assert!(
        (contact.impulse / lost - 1.0).abs() < 0.02,
        "{} N·s against {lost}",
        contact.impulse
    );
}

#[test]
fn a_fall_on_the_floor_pushes_up_with_an_unmovable_striker() {
    let mut world = world(true);
    world
        .insert_fixed_half_space(Vector::ZERO, Vector::Y, SurfaceProperties::STONE)
        .unwrap();
    let asset = box_asset(HALF, [1, 1, 1]);
    world
        .insert(
            body(&asset),
            RigidBodyBuilder::dynamic().pose(at(0.0, 0.3, 0.0)),
        )
        .unwrap();
    world.set_break_function(unbreakable());
    let contacts = (0..200).find_map(|_| {
        world.step().unwrap();
        world.held().first().map(|h| h.contacts.clone())
    });
    let contacts = contacts.expect("the box reaches the floor");
    let total: f32 = contacts.iter().map(|c| c.impulse).sum();
    let speed = contacts[0].approach_speed;
    assert!(
        (2.0..2.4).contains(&speed),
        "√(2 g 0.25 m) = 2.2 m/s, got {speed}"
    );
    let e = contacts[0].striker.restitution;
    let expected = (1.0 + e) * speed * asset.mass().mass as f32;
    assert!(
        total <= expected * 1.0001 && total > 0.8 * expected,
        "{total} N·s of at most {expected}"
    );
    for contact in contacts {
        assert!((contact.normal - Vec3::Y).length() < 1e-3 && contact.point.y < -0.049);
        assert_eq!(contact.striker.inverse_effective_mass, 0.0);
        assert_eq!(contact.striker.curvature_radius, f32::INFINITY);
    }
}

#[test]
fn resting_contact_is_no_impact() {
    let mut world = world(true);
    world
        .insert_fixed_half_space(Vector::ZERO, Vector::Y, SurfaceProperties::STONE)
        .unwrap();
    world
        .insert(
            body(&box_asset(HALF, [1, 1, 1])),
            RigidBodyBuilder::dynamic().pose(at(0.0, 0.0501, 0.0)),
        )
        .unwrap();
    world.set_break_function(slicer(HALF, [2, 2, 2], 0.0, 0.0));
    for _ in 0..480 {
        assert!(world.step().unwrap().is_empty());
    }
    assert!(world.at_rest());
    assert_eq!(
        world.snapshots(),
        0,
        "no copy of the world without a fast body"
    );
}

#[test]
fn a_break_event_tells_all() {
    let mut world = world(false);
    let asset = box_asset(HALF, [2, 2, 2]);
    let pose = Pose::new(Vector::new(0.1, 0.2, 0.3), Vector::new(0.3, 0.2, 0.1));
    let parent = world
        .insert(body(&asset), RigidBodyBuilder::dynamic().pose(pose))
        .unwrap();
    let ball = Ball {
        mass: 0.1,
        radius: 0.01,
    };
    let start = at(0.1, 0.2, 0.0);
    let ball = world
        .insert_ball(
            ball,
            SurfaceProperties::STEEL,
            start,
            Vector::new(0.0, 0.0, 25.0),
        )
        .unwrap();
    world.set_break_function(slicer(HALF, [2, 3, 2], 0.0, 0.1));
    let event = step_to_break(&mut world, 60).unwrap();
    assert_eq!(
        (event.parent, event.strikers.as_slice()),
        (parent, [ball].as_slice())
    );
    assert_eq!(
        (event.fragments.len(), event.fracture.fragments.len()),
        (12, 12)
    );
    assert_eq!(event.step + 1, world.steps());
    assert!((event.pose.translation - pose.translation).length() < 1e-6);
    assert!((event.energy_paid - 0.1).abs() < 1e-9);
    assert!(!world.physics.bodies.contains(parent) && world.breakable(parent).is_none());
    assert_eq!(world.breaks().len(), 1);
    for (&handle, piece) in event.fragments.iter().zip(&event.fracture.fragments) {
        let rigid = &world.physics.bodies[handle];
        assert!((f64::from(rigid.mass()) / piece.mass.mass - 1.0).abs() < 1e-6);
        let home = event.pose * piece.mass.centre.as_vec3();
        assert!(
            (rigid.translation() - home).length() < 26.0 / 240.0,
            "born where the piece was"
        );
        assert!(rigid.local_center_of_mass().length() < 1e-6);
        assert_eq!(rigid.colliders().len(), 1);
    }
    world.step().unwrap();
    assert!(world.breaks().is_empty(), "events live for one step");
}

#[test]
fn two_boxes_that_meet_both_break_in_one_step() {
    let mut world = world(false);
    let asset = box_asset(HALF, [1, 1, 1]);
    for side in [-1.0_f32, 1.0] {
        let pose = at(side * 0.0525, 0.0, 0.0);
        world
            .insert(
                body(&asset),
                RigidBodyBuilder::dynamic()
                    .pose(pose)
                    .linvel(Vector::new(-3.0 * side, 0.0, 0.0)),
            )
            .unwrap();
    }
    world.set_break_function(slicer(HALF, [2, 2, 2], 0.0, 0.05));
    let (p, t) = (world.momentum(), world.kinetic_energy());
    let breaks = (0..10)
        .find_map(|_| Some(world.step().unwrap().to_vec()).filter(|b| !b.is_empty()))
        .unwrap();
    assert_eq!(breaks.len(), 2);
    assert_eq!(world.physics.bodies.len(), 16);
    assert!((world.momentum() - p).length() < 1e-5 * (2.0 * 2.5 * 3.0));
    assert!(world.kinetic_energy() <= t * (1.0 + 1e-6));
}

#[test]
fn a_break_that_does_not_fit_leaves_the_body_whole() {
    let mut config = frangible_rapier::WorldConfig::default();
    config.max_bodies = 5;
    let mut world = frangible_rapier::BreakableWorld::new(config).unwrap();
    let asset = box_asset(HALF, [1, 1, 1]);
    let parent = world
        .insert(
            body(&asset),
            RigidBodyBuilder::dynamic().pose(at(0.0, 0.0, 0.0)),
        )
        .unwrap();
    let ball = Ball {
        mass: 0.1,
        radius: 0.01,
    };
    world
        .insert_ball(
            ball,
            SurfaceProperties::STEEL,
            at(0.0, 0.0, -0.1),
            Vector::new(0.0, 0.0, 10.0),
        )
        .unwrap();
    world.set_break_function(slicer(HALF, [2, 2, 2], 0.0, 0.0));
    assert!(step_to_break(&mut world, 30).is_none());
    assert!(world.refused_breaks() > 0 && world.breakable(parent).is_some());
}
