//! Friction impulses of a blow, against the momentum that Rapier gave.

use crate::common::{body, box_asset, unbreakable, world};
use frangible::Material;
use frangible::glam::Vec3;
use frangible_rapier::rapier3d::dynamics::{FrictionModel, RigidBodyBuilder};
use frangible_rapier::rapier3d::math::{Pose, Rotation, Vector};
use frangible_rapier::{HeldEvent, SurfaceProperties};

/// A flat tile: friction at its sole hardly turns it.
const HALF: Vec3 = Vec3::new(0.1, 0.005, 0.1);

/// A tile that lands flat with this velocity: its impact, m Δv of the step, and its rotation.
fn landing(model: FrictionModel, velocity: Vector, turn: f32) -> (HeldEvent, Vector, Rotation) {
    let mut world = world(false);
    world.physics.integration_parameters.friction_model = model;
    world.set_break_function(unbreakable());
    world
        .insert_fixed_half_space(Vector::ZERO, Vector::Y, SurfaceProperties::STONE)
        .unwrap();
    let rotation = Rotation::from_rotation_y(turn);
    let pose = Pose::from_parts(Vector::new(0.0, HALF.y + 0.01, 0.0), rotation);
    let asset = box_asset(HALF, [1, 1, 1]);
    let tile = world
        .insert(
            body(&asset),
            RigidBodyBuilder::dynamic().pose(pose).linvel(velocity),
        )
        .unwrap();
    for _ in 0..20 {
        let before = world.physics.bodies[tile].linvel();
        world.step().unwrap();
        if let Some(event) = world.held().first() {
            let after = &world.physics.bodies[tile];
            let push = after.mass() * (after.linvel() - before);
            return (event.clone(), push, rotation);
        }
    }
    panic!("the tile never landed");
}

#[test]
fn what_slides_onto_a_rough_floor_is_rubbed_against_its_slide_and_momentum_balances() {
    for model in [FrictionModel::Coulomb, FrictionModel::Simplified] {
        for (velocity, turn) in [
            (Vector::new(4.0, -1.5, 0.0), 0.0),
            (Vector::new(-2.0, -1.0, 5.0), 0.7),
            (Vector::new(0.3, -2.0, -3.0), 2.0),
        ] {
            let (event, push, rotation) = landing(model, velocity, turn);
            let total: Vector = event
                .contacts
                .iter()
                .map(|c| rotation * c.whole_impulse())
                .sum();
            let friction: Vector = event.contacts.iter().map(|c| rotation * c.friction).sum();
            let slide = Vector::new(velocity.x, 0.0, velocity.z);
            println!("{model:?} {velocity}: pushed {total}, m Δv {push}");
            assert!(friction.dot(slide) < -0.95 * friction.length() * slide.length());
            assert!(
                (total - push).length() < 0.05 * push.length(),
                "{model:?}: {total}, not {push} N·s"
            );
        }
    }
}

#[test]
fn what_falls_straight_down_is_not_rubbed() {
    for model in [FrictionModel::Coulomb, FrictionModel::Simplified] {
        let (event, push, _) = landing(model, Vector::new(0.0, -2.0, 0.0), 0.3);
        let friction: Vector = event.contacts.iter().map(|c| c.friction).sum();
        println!(
            "{model:?}: {:?}",
            event
                .contacts
                .iter()
                .map(|c| c.friction)
                .collect::<Vec<_>>()
        );
        assert!(
            friction.length() < 1e-2 * push.length(),
            "{friction} of {push} N·s"
        );
    }
}

#[test]
fn ready_surfaces_are_those_of_the_materials() {
    let ready = [
        ("steel", SurfaceProperties::STEEL),
        ("stone", SurfaceProperties::STONE),
        ("wood", SurfaceProperties::WOOD),
    ];
    for (name, surface) in ready {
        let material = Material::preset(name).unwrap();
        assert_eq!(surface, SurfaceProperties::of(&material, f32::INFINITY));
    }
}
