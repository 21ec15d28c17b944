//! Pieces that rest are merged into one fixed body for each body that broke, and come loose when they may break.

mod left_alone;
mod loosened;

use std::collections::BTreeSet;
use std::sync::Arc;

use frangible::Breakable;
use frangible::glam::Vec3;
use frangible_bake::pieces::{Method, Pieces};
use frangible_rapier::rapier3d::dynamics::{RigidBodyBuilder, RigidBodyHandle};
use frangible_rapier::rapier3d::math::{Pose, Vector};
use frangible_rapier::{AtRest, Ball, BreakableWorld, SurfaceProperties, WorldConfig};

use crate::common::baked::pane;
use crate::common::{self, at, body, box_asset, slicer};

const HALF: Vec3 = Vec3::new(0.06, 0.004, 0.06);

/// Pieces of a slab.
const PIECES: usize = 9;

fn floor(at_rest: AtRest) -> BreakableWorld {
    let mut config = WorldConfig::default();
    config.at_rest = at_rest;
    config.rest_time = 0.2;
    let mut world = BreakableWorld::new(config).unwrap();
    world
        .insert_fixed_half_space(Vector::ZERO, Vector::Y, SurfaceProperties::STONE)
        .unwrap();
    world.set_break_function(slicer(HALF, [3, 1, 3], 0.0, 0.0));
    world
}

/// Drops a slab flat, and returns its pieces after this time, s.
fn drop_slab(
    world: &mut BreakableWorld,
    x: f32,
    height: f32,
    seconds: f32,
) -> Vec<RigidBodyHandle> {
    let asset = box_asset(HALF, [1, 1, 1]);
    let pose = at(x, height, 0.0);
    world
        .insert(body(&asset), RigidBodyBuilder::dynamic().pose(pose))
        .unwrap();
    let broke = common::step_to_break(world, 240).expect("it falls on stone");
    run(world, seconds);
    broke.fragments
}

fn run(world: &mut BreakableWorld, seconds: f32) {
    for _ in 0..(seconds * 240.0) as usize {
        world.step().unwrap();
    }
}

/// Steps until all that moved rests and is merged, for 8 s at most.
fn until_merged(world: &mut BreakableWorld) {
    for _ in 0..8 {
        run(world, 1.0);
        if world.physics.bodies.iter().all(|(_, b)| b.is_fixed()) {
            return;
        }
    }
}

fn pose(world: &BreakableWorld, handle: RigidBodyHandle) -> Pose {
    *world.physics.bodies[handle].position()
}

fn merged(world: &BreakableWorld) -> BTreeSet<(u32, u32)> {
    world.merged().map(|m| m.piece.into_raw_parts()).collect()
}

/// Bits of all poses and velocities.
fn bits(world: &BreakableWorld) -> Vec<[u32; 10]> {
    let bodies = world.physics.bodies.iter().map(|(_, b)| {
        let ([x, y, z], [i, j, k, w]) = (
            b.position().translation.to_array(),
            b.position().rotation.to_array(),
        );
        let [u, v, o] = b.linvel().to_array();
        [x, y, z, i, j, k, w, u, v, o].map(f32::to_bits)
    });
    bodies.collect()
}

