//! Questions to the world: would a blow break a body?

use crate::common::baked::{block, pane};
use frangible::{Breakable, Contact, FractureConfig, Material, Striker};
use frangible_rapier::rapier3d::dynamics::RigidBodyBuilder;
use frangible_rapier::rapier3d::math::{Pose, Rotation, Vector};
use frangible_rapier::{Ball, BreakableWorld, SurfaceProperties, WorldConfig, WorldError};
use std::f32::consts::FRAC_PI_2;

/// Pane 0.3 × 0.3 m whose normal is x, far from the origin.
fn world() -> (
    BreakableWorld,
    frangible_rapier::rapier3d::dynamics::RigidBodyHandle,
) {
    let mut config = WorldConfig::default();
    config.gravity = Vector::ZERO;
    let mut world = BreakableWorld::new(config).unwrap();
    let pose = Pose::from_parts(
        Vector::new(5.0, 1.0, -3.0),
        Rotation::from_rotation_y(FRAC_PI_2),
    );
    let body = Breakable::uniform(pane().clone()).unwrap().body(1);
    let handle = world.insert(body, RigidBodyBuilder::dynamic().pose(pose));
    (world, handle.unwrap())
}

fn ball() -> Striker {
    Striker::ball(&Material::preset("steel").unwrap(), 0.13, 0.016)
}

#[test]
fn a_blow_asked_of_the_world_is_that_of_the_body_frame_and_of_the_step() {
    let (mut world, handle) = world();
    let place = Vector::new(5.0, 1.05, -3.02);
    let (mut broke, mut held) = (0, 0);
    for speed in [0.5, 2.0, 5.0, 10.0, 20.0] {
        // From the front, +x in the world, which is +z of the pane.
        let point = place + 0.002 * Vector::X;
        let asked = world.would_break(handle, point, -Vector::X, speed, ball());
        let body = world.breakable(handle).unwrap();
        let contact = Contact::collision(
            body.asset(),
            frangible::glam::Vec3::new(0.02, 0.05, 0.002),
            frangible::glam::Vec3::NEG_Z,
            f64::from(speed),
            ball(),
        );
        let config = FractureConfig::default();
        let expected =
            frangible::would_break(body, std::slice::from_ref(&contact), &config).unwrap();
        assert_eq!(asked.unwrap(), expected, "{speed} m/s");
        broke += usize::from(expected);
        held += usize::from(!expected);
    }
    assert!(broke > 0 && held > 0, "{broke} broke, {held} held");

    // The answer for 20 m/s comes true.
    let start = Pose::from_translation(place + 0.05 * Vector::X);
    let (steel, shot) = (SurfaceProperties::STEEL, -20.0 * Vector::X);
    let flying = Ball {
        mass: 0.13,
        radius: 0.016,
    };
    world.insert_ball(flying, steel, start, shot).unwrap();
    let steps = 0..4;
    let breaks: usize = steps.map(|_| world.step().unwrap().len()).sum();
    assert_eq!(breaks, 1);
    // Nobody is there any more.
    let gone = world.would_break(handle, place, -Vector::X, 1.0, ball());
    assert!(matches!(gone, Err(WorldError::NoBody { .. })));
}

#[test]
fn a_blow_that_cannot_be_meant_is_refused() {
    let (world, handle) = world();
    let ask = |point, toward, speed| {
        let asked = world.would_break(handle, point, toward, speed, ball());
        asked.unwrap_err().to_string()
    };
    let nan = Vector::splat(f32::NAN);
    assert!(ask(nan, Vector::X, 1.0).contains("point"));
    assert!(ask(Vector::ZERO, nan, 1.0).contains("direction"));
    assert!(ask(Vector::ZERO, Vector::X, -1.0).contains("speed"));
    assert!(ask(Vector::ZERO, Vector::ZERO, 1.0).contains("normal"));
}

#[test]
fn a_body_of_the_world_strikes_as_it_does_in_its_own_frame() {
    let (mut world, handle) = world();
    let turned = Pose::from_parts(Vector::new(7.0, 1.0, -3.0), Rotation::from_rotation_z(0.3));
    let other = Breakable::uniform(block().clone()).unwrap().body(2);
    let other = world.insert(other, RigidBodyBuilder::dynamic().pose(turned));
    let other = other.unwrap();
    let corner = frangible::glam::Vec3::new(-0.1, 0.04, 0.0);
    let (touches, toward) = (turned * corner, -Vector::X);
    let striker = world.striker(other, touches, toward).unwrap();
    let body = world.breakable(other).unwrap();
    let mut on_it = Contact::strike(
        corner,
        turned.rotation.inverse() * Vector::X,
        0.0,
        Striker::rigid(),
    );
    on_it.striker.restitution = striker.restitution;
    let expected = Striker::flexible(body, &on_it, &FractureConfig::default()).unwrap();
    let near = |a: f32, b: f32| (a / b - 1.0).abs() < 1e-4;
    assert!(near(
        striker.inverse_effective_mass,
        expected.inverse_effective_mass
    ));
    assert!(near(striker.curvature_radius, expected.curvature_radius));
    assert!(striker.receptance.is_some());
    // A fast one breaks the pane, a slow one does not.
    let place = Vector::new(5.002, 1.05, -3.02);
    for (speed, breaks) in [(0.05, false), (20.0, true)] {
        let asked = world.would_break(handle, place, toward, speed, striker.clone());
        assert_eq!(asked.unwrap(), breaks, "{speed} m/s");
    }
    assert!(world.striker(other, Vector::NAN, toward).is_err());
    assert!(world.striker(other, touches, Vector::ZERO).is_err());
}
