//! Debris is simple and limited.

use crate::common::{at, body, box_asset, sliced, slicer, step_to_break, world};
use frangible::glam::Vec3;
use frangible_rapier::rapier3d::dynamics::{RigidBodyBuilder, RigidBodyHandle};
use frangible_rapier::rapier3d::geometry::ShapeType;
use frangible_rapier::rapier3d::math::Vector;
use frangible_rapier::rapier3d::parry::bounding_volume::BoundingVolume;
use frangible_rapier::{
    AtRest, Ball, BreakableWorld, SurfaceProperties, WorldConfig, collision_shape,
};

const HALF: Vec3 = Vec3::new(0.02, 0.02, 0.0004);

fn shoot(world: &mut BreakableWorld, x: f32) -> Vec<RigidBodyHandle> {
    let asset = box_asset(HALF, [1, 1, 1]);
    world
        .insert(
            body(&asset),
            RigidBodyBuilder::dynamic().pose(at(x, 0.0, 0.0)),
        )
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

/// The pieces of a slab that is shot over a floor, after this time, s, in which they came to rest.
fn rested(
    change: impl Fn(&mut WorldConfig),
    seconds: f32,
) -> (BreakableWorld, Vec<RigidBodyHandle>) {
    let mut config = WorldConfig::default();
    config.rest_time = 0.2;
    change(&mut config);
    let mut world = BreakableWorld::new(config).unwrap();
    let ground = Vector::new(0.0, -0.03, 0.0);
    world
        .insert_fixed_half_space(ground, Vector::Y, SurfaceProperties::STONE)
        .unwrap();
    world.set_break_function(slicer(HALF, [2, 2, 1], 0.0, 0.0));
    let pieces = shoot(&mut world, 0.0);
    for _ in 0..(seconds * 240.0) as usize {
        world.step().unwrap();
    }
    (world, pieces)
}

#[test]
fn what_rests_becomes_fixed_or_goes_or_sleeps() {
    for at_rest in [AtRest::Sleep, AtRest::Freeze, AtRest::Go] {
        let (world, pieces) = rested(|config| config.at_rest = at_rest, 8.0);
        let bodies = pieces.iter().filter_map(|&h| world.physics.bodies.get(h));
        let bodies: Vec<_> = bodies.collect();
        let fixed = bodies.iter().filter(|b| b.is_fixed()).count();
        let asleep = bodies.iter().filter(|b| b.is_sleeping()).count();
        println!(
            "{at_rest:?}: {} of {}, {fixed} fixed, {asleep} asleep",
            bodies.len(),
            pieces.len()
        );
        match at_rest {
            AtRest::Freeze => assert_eq!((bodies.len(), fixed), (4, 4)),
            AtRest::Go => assert!(bodies.is_empty()),
            _ => assert_eq!((bodies.len(), fixed, asleep), (4, 0, 4)),
        }
    }
}

#[test]
fn what_goes_fades_without_a_collider() {
    let fade = |config: &mut WorldConfig| {
        config.at_rest = AtRest::Go;
        config.fade_time = 0.25;
    };
    let (mut world, pieces) = rested(fade, 0.0);
    let (mut seen, mut smallest) = (0, 1.0_f32);
    for _ in 0..8 * 240 {
        world.step().unwrap();
        for (handle, left) in world.fading() {
            assert!(world.physics.bodies[handle].colliders().is_empty());
            (seen, smallest) = (seen + 1, smallest.min(left));
        }
    }
    // A quarter of a second of each of four pieces.
    assert!((236..=248).contains(&seen), "{seen}");
    assert!(smallest < 0.05, "{smallest}");
    assert!(pieces.iter().all(|&h| !world.physics.bodies.contains(h)));
    assert_eq!(world.fading().count(), 0);
}

#[test]
fn steps_that_take_too_long_cost_debris() {
    for (step_time, all_go) in [(0.0, true), (1e3, false)] {
        let change = |config: &mut WorldConfig| {
            config.step_time = step_time;
            // All pieces are debris.
            config.debris_mass = 1e-2;
        };
        let (world, pieces) = rested(change, 1.0);
        let there = pieces.iter().filter(|&&h| world.physics.bodies.contains(h));
        let there = there.count();
        assert_eq!(there == 0, all_go, "{there} of {}", pieces.len());
    }
}

#[test]
fn debris_collides_as_its_hull() {
    let mut world = world(false);
    world.set_break_function(slicer(HALF, [8, 8, 1], 0.0, 0.0));
    let fragments = sliced(HALF, [8, 8, 1], 0.0, 0.0).fragments;
    for (handle, fragment) in shoot(&mut world, 0.0).into_iter().zip(fragments) {
        let collider = world.physics.bodies[handle].colliders()[0];
        let shape = world.physics.colliders[collider].shape();
        assert_eq!(shape.shape_type(), ShapeType::ConvexPolyhedron);
        let bounds = shape.compute_local_aabb();
        for &p in &fragment.mesh.positions {
            assert!(bounds.loosened(1e-6).contains_local_point(p), "{p}");
        }
    }
}

#[test]
fn a_small_piece_has_one_hull_however_hollow_it_is() {
    let half = Vec3::splat(0.02);
    let mut piece = sliced(half, [1, 1, 1], 0.0, 0.0).fragments.remove(0);
    // Two cells at its ends, and nothing between them.
    let ends = [-0.015, 0.015].map(|x| {
        let corners = piece.mesh.positions.iter();
        corners
            .map(|p| Vec3::new(0.25 * p.x + x, p.y, p.z))
            .collect()
    });
    piece.cell_shares = ends.into_iter().map(|points| (0, points)).collect();
    piece.mass.volume *= 0.5;
    let mut config = WorldConfig::default();
    config.small_pieces.hull_points = 6;
    for (mass, shape, points) in [
        (0.9 * piece.mass.mass, ShapeType::Compound, None),
        (1.1 * piece.mass.mass, ShapeType::ConvexPolyhedron, Some(6)),
    ] {
        config.small_pieces.mass = mass as f32;
        let found = collision_shape(&piece, &config);
        assert_eq!(found.shape_type(), shape);
        let hull = found.as_convex_polyhedron().map(|h| h.points().len());
        assert_eq!(hull, points);
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
