//! Rolling bodies come to rest, and so do those that were pressed into the floor.

use crate::common::{at, world};
use frangible_rapier::rapier3d::dynamics::RigidBodyBuilder;
use frangible_rapier::rapier3d::geometry::{ColliderBuilder, SharedShape};
use frangible_rapier::rapier3d::math::{Pose, Rotation, Vector};
use frangible_rapier::{Ball, BreakableWorld, SurfaceProperties, WorldConfig};

#[test]
fn a_rolling_ball_comes_to_rest() {
    let mut world = world(true);
    world
        .insert_fixed_half_space(Vector::ZERO, Vector::Y, SurfaceProperties::STONE)
        .unwrap();
    let ball = Ball {
        mass: 0.1,
        radius: 0.015,
    };
    let start = at(0.0, 0.015, 0.0);
    world
        .insert_ball(
            ball,
            SurfaceProperties::STEEL,
            start,
            Vector::new(0.2, 0.0, 0.0),
        )
        .unwrap();
    let mut energy = world.kinetic_energy();
    for _ in 0..720 {
        world.step().unwrap();
        let now = world.kinetic_energy();
        assert!(now <= energy + 1e-6, "energy rose from {energy} to {now} J");
        energy = now;
    }
    assert!(world.at_rest(), "still {energy} J after 3 s");
}

#[test]
fn what_was_pressed_into_the_floor_comes_out_and_lies_still() {
    let mut world = BreakableWorld::new(WorldConfig::for_games()).unwrap();
    let stone = SurfaceProperties::STONE;
    world
        .insert_fixed_half_space(Vector::ZERO, Vector::Y, stone)
        .unwrap();
    // Chips of stone, 3 mm thick, all of them 2 cm under the floor.
    let shape = SharedShape::cuboid(0.012, 0.0015, 0.009);
    let chips: Vec<_> = (0..8)
        .map(|k| {
            let turn = 0.4 * k as f32;
            let place = Vector::new(0.05 * k as f32, -0.02, 0.0);
            let rotation = Rotation::from_scaled_axis(Vector::new(turn, 0.3, 0.5 * turn));
            let chip = RigidBodyBuilder::dynamic().pose(Pose::from_parts(place, rotation));
            let collider = ColliderBuilder::new(shape.clone()).density(2500.0);
            world.physics.insert(chip, collider).0
        })
        .collect();
    for _ in 0..120 {
        world.step().unwrap();
    }
    for chip in chips {
        let body = &world.physics.bodies[chip];
        let (height, spin) = (body.translation().y, body.angvel().length());
        assert!(height > 0.001, "{height} m");
        assert!(spin < 0.5, "{spin} rad/s at {height} m");
    }
}
