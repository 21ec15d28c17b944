//! Clumps of dice in the world.

use std::sync::Arc;

use crate::common::baked::pane;
use frangible::glam::DVec3;
use frangible::{Asset, Breakable};
use frangible_rapier::rapier3d::dynamics::{RigidBody, RigidBodyBuilder};
use frangible_rapier::rapier3d::math::{Pose, Vector};
use frangible_rapier::{BreakableWorld, SurfaceProperties, WorldConfig};

/// A tempered pane that flies at the floor on its edge.
fn world(change: impl Fn(&mut WorldConfig)) -> BreakableWorld {
    let mut config = WorldConfig::default();
    change(&mut config);
    let mut world = BreakableWorld::new(config).unwrap();
    world
        .insert_fixed_half_space(Vector::ZERO, Vector::Y, SurfaceProperties::STONE)
        .unwrap();
    let mut asset = Asset::clone(pane());
    asset.parts_mut().material.residual_stress = 100e6;
    let body = Breakable::new(Arc::new(asset)).unwrap().body(3);
    let pose = Pose::new(Vector::new(0.0, 0.6, 0.0), Vector::new(0.25, 0.0, 0.0));
    let start = Vector::new(0.0, -12.0, 0.0);
    world
        .insert(body, RigidBodyBuilder::dynamic().pose(pose).linvel(start))
        .unwrap();
    world
}

fn momentum<'a>(bodies: impl Iterator<Item = &'a RigidBody>) -> DVec3 {
    bodies.map(|b| (b.mass() * b.linvel()).as_dvec3()).sum()
}

#[test]
fn clumps_part_where_they_are_hit_and_lose_neither_mass_nor_momentum() {
    let mut world = world(|config| config.max_clumps = 250);
    let mass = pane().mass().mass;
    let (mut first, mut parted, mut most) = (0, 0, 0);
    for _ in 0..400 {
        world.step().unwrap();
        let events: Vec<_> = world.breaks().to_vec();
        for event in &events {
            let fragments = &event.fracture.fragments;
            match event.generation() {
                0 => {
                    first += 1;
                    assert_eq!(fragments.len(), world.config().fracture.clumps);
                    let whole: f64 = fragments.iter().map(|f| f.mass.mass).sum();
                    assert!((whole / mass - 1.0).abs() < 1e-9);
                }
                _ => {
                    parted += 1;
                    assert!(fragments.len() <= 4);
                    let bodies = || event.fragments.iter().map(|&h| &world.physics.bodies[h]);
                    let whole: f64 = fragments.iter().map(|f| f.mass.mass).sum();
                    let before = whole * event.linvel.as_dvec3();
                    let scale = before.length().max(1e-4);
                    assert!((momentum(bodies()) - before).length() < 1e-4 * scale);
                    assert!(event.kinetic_after <= event.kinetic_before);
                }
            }
        }
        let pieces = world.physics.bodies.iter().filter(|(_, b)| b.is_dynamic());
        most = most.max(pieces.count());
    }
    assert_eq!(first, 1);
    assert!(parted > 20, "{parted}");
    assert!(most <= 250, "{most}");
    let left: f32 = (world.physics.bodies.iter())
        .filter(|(_, b)| b.is_dynamic())
        .map(|(_, b)| b.mass())
        .sum();
    // All but debris that made room for other debris.
    assert!(f64::from(left) > 0.98 * mass && f64::from(left) < 1.001 * mass);
}

#[test]
fn the_world_is_the_same_on_any_number_of_threads_and_after_a_save() {
    let print = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build().unwrap().install(|| {
            let mut world = world(|_| {});
            let mut saved = None;
            for step in 0..120 {
                if step == 60 {
                    saved = Some(world.save());
                }
                world.step().unwrap();
            }
            let end = world.fingerprint();
            world.restore(&saved.unwrap());
            for _ in 60..120 {
                world.step().unwrap();
            }
            assert_eq!(world.fingerprint(), end);
            end
        })
    };
    assert_eq!(print(1), print(4));
}