#[test]
fn what_rests_is_merged_into_one_fixed_body_that_lies_and_collides_alike() {
    let mut world = floor(AtRest::Merge);
    let pieces = drop_slab(&mut world, 0.0, 0.3, 0.0);
    let mut last = vec![Pose::IDENTITY; PIECES];
    for _ in 0..6 * 240 {
        let moving = |world: &BreakableWorld, piece| world.rubble_of(piece).is_none();
        let before: Vec<bool> = pieces.iter().map(|&p| moving(&world, p)).collect();
        world.step().unwrap();
        for ((&piece, last), moved) in pieces.iter().zip(&mut last).zip(before) {
            if moved {
                *last = pose(&world, piece);
            }
        }
    }
    let all: Vec<_> = world.merged().collect();
    assert_eq!((pieces.len(), all.len()), (PIECES, PIECES));
    let rubble = all[0].rubble;
    assert!(
        all.iter().all(|m| m.rubble == rubble),
        "they have one origin"
    );
    let body = &world.physics.bodies[rubble];
    assert!(body.is_fixed() && body.colliders().len() == 1);
    let collider = &world.physics.colliders[body.colliders()[0]];
    let parts = collider.shape().as_compound().expect("a compound").shapes();
    assert_eq!(parts.len(), PIECES);
    for (&piece, last) in pieces.iter().zip(&last) {
        assert_eq!(pose(&world, piece), *last, "it stays where it was merged");
        let own = &world.physics.bodies[piece];
        assert!(own.is_fixed() && own.colliders().len() == 1);
        assert!(!world.physics.colliders[own.colliders()[0]].is_enabled());
        let known = all.iter().find(|m| m.piece == piece).unwrap();
        let placed = *body.position() * known.pose;
        assert!((placed.translation - last.translation).length() < 1e-6);
        // Its part has the place and the size of its own collider.
        let part = (0..PIECES as u32).find(|&p| world.piece_of_rubble(rubble, p) == Some(piece));
        let (local, shape) = &parts[part.expect("it is a part") as usize];
        let there = shape.compute_aabb(&(*body.position() * *local));
        let here = world.physics.colliders[own.colliders()[0]].compute_aabb();
        let gap = (there.mins - here.mins).length() + (there.maxs - here.maxs).length();
        assert!(gap < 1e-6, "{gap}");
    }
    // A ball that falls on one that lies flat stays on top.
    let ball = Ball {
        mass: 0.01,
        radius: 0.006,
    };
    let saved = world.save();
    let mut flat = 0;
    for &piece in &pieces {
        let place = pose(&world, piece).translation;
        let own = world.physics.bodies[piece].colliders()[0];
        let bounds = world.physics.colliders[own].compute_aabb();
        let top = bounds.maxs.y;
        if bounds.extents().y > 2.01 * HALF.y {
            continue;
        }
        flat += 1;
        let over = at(place.x, top + 0.03, place.z);
        let handle = world
            .insert_ball(ball, SurfaceProperties::STEEL, over, Vector::ZERO)
            .unwrap();
        let mut lowest = f32::INFINITY;
        for _ in 0..40 {
            world.step().unwrap();
            lowest = lowest.min(pose(&world, handle).translation.y);
        }
        let gap = lowest - ball.radius - top;
        println!("{gap} m over a piece that is {top} m high");
        assert!(gap.abs() < 1e-3, "{gap}");
        world.restore(&saved);
    }
    assert!(flat > PIECES / 2, "{flat} lie flat");
}

#[test]
fn what_is_merged_is_not_moved_and_does_not_count() {
    let mut world = floor(AtRest::Merge);
    let pieces = drop_slab(&mut world, 0.0, 0.3, 6.0);
    assert_eq!(merged(&world).len(), PIECES);
    let before: Vec<Pose> = pieces.iter().map(|&p| pose(&world, p)).collect();
    let ball = Ball {
        mass: 0.5,
        radius: 0.02,
    };
    let from = at(-0.3, 0.01, 0.0);
    let fast = Vector::new(8.0, 0.0, 0.0);
    world
        .insert_ball(ball, SurfaceProperties::STEEL, from, fast)
        .unwrap();
    run(&mut world, 1.0);
    let after: Vec<Pose> = pieces.iter().map(|&p| pose(&world, p)).collect();
    assert_eq!(before, after, "none of them can break");
    // The same ball through pieces that only sleep moves them.
    let mut world = floor(AtRest::Sleep);
    let pieces = drop_slab(&mut world, 0.0, 0.3, 6.0);
    let before: Vec<Pose> = pieces.iter().map(|&p| pose(&world, p)).collect();
    world
        .insert_ball(ball, SurfaceProperties::STEEL, from, fast)
        .unwrap();
    run(&mut world, 1.0);
    let after: Vec<Pose> = pieces.iter().map(|&p| pose(&world, p)).collect();
    assert_ne!(before, after);

    // Room for a floor, two heaps of rubble, a slab and its pieces.
    let mut config = WorldConfig::default();
    (config.at_rest, config.rest_time) = (AtRest::Merge, 0.2);
    config.max_bodies = PIECES + 4;
    let mut world = BreakableWorld::new(config).unwrap();
    world
        .insert_fixed_half_space(Vector::ZERO, Vector::Y, SurfaceProperties::STONE)
        .unwrap();
    world.set_break_function(slicer(HALF, [3, 1, 3], 0.0, 0.0));
    for x in [0.0, 1.0, 2.0] {
        drop_slab(&mut world, x, 0.3, 6.0);
    }
    assert_eq!(
        (merged(&world).len(), world.refused_breaks()),
        (3 * PIECES, 0)
    );
}

