//! A scene in a world of Rapier.

use frangible_rapier::rapier3d::dynamics::RigidBodyBuilder;
use std::f32::consts::PI;

use bevy_frangible::frangible::glam::DVec3;
use frangible_rapier::rapier3d::geometry::SharedShape;
use frangible_rapier::rapier3d::math::{Pose, Vector};
use frangible_rapier::{BreakableWorld, SurfaceProperties, WorldConfig, WorldError};

use super::scenes::{Break, GRAVITY, Outcome, Scene, Solid, Start, Striker};

fn pose(start: &Start) -> Pose {
    Pose::from_parts(start.at, start.turn)
}

/// Kinetic energy, J, and momentum, N·s, of all that moves.
fn motion(world: &BreakableWorld) -> (f64, DVec3) {
    (world.kinetic_energy(), world.momentum())
}

/// Plays a scene, with so many steps per second.
///
/// # Errors
/// An error of the world.
pub fn run(scene: &Scene, seed: u64, rate: f32) -> Result<Outcome, WorldError> {
    let mut config = WorldConfig::plain();
    (config.gravity, config.dt) = (Vector::ZERO, 1.0 / rate);
    let mut world = BreakableWorld::new(config)?;
    if let Some(floor) = &scene.floor {
        world.physics.gravity = Vector::NEG_Y * GRAVITY;
        let surface = SurfaceProperties::of(floor, f32::INFINITY);
        world.insert_fixed_half_space(Vector::ZERO, Vector::Y, surface)?;
    }
    let (body, start) = (scene.kind.body(seed), &scene.start);
    world.insert(
        body,
        RigidBodyBuilder::dynamic()
            .pose(pose(start))
            .linvel(start.velocity),
    )?;
    let striker = match &scene.striker {
        None => None,
        Some(Striker {
            solid,
            material,
            start,
        }) => {
            let (shape, radius, volume) = match *solid {
                Solid::Ball(r) => (SharedShape::ball(r), r, 4.0 / 3.0 * PI * r.powi(3)),
                Solid::Box(h) => {
                    let shape = SharedShape::cuboid(h.x, h.y, h.z);
                    (shape, f32::INFINITY, 8.0 * h.element_product())
                }
            };
            let mass = material.density as f32 * volume;
            let surface = SurfaceProperties::of(material, radius);
            let pose = pose(start);
            Some(world.insert_rigid(shape, mass, surface, pose, start.velocity)?)
        }
    };
    let mut broke = None;
    for _ in 0..(scene.seconds * rate) as usize {
        let before = motion(&world);
        world.step()?;
        if let (Some(event), None) = (world.breaks().first(), &broke) {
            let fracture = event.fracture.clone();
            broke = Some(Break::new(&fracture, [before, motion(&world)]));
        }
    }
    let striker = striker.and_then(|s| world.physics.bodies.get(s));
    Ok(Outcome {
        broke,
        striker: striker.map_or(Vector::ZERO, |body| body.linvel()),
    })
}
