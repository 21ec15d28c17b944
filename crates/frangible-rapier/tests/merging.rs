//! Pieces that rest are merged into one fixed body for each body that broke, and come loose when they may break.

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::common::baked::pane;
use crate::common::{self, Judge, at, body, box_asset, slicer, unbreakable};
use frangible::Breakable;
use frangible::glam::Vec3;
use frangible_bake::pieces::{Method, Pieces};
use frangible_rapier::rapier3d::dynamics::{RigidBodyBuilder, RigidBodyHandle, RigidBodyType};
use frangible_rapier::rapier3d::geometry::SharedShape;
use frangible_rapier::rapier3d::math::{Pose, Vector};
use frangible_rapier::rapier3d::parry::bounding_volume::BoundingVolume;
use frangible_rapier::{AtRest, Ball, BreakCause, BreakableWorld, SurfaceProperties, WorldConfig};

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
fn what_is_removed_leaves_the_rubble_and_what_is_let_move_comes_loose() {
    let mut world = floor(AtRest::Merge);
    let mut pieces = drop_slab(&mut world, 0.0, 0.3, 6.0);
    // The highest first: nothing lies on it.
    pieces.sort_by(|&a, &b| {
        let [a, b] = [a, b].map(|piece| pose(&world, piece).translation.y);
        b.total_cmp(&a)
    });
    let rubble = world.rubble_of(pieces[0]).expect("it is merged");
    let parts = |world: &BreakableWorld| {
        let collider = world.physics.bodies[rubble].colliders()[0];
        let shape = world.physics.colliders[collider].shape();
        shape.as_compound().map(|c| c.shapes().len())
    };
    world.physics.remove_body(pieces[0]);
    world.step().unwrap();
    assert_eq!(parts(&world), Some(PIECES - 1));
    assert!(world.rubble_of(pieces[0]).is_none());
    let second = world.physics.bodies.get_mut(pieces[1]).unwrap();
    second.set_body_type(RigidBodyType::Dynamic, true);
    world.step().unwrap();
    // A piece that lies on it, if only with an edge, comes loose as well.
    let left = parts(&world).expect("a compound");
    assert!((PIECES - 4..PIECES - 1).contains(&left), "{left}");
    let own = world.physics.bodies[pieces[1]].colliders()[0];
    assert!(world.physics.colliders[own].is_enabled());
    let mut merged = pieces.iter().filter(|&&p| world.rubble_of(p).is_some());
    let third = *merged.next().expect("most are merged still");
    assert!(world.loosen(third) && !world.loosen(third));
    assert!(world.physics.bodies[third].is_dynamic());
    // They lie where they lay, and are merged again.
    let before = [pieces[1], third].map(|p| pose(&world, p).translation);
    run(&mut world, 3.0);
    let after = [pieces[1], third].map(|p| pose(&world, p).translation);
    assert_eq!(parts(&world), Some(PIECES - 1));
    for (a, b) in before.iter().zip(after) {
        assert!((*a - b).length() < 2e-3, "{a} {b}");
    }
    // With the rubble go its pieces.
    world.physics.remove_body(rubble);
    world.step().unwrap();
    assert!(pieces.iter().all(|&p| !world.physics.bodies.contains(p)));
    assert_eq!(world.merged().count(), 0);
    // The floor is left.
    assert_eq!(world.physics.bodies.len(), 1);
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

#[test]
fn what_lies_on_a_piece_that_comes_loose_comes_loose_with_it() {
    let mut world = floor(AtRest::Merge);
    let below = drop_slab(&mut world, 0.0, 0.3, 6.0);
    let above = drop_slab(&mut world, 0.0, 0.3, 6.0);
    let aside = drop_slab(&mut world, 1.0, 0.3, 6.0);
    let all = [&below[..], &above, &aside].concat();
    assert_eq!(merged(&world).len(), 3 * PIECES, "all rest");
    let rubbles: BTreeSet<_> = world.merged().map(|m| m.rubble.into_raw_parts()).collect();
    assert_eq!(rubbles.len(), 3, "each slab has its own");
    let bounds = |p: RigidBodyHandle| {
        let own = world.physics.bodies[p].colliders()[0];
        world.physics.colliders[own].compute_aabb()
    };
    // One that has something lying on it: found by the heights of all pairs.
    let over = |p: RigidBodyHandle, q: RigidBodyHandle| {
        let (a, b) = (bounds(p), bounds(q));
        let side = |axis: usize| a.mins[axis] < b.maxs[axis] && b.mins[axis] < a.maxs[axis];
        side(0) && side(2) && (b.mins.y - a.maxs.y).abs() < 1e-3
    };
    let on = |p: RigidBodyHandle| -> Vec<RigidBodyHandle> {
        above.iter().copied().filter(|&q| over(p, q)).collect()
    };
    let carrier = *below.iter().find(|&&p| !on(p).is_empty()).expect("a heap");
    let carried = on(carrier);
    let free = below.iter().chain(&aside).copied();
    let free: Vec<_> = free.filter(|&p| p != carrier).collect();
    assert!(world.loosen(carrier));
    for &piece in &carried {
        assert!(world.rubble_of(piece).is_none(), "it would hang in the air");
    }
    let still = free.iter().filter(|&&p| world.rubble_of(p).is_some());
    println!("{} of {} stay", still.clone().count(), free.len());
    assert!(still.count() >= aside.len(), "the others are not touched");
    // Taken away, what lay on it falls, and nothing hangs in the air.
    world.physics.remove_body(carrier);
    run(&mut world, 6.0);
    assert_eq!(merged(&world).len(), 3 * PIECES - 1);
    let bounds = |p: RigidBodyHandle| {
        let own = world.physics.bodies[p].colliders()[0];
        let bounds = world.physics.colliders[own].compute_aabb();
        bounds.loosened(1e-3)
    };
    let left: Vec<_> = all.iter().copied().filter(|&p| p != carrier).collect();
    for &piece in &left {
        let own = bounds(piece);
        let height = |p: RigidBodyHandle| pose(&world, p).translation.y;
        let under =
            |&&p: &&RigidBodyHandle| height(p) < height(piece) && bounds(p).intersects(&own);
        let held = own.mins.y < 0.0 || left.iter().any(|p| under(&p));
        assert!(held, "{own:?}");
    }
}

#[test]
fn pieces_on_something_that_can_move_are_not_merged() {
    let mut world = floor(AtRest::Merge);
    let half = Vector::new(0.05, 0.05, 0.05);
    let stone = SurfaceProperties::STONE;
    let place = at(0.0, half.y, 0.0);
    let shape = SharedShape::cuboid(half.x, half.y, half.z);
    let crate_ = world
        .insert_rigid(shape, 20.0, stone, place, Vector::ZERO)
        .unwrap();
    let pieces = drop_slab(&mut world, 0.0, 0.3, 6.0);
    let on_it = |&&p: &&RigidBodyHandle| pose(&world, p).translation.y > half.y;
    let lying = pieces.iter().filter(on_it).count();
    let fallen = merged(&world);
    println!("{lying} lie on it, {} are merged", fallen.len());
    assert!(lying > 0);
    let high = pieces.iter().filter(on_it);
    assert!(
        high.map(|p| p.into_raw_parts())
            .all(|p| !fallen.contains(&p))
    );
    // It is taken away, and they fall.
    world.physics.remove_body(crate_);
    run(&mut world, 6.0);
    assert!(
        pieces
            .iter()
            .all(|&p| pose(&world, p).translation.y < half.y)
    );
    assert_eq!(merged(&world).len(), PIECES);
}

/// A slab in pieces on a shelf that is held at one end and has not broken.
fn slab_on_a_shelf() -> (BreakableWorld, RigidBodyHandle, Vec<RigidBodyHandle>) {
    let mut world = floor(AtRest::Merge);
    let half = Vec3::new(0.2, 0.01, 0.2);
    let mut asset = (*box_asset(half, [4, 1, 4])).clone();
    *asset.parts_mut().supported = (asset.fracture().positions.iter().zip(0..))
        .filter(|(p, _)| p.x < -0.19)
        .map(|(_, node)| node)
        .collect();
    let shelf = world
        .insert(
            body(&Arc::new(asset)),
            RigidBodyBuilder::dynamic().pose(at(0.0, 0.2, 0.0)),
        )
        .unwrap();
    let slice = slicer(HALF, [3, 1, 3], 0.0, 0.0);
    let hold = unbreakable();
    let judge: Judge = Box::new(move |body, contacts, config| {
        if body.asset().is_supported() {
            hold(body, contacts, config)
        } else {
            slice(body, contacts, config)
        }
    });
    world.set_break_function(judge);
    let pieces = drop_slab(&mut world, 0.0, 0.5, 6.0);
    (world, shelf, pieces)
}

#[test]
fn pieces_on_a_held_body_that_can_break_are_not_merged_and_fall_with_it() {
    let (mut world, shelf, pieces) = slab_on_a_shelf();
    let lying = |world: &BreakableWorld| {
        let high = pieces
            .iter()
            .filter(|&&p| pose(world, p).translation.y > 0.2);
        high.copied().collect::<Vec<_>>()
    };
    let on_it = lying(&world);
    assert!(on_it.len() > PIECES / 2, "{} lie on it", on_it.len());
    assert!(on_it.iter().all(|&p| world.rubble_of(p).is_none()));
    // They weigh on it as they did.
    assert!(world.physics.bodies[on_it[0]].is_dynamic());
    world.set_break_function(slicer(Vec3::new(0.2, 0.01, 0.2), [2, 1, 1], 0.0, 0.0));
    let ball = Ball {
        mass: 0.5,
        radius: 0.02,
    };
    let under = at(0.0, 0.1, 0.0);
    let fast = Vector::new(0.0, 5.0, 0.0);
    world
        .insert_ball(ball, SurfaceProperties::STEEL, under, fast)
        .unwrap();
    common::step_to_break(&mut world, 60).expect("the ball hits the shelf from below");
    assert!(world.physics.bodies.get(shelf).is_none());
    run(&mut world, 6.0);
    assert!(lying(&world).is_empty(), "all have fallen");
}

#[test]
fn what_lies_on_a_merged_piece_that_goes_falls() {
    let mut world = floor(AtRest::Merge);
    let below = drop_slab(&mut world, 0.0, 0.3, 6.0);
    let above = drop_slab(&mut world, 0.0, 0.3, 6.0);
    assert_eq!(merged(&world).len(), 2 * PIECES, "all rest");
    let high = |world: &BreakableWorld| {
        let high = above.iter();
        let high = high.filter(|&&p| pose(world, p).translation.y > 2.0 * HALF.y);
        high.count()
    };
    assert!(high(&world) > PIECES / 2, "they lie on the others");
    for &piece in &below {
        world.physics.remove_body(piece);
    }
    run(&mut world, 6.0);
    let left = above.iter().filter(|&&p| {
        let own = world.physics.bodies[p].colliders()[0];
        world.physics.colliders[own].compute_aabb().mins.y > 0.01
    });
    assert_eq!(left.count(), 0, "pieces hang in the air");
    assert_eq!(merged(&world).len(), PIECES);
}

#[test]
fn a_merged_piece_that_is_carried_away_stays_as_its_carrier_made_it() {
    let mut world = floor(AtRest::Merge);
    let pieces = drop_slab(&mut world, 0.0, 0.3, 6.0);
    let body = world.physics.bodies.get_mut(pieces[0]).unwrap();
    body.set_body_type(RigidBodyType::KinematicPositionBased, true);
    world.step().unwrap();
    assert!(world.rubble_of(pieces[0]).is_none());
    assert!(world.physics.bodies[pieces[0]].is_kinematic());
}

#[test]
fn a_pellet_lighter_than_debris_loosens_what_it_may_break() {
    let (mut world, pieces) = fallen_pane();
    let ball = Ball {
        mass: 0.9 * world.config().debris_mass,
        radius: 0.0014,
    };
    let place = pose(&world, pieces[0]).translation;
    let over = at(place.x, place.y + 0.1, place.z);
    let fast = Vector::new(0.0, -300.0, 0.0);
    world
        .insert_ball(ball, SurfaceProperties::STEEL, over, fast)
        .unwrap();
    world.step().unwrap();
    assert!(world.rubble_of(pieces[0]).is_none(), "it may break");
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
fn a_merged_piece_that_is_hit_hard_breaks_as_one_that_sleeps_does() {
    let (mut world, pieces) = fallen_pane();
    let hit = pieces[0];
    throw_down(&mut world, hit);
    let mut broke = Vec::new();
    for _ in 0..10 {
        broke.extend(world.step().unwrap().to_vec());
    }
    let event = broke.iter().find(|e| e.parent == hit).expect("it breaks");
    assert_eq!(event.cause, BreakCause::Impact);
    assert!(event.asset.portion().is_some() && event.fragments.len() > 1);
    assert!(!world.physics.bodies.contains(hit));
    assert!(world.rubble_of(hit).is_none());
    // Its own pieces are of the same origin.
    let rubble = world.merged().next().map(|m| m.rubble);
    run(&mut world, 3.0);
    let now: BTreeSet<_> = world.merged().map(|m| m.rubble.into_raw_parts()).collect();
    println!("{} merged", world.merged().count());
    assert!(
        event
            .fragments
            .iter()
            .any(|&p| world.rubble_of(p).is_some())
    );
    assert_eq!(now.len(), 1);
    assert!(rubble.is_none_or(|r| now.contains(&r.into_raw_parts())));
}

#[test]
fn scripted_blows_and_blasts_find_merged_pieces() {
    let (mut world, pieces) = fallen_pane();
    let hit = pieces[0];
    let place = pose(&world, hit).translation;
    let saved = world.save();
    world
        .fracture_at(hit, place, Vector::new(0.0, -20.0, 0.0))
        .unwrap();
    world.step().unwrap();
    assert!(
        world
            .breaks()
            .iter()
            .any(|e| e.parent == hit && e.cause == BreakCause::Script)
    );
    world.restore(&saved);
    assert!(world.rubble_of(hit).is_some());
    // Under the pieces, which it throws up.
    world.blast(place - Vector::Y * 0.2, 5.0, 1e-3).unwrap();
    world.step().unwrap();
    let flying = world
        .physics
        .bodies
        .iter()
        .filter(|(_, b)| b.linvel().y > 0.5);
    let flying = flying.count();
    println!("{flying} fly");
    assert!(flying > 1 && world.rubble_of(hit).is_none());
    world.restore(&saved);
    world.blast(place - Vector::Y * 0.2, 1e-6, 1e-3).unwrap();
    world.step().unwrap();
    assert!(
        world.rubble_of(hit).is_some(),
        "a breath of air loosens nothing"
    );
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
