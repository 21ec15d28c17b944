//! Merged pieces that come loose or break.

use std::collections::BTreeSet;

use frangible_rapier::rapier3d::dynamics::{RigidBodyHandle, RigidBodyType};
use frangible_rapier::rapier3d::math::Vector;
use frangible_rapier::rapier3d::parry::bounding_volume::BoundingVolume;
use frangible_rapier::{AtRest, Ball, BreakCause, BreakableWorld, SurfaceProperties};

use super::{PIECES, drop_slab, fallen_pane, floor, merged, pose, run, throw_down};
use crate::common::at;

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
