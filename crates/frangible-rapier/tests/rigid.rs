//! Unbreakable bodies of any shape.

use crate::common::{at, body, box_asset, unbreakable, world};
use frangible::glam::Vec3;
use frangible_rapier::rapier3d::dynamics::RigidBodyBuilder;
use frangible_rapier::rapier3d::geometry::SharedShape;
use frangible_rapier::rapier3d::math::Vector;
use frangible_rapier::{SurfaceProperties, WorldError};

/// A box of half extents 10, 20, 30 mm.
fn block() -> SharedShape {
    SharedShape::cuboid(0.01, 0.02, 0.03)
}

#[test]
fn a_rigid_body_has_the_mass_and_inertia_of_a_uniform_solid() {
    let mut world = world(false);
    let steel = SurfaceProperties::STEEL;
    let handle = world
        .insert_rigid(block(), 0.6, steel, at(0.0, 1.0, 0.0), Vector::ZERO)
        .unwrap();
    let body = &world.physics.bodies[handle];
    assert!((body.mass() - 0.6).abs() < 1e-6);
    let inertia = body
        .mass_properties()
        .local_mprops
        .reconstruct_inertia_matrix();
    // m (b² + c²) / 3 with the half extents of the other two axes.
    let expected = Vec3::new(0.0013, 0.0010, 0.0005) * (0.6 / 3.0);
    for (axis, expected) in expected.to_array().into_iter().enumerate() {
        let found = inertia.col(axis)[axis];
        assert!(
            (found / expected - 1.0).abs() < 1e-5,
            "{found}, not {expected}"
        );
    }
}

#[test]
fn it_strikes_with_its_surface() {
    let mut world = world(false);
    let asset = box_asset(Vec3::splat(0.05), [2, 2, 2]);
    world
        .insert(
            body(&asset),
            RigidBodyBuilder::dynamic().pose(at(0.0, 0.0, 0.0)),
        )
        .unwrap();
    world.set_break_function(unbreakable());
    let surface = SurfaceProperties {
        curvature_radius: 0.06,
        ..SurfaceProperties::STEEL
    };
    let velocity = Vector::new(0.0, 0.0, 5.0);
    world
        .insert_rigid(block(), 0.6, surface, at(0.0, 0.0, -0.2), velocity)
        .unwrap();
    let held = (0..60).find_map(|_| {
        world.step().unwrap();
        world.held().first().cloned()
    });
    let held = held.expect("it hits the box");
    for contact in &held.contacts {
        assert_eq!(contact.striker.curvature_radius, 0.06);
        assert_eq!(
            contact.striker.contact_modulus,
            SurfaceProperties::STEEL.contact_modulus
        );
        assert!((contact.approach_speed - 5.0).abs() < 0.05);
        assert!(contact.normal.z > 0.99);
    }
    assert!(!held.contacts.is_empty());
}

#[test]
fn it_does_not_pass_through_a_wall_however_fast() {
    for speed in [10.0, 100.0, 300.0] {
        let mut world = world(false);
        let wall = SurfaceProperties::STONE;
        world
            .insert_fixed_box(Vector::new(1.0, 1.0, 0.005), at(0.0, 0.0, 0.0), wall)
            .unwrap();
        let velocity = Vector::new(0.0, 0.0, speed);
        let steel = SurfaceProperties::STEEL;
        let handle = world
            .insert_rigid(block(), 0.6, steel, at(0.0, 0.0, -0.4), velocity)
            .unwrap();
        for _ in 0..60 {
            world.step().unwrap();
            let z = world.physics.bodies[handle].translation().z;
            assert!(z < 0.0, "at {speed} m/s it is at z = {z} m");
        }
    }
}

#[test]
fn masses_shapes_and_motions_that_make_no_sense_are_refused() {
    let mut world = world(false);
    let steel = SurfaceProperties::STEEL;
    let mut insert = |shape, mass, velocity| {
        world
            .insert_rigid(shape, mass, steel, at(0.0, 0.0, 0.0), velocity)
            .unwrap_err()
    };
    for mass in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        let message = insert(block(), mass, Vector::ZERO).to_string();
        assert!(message.contains("mass"), "{message}");
    }
    let flat = SharedShape::segment(Vector::ZERO, Vector::X);
    let message = insert(flat, 1.0, Vector::ZERO).to_string();
    assert!(message.contains("volume"), "{message}");
    assert!(matches!(
        insert(block(), 1.0, Vector::new(f32::NAN, 0.0, 0.0)),
        WorldError::NotFinite { .. }
    ));
    assert_eq!(world.physics.bodies.len(), 0);
}
