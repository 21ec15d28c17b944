//! Pieces that are not merged, and what becomes of their carriers.

use std::sync::Arc;

use frangible::glam::Vec3;
use frangible_rapier::rapier3d::dynamics::{RigidBodyBuilder, RigidBodyHandle, RigidBodyType};
use frangible_rapier::rapier3d::geometry::SharedShape;
use frangible_rapier::rapier3d::math::Vector;
use frangible_rapier::{AtRest, Ball, BreakableWorld, SurfaceProperties};

use super::{HALF, PIECES, drop_slab, floor, merged, pose, run};
use crate::common::{self, Judge, at, body, box_asset, slicer, unbreakable};

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
