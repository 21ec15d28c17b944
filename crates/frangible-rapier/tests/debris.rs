//! Debris is simple and limited.

mod common;

use common::{at, body, box_asset, slicer, step_to_break, world};
use frangible::glam::Vec3;
use frangible_rapier::rapier3d::geometry::ShapeType;
use frangible_rapier::rapier3d::math::Vector;
use frangible_rapier::{Ball, BreakableWorld, SurfaceProperties, WorldConfig};

const HALF: Vec3 = Vec3::new(0.02, 0.02, 0.0004);

fn shoot(
    world: &mut BreakableWorld,
    x: f32,
) -> Vec<frangible_rapier::rapier3d::dynamics::RigidBodyHandle> {
    let asset = box_asset(HALF, [1, 1, 1]);
    world
        .insert_breakable(body(&asset), at(x, 0.0, 0.0), Vector::ZERO, Vector::ZERO)
        .unwrap();
    let ball = Ball {
        mass: 0.01,
        radius: 0.004,
    };
    world
        .insert_ball(
            ball,
            SurfaceProperties::STEEL,
            at(x, 0.0, -0.05),
            Vector::new(0.0, 0.0, 10.0),
        )
        .unwrap();
    step_to_break(world, 30).expect("a hit").fragments
}

#[test]
fn debris_is_capped_and_the_oldest_goes_first() {
    let mut config = WorldConfig::default();
    config.max_debris = 100;
    config.gravity = Vector::ZERO;
    let mut world = BreakableWorld::new(config).unwrap();
    world.set_break_function(slicer(HALF, [8, 8, 1], 0.0, 0.0));
    let first = shoot(&mut world, 0.0);
    assert_eq!(world.debris().count(), 64, "every piece is below 0.1 g");
    let second = shoot(&mut world, 1.0);
    assert_eq!(world.debris().count(), 100);
    let alive = |handles: &[_]| {
        handles
            .iter()
            .filter(|&&h| world.physics.bodies.contains(h))
            .count()
    };
    assert_eq!((alive(&first), alive(&second)), (36, 64));
    world.step().unwrap();
}

#[test]
fn debris_collides_as_a_box() {
    let mut world = world(false);
    world.set_break_function(slicer(HALF, [8, 8, 1], 0.0, 0.0));
    for handle in shoot(&mut world, 0.0) {
        let collider = world.physics.bodies[handle].colliders()[0];
        assert_eq!(
            world.physics.colliders[collider].shape().shape_type(),
            ShapeType::Cuboid
        );
    }
}

#[test]
fn bodies_removed_by_the_user_are_forgotten() {
    let mut world = world(false);
    world.set_break_function(slicer(HALF, [4, 4, 1], 0.0, 0.0));
    for handle in shoot(&mut world, 0.0) {
        world.physics.remove_body(handle);
    }
    world.step().unwrap();
    assert_eq!(world.debris().count(), 0);
}
