//! Numbers that cannot be used give an error that says so; nothing panics.

use crate::common::{self, at, body, box_asset, sliced, slicer, world};
use frangible::glam::{DMat3, Quat, Vec3};
use frangible::{InputError, Outcome};
use frangible_rapier::rapier3d::dynamics::RigidBodyBuilder;
use frangible_rapier::rapier3d::math::{Pose, Vector};
use frangible_rapier::{Ball, BreakableWorld, SurfaceProperties, WorldConfig, WorldError};

const HALF: Vec3 = Vec3::splat(0.05);
const NAN: f32 = f32::NAN;

#[test]
fn poses_and_velocities_must_be_finite() {
    let mut world = world(true);
    let asset = box_asset(HALF, [1, 1, 1]);
    let bad = Vector::new(0.0, NAN, 0.0);
    let mut insert = |pose, v, w| {
        world
            .insert(
                body(&asset),
                RigidBodyBuilder::dynamic().pose(pose).linvel(v).angvel(w),
            )
            .unwrap_err()
    };
    assert!(matches!(
        insert(at(NAN, 0.0, 0.0), Vector::ZERO, Vector::ZERO),
        WorldError::NotFinite { what: "pose" }
    ));
    assert!(matches!(
        insert(Pose::IDENTITY, bad, Vector::ZERO),
        WorldError::NotFinite { .. }
    ));
    assert!(matches!(
        insert(Pose::IDENTITY, Vector::ZERO, bad),
        WorldError::NotFinite { .. }
    ));
    let long = Pose::from_parts(Vector::ZERO, Quat::from_xyzw(0.0, 0.0, 0.0, 2.0));
    assert!(matches!(
        insert(long, Vector::ZERO, Vector::ZERO),
        WorldError::Rotation(_)
    ));
    assert_eq!(world.physics.bodies.len(), 0);
}

#[test]
fn masses_sizes_and_surfaces_must_make_sense() {
    let mut world = world(true);
    let mut ball = |mass, radius, surface| {
        world
            .insert_ball(Ball { mass, radius }, surface, Pose::IDENTITY, Vector::ZERO)
            .unwrap_err()
            .to_string()
    };
    for mass in [0.0, -1.0, NAN, f32::INFINITY] {
        assert!(ball(mass, 0.1, SurfaceProperties::STEEL).contains("mass"));
    }
    assert!(ball(1.0, NAN, SurfaceProperties::STEEL).contains("radius"));
    assert!(
        ball(
            1.0,
            0.1,
            SurfaceProperties {
                restitution: 1.5,
                ..SurfaceProperties::STEEL
            }
        )
        .contains("restitution")
    );
    assert!(
        ball(
            1.0,
            0.1,
            SurfaceProperties {
                friction: NAN,
                ..SurfaceProperties::STEEL
            }
        )
        .contains("friction")
    );
    assert!(
        ball(
            1.0,
            0.1,
            SurfaceProperties {
                contact_modulus: NAN,
                ..SurfaceProperties::STEEL
            }
        )
        .contains("modulus")
    );
    assert!(
        world
            .insert_fixed_box(
                Vector::new(1.0, 0.0, 1.0),
                Pose::IDENTITY,
                SurfaceProperties::STONE
            )
            .is_err()
    );
    assert!(
        world
            .insert_fixed_half_space(Vector::ZERO, Vector::ZERO, SurfaceProperties::STONE)
            .is_err()
    );

    let mut asset = (*box_asset(HALF, [1, 1, 1])).clone();
    asset.parts_mut().mass.mass = f64::NAN;
    assert!(frangible::Breakable::uniform(asset).is_err());
}

#[test]
fn configurations_are_checked() {
    let mut config = WorldConfig::default();
    config.dt = NAN;
    assert!(matches!(
        BreakableWorld::new(config),
        Err(WorldError::NotPositive { .. })
    ));
    let mut config = WorldConfig::default();
    config.gravity = Vector::splat(NAN);
    assert!(BreakableWorld::new(config).is_err());
}

#[test]
fn a_full_world_and_a_body_that_is_gone_are_errors() {
    let mut config = WorldConfig::default();
    config.max_bodies = 1;
    let mut world = BreakableWorld::new(config).unwrap();
    let ball = Ball {
        mass: 1.0,
        radius: 0.1,
    };
    let handle = world
        .insert_ball(ball, SurfaceProperties::STEEL, Pose::IDENTITY, Vector::ZERO)
        .unwrap();
    let full = world.insert_ball(ball, SurfaceProperties::STEEL, Pose::IDENTITY, Vector::ZERO);
    assert_eq!(full.unwrap_err(), WorldError::Full(1));
    world.physics.remove_body(handle);
    assert!(matches!(
        world.set_surface(handle, SurfaceProperties::WOOD),
        Err(WorldError::NoBody { .. })
    ));
}

fn shot_box() -> BreakableWorld {
    let mut world = world(false);
    world
        .insert(
            body(&box_asset(HALF, [1, 1, 1])),
            RigidBodyBuilder::dynamic(),
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
            at(0.0, 0.0, -0.07),
            Vector::new(0.0, 0.0, 9.0),
        )
        .unwrap();
    world
}

fn refused() -> InputError {
    InputError::Motion("a test says so")
}

#[test]
fn an_error_of_the_fracture_leaves_the_body_whole_and_the_step_complete() {
    let mut world = shot_box();
    world.set_break_function(|_, _, _| Err(refused()));
    let error = (0..20)
        .find_map(|_| world.step().err())
        .expect("the ball hits the box");
    assert_eq!(error, WorldError::Fracture(refused()));
    assert_eq!(world.breakables().count(), 1);
    world.set_break_function(slicer(HALF, [2, 1, 1], 0.0, 0.0));
    world.step().unwrap();
}

#[test]
fn fragments_without_mass_are_an_error() {
    let mut world = shot_box();
    world.set_break_function(|_, _, _| {
        let mut fracture = sliced(HALF, [2, 2, 1], 0.0, 0.0);
        fracture.fragments[1].mass.mass = 0.0;
        Ok(Outcome::Broke(Box::new(fracture)))
    });
    assert!((0..20).find_map(|_| world.step().err()).is_some());
    assert_eq!(world.breakables().count(), 1);
}

#[test]
fn degenerate_fragments_get_a_collider() {
    let mut world = shot_box();
    world.set_break_function(|_, _, _| {
        let mut fracture = sliced(HALF, [2, 2, 1], 0.0, 0.0);
        let piece = &mut fracture.fragments[0];
        // All points in one plane, a share of one point, one empty, one with a NaN.
        piece.mesh.positions.iter_mut().for_each(|p| p.x = 0.0);
        piece.cell_shares = vec![
            (0, vec![Vec3::ZERO]),
            (0, Vec::new()),
            (0, vec![Vec3::splat(f32::NAN); 8]),
        ];
        fracture.fragments[1].mesh.positions.clear();
        fracture.fragments[1].cell_shares.clear();
        fracture.fragments[2].mass.inertia =
            DMat3::from_diagonal(fracture.fragments[2].mass.inertia.diagonal());
        Ok(Outcome::Broke(Box::new(fracture)))
    });
    let event = common::step_to_break(&mut world, 20).unwrap();
    for handle in event.fragments {
        assert_eq!(world.physics.bodies[handle].colliders().len(), 1);
    }
    for _ in 0..30 {
        world.step().unwrap();
    }
    assert!(world.kinetic_energy().is_finite());
}
