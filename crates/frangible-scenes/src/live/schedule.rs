//! The scene's own projectiles, some of which set out later or are taken away again.

use std::sync::Arc;

use frangible::Material;

use super::{LiveScene, Thing, ThingKind};
use frangible_sound::Sounding;

use crate::appearance::projectile_surface;
use crate::error::SceneError;
use crate::launch::{Launched, Target, launch};
use crate::projectile::Projectile;
use crate::scene::Scene;
use crate::stage::{Thrown, projectile_name};

/// Projectiles to be thrown, with their times, and those that were thrown.
pub(super) struct Schedule {
    projectiles: Vec<Projectile>,
    /// Position of each body of the scene in the beginning.
    targets: Vec<Target>,
    /// One per projectile.
    pub(super) thrown: Vec<Thrown>,
}

impl Schedule {
    /// The schedule of a scene that was just set up.
    pub(super) fn new(scene: &Scene, targets: Vec<Target>, thrown: Vec<Thrown>) -> Self {
        Self {
            projectiles: scene.projectiles.clone(),
            targets,
            thrown,
        }
    }
}

impl LiveScene {
    /// Throws the projectiles that are due, and takes away those whose time is over.
    pub(super) fn throw_due(&mut self) -> Result<(), SceneError> {
        let now = self.time();
        for number in 0..self.schedule.thrown.len() {
            let thrown = self.schedule.thrown[number];
            match thrown.handle {
                Some(handle) if now >= thrown.until => {
                    self.world.physics.remove_body(handle);
                }
                Some(_) => {}
                None if self.schedule.projectiles[number].delay <= now => {
                    self.launch(number, now)?;
                }
                None => {}
            }
        }
        Ok(())
    }

    fn launch(&mut self, number: usize, now: f64) -> Result<(), SceneError> {
        let projectile = self.schedule.projectiles[number].clone();
        let Some(&target) = self.schedule.targets.get(projectile.target) else {
            return Ok(());
        };
        let look = projectile_surface(projectile.kind.name(), &projectile.material);
        let surface = self.surface(look);
        let floor = self.floor.is_some();
        let Launched {
            handle,
            mesh,
            flight,
        } = launch(&mut self.world, &projectile, target, floor, surface)?;
        self.things.push(Arc::new(Thing {
            name: projectile_name(&self.schedule.projectiles, number),
            kind: ThingKind::Projectile,
            mesh,
            mass: projectile.mass,
            volume: 0.0,
            handle,
            sounding: Sounding::Ball(
                Material::preset(&projectile.material)?,
                projectile.radius,
                projectile.mass,
            ),
            surfaces: None,
            plain: None,
        }));
        let thrown = &mut self.schedule.thrown[number];
        thrown.handle = Some(handle);
        thrown.arrives = now + flight;
        thrown.until = projectile.stays.map_or(f64::INFINITY, |stays| now + stays);
        Ok(())
    }
}