#[test]
fn debris_beyond_its_limit_leaves_the_rubble() {
    let mut config = WorldConfig::default();
    (config.at_rest, config.rest_time) = (AtRest::Merge, 0.2);
    (config.debris_mass, config.max_debris) = (1.0, PIECES + 2);
    let mut world = BreakableWorld::new(config).unwrap();
    world
        .insert_fixed_half_space(Vector::ZERO, Vector::Y, SurfaceProperties::STONE)
        .unwrap();
    world.set_break_function(slicer(HALF, [3, 1, 3], 0.0, 0.0));
    let first = drop_slab(&mut world, 0.0, 0.3, 6.0);
    let rubble = world.rubble_of(first[0]).unwrap();
    drop_slab(&mut world, 1.0, 0.3, 0.5);
    let left = world.merged().filter(|m| m.rubble == rubble).count();
    assert_eq!(left, 2, "{} pieces of debris", world.debris().count());
    let collider = world.physics.bodies[rubble].colliders()[0];
    let shape = world.physics.colliders[collider].shape();
    assert_eq!(shape.as_compound().map(|c| c.shapes().len()), Some(2));
}

/// A baked pane that has fallen flat on stone, and whose pieces are merged and can break.
fn fallen_pane() -> (BreakableWorld, Vec<RigidBodyHandle>) {
    let mut config = WorldConfig::default();
    (config.at_rest, config.rest_time) = (AtRest::Merge, 0.2);
    let mut world = BreakableWorld::new(config).unwrap();
    world
        .insert_fixed_half_space(Vector::ZERO, Vector::Y, SurfaceProperties::STONE)
        .unwrap();
    world = world.with_piece_model(Pieces::new(Method::ParentModes));
    // On its edge.
    let place = Pose::new(Vector::new(0.0, 1.0, 0.0), Vector::new(0.25, 0.0, 0.0));
    let kind = Breakable::uniform(Arc::clone(pane())).unwrap();
    let fast = Vector::new(0.0, -4.0, 0.0);
    world
        .insert(
            kind.body(1),
            RigidBodyBuilder::dynamic().pose(place).linvel(fast),
        )
        .unwrap();
    until_merged(&mut world);
    println!("{} bodies", world.physics.bodies.len());
    // The largest first.
    let mut pieces: Vec<_> = world.merged().map(|m| m.piece).collect();
    pieces.retain(|&p| world.breakable(p).is_some());
    pieces.sort_by(|&a, &b| {
        let mass = |p: RigidBodyHandle| world.physics.bodies[p].mass();
        mass(b).total_cmp(&mass(a))
    });
    assert!(!pieces.is_empty(), "{} are merged", world.merged().count());
    (world, pieces)
}

fn throw_down(world: &mut BreakableWorld, on: RigidBodyHandle) {
    let ball = Ball {
        mass: 0.5,
        radius: 0.02,
    };
    let place = pose(world, on).translation;
    let over = at(place.x, place.y + 0.1, place.z);
    let fast = Vector::new(0.0, -15.0, 0.0);
    world
        .insert_ball(ball, SurfaceProperties::STEEL, over, fast)
        .unwrap();
}

#[test]
fn a_world_put_aside_goes_on_with_its_rubble_bit_for_bit() {
    let (mut world, pieces) = fallen_pane();
    throw_down(&mut world, pieces[0]);
    let saved = world.save();
    run(&mut world, 1.0);
    let (first, lying) = (bits(&world), merged(&world));
    world.restore(&saved);
    assert_ne!(first, bits(&world));
    run(&mut world, 1.0);
    assert_eq!((first, lying), (bits(&world), merged(&world)));
}
