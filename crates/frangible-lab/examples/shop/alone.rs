//! Rapier alone in the same shop, with everything that will break in pieces from the beginning: the cost of the rigid bodies without any break.

use std::time::Instant;

use frangible_lab::Result;
use frangible_lab::bench::Fingerprint;
use frangible_rapier::rapier3d::dynamics::RigidBodyBuilder;
use frangible_rapier::rapier3d::math::Pose;
use frangible_rapier::rapier3d::pipeline::{ActiveHooks, PhysicsWorld};

use crate::crockery::Kind;
use crate::furnish::let_in;
use crate::play::{Clock, Piece, settled};

/// Times of so many frames, s, and all poses in the end. Pieces lie where they lay in their thing, asleep with the others; no
/// hook of ours runs.
pub(crate) fn play_alone(
    kinds: &[Kind],
    pieces: &[Piece],
    frames: usize,
) -> Result<(Vec<f64>, Fingerprint)> {
    let mut world = settled(kinds)?.world;
    let_in(&mut world)?;
    let mut physics = world.physics;
    break_beforehand(&mut physics, pieces);
    let mut times = Vec::with_capacity(frames);
    let mut clock = Clock::start();
    for _ in 0..frames {
        clock.wait();
        let start = Instant::now();
        physics.step();
        times.push(start.elapsed().as_secs_f64());
    }
    let mut print = Fingerprint::default();
    for (_, body) in physics.bodies.iter() {
        let p = body.position().translation;
        p.to_array().into_iter().for_each(|x| print.add(x));
    }
    Ok((times, print))
}

fn break_beforehand(physics: &mut PhysicsWorld, pieces: &[Piece]) {
    let mut broken = Vec::new();
    for piece in pieces {
        let Some(parent) = physics.bodies.get(piece.parent) else {
            continue;
        };
        let pose = *parent.position();
        let body = RigidBodyBuilder::dynamic()
            .pose(Pose::from_parts(pose * piece.centre, pose.rotation))
            .additional_mass_properties(piece.mass)
            .sleeping(parent.is_sleeping());
        let handle = physics.bodies.insert(body);
        for collider in &piece.colliders {
            let mut collider = collider.clone();
            collider.set_active_hooks(ActiveHooks::empty());
            physics.insert_collider(collider, Some(handle));
        }
        broken.push(piece.parent);
    }
    broken.sort_unstable_by_key(|handle| handle.into_raw_parts());
    broken.dedup();
    for parent in broken {
        physics.remove_body(parent);
    }
}
