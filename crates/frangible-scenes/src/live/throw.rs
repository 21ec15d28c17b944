//! Throwing a ball into a scene that runs.

use std::sync::Arc;

use frangible::Material;
use frangible::glam::Vec3;
use frangible_rapier::rapier3d::math::Pose;
use frangible_rapier::{Ball, SurfaceProperties};

use super::{LiveScene, Thing, ThingKind};
use frangible_sound::Sounding;

use crate::appearance::projectile_surface;
use crate::error::SceneError;
use crate::launch::vector;
use crate::meshes::ball;

/// A ball about to be thrown.
#[derive(Clone, Debug, PartialEq)]
pub struct Throw {
    /// Mass, kg.
    pub mass: f64,
    /// Radius, m.
    pub radius: f64,
    /// Speed, m/s.
    pub speed: f64,
    /// Material preset.
    pub material: String,
    /// Position at which it starts, m.
    pub from: Vec3,
    /// Point through which its centre would go without anything in its way, m; another point than `from`.
    pub through: Vec3,
}

impl Throw {
    fn check(&self) -> Result<(), SceneError> {
        for (what, value, must) in [
            ("the ball's mass", self.mass, "above zero, in kg"),
            ("the ball's radius", self.radius, "above zero, in m"),
            ("the ball's speed", self.speed, "above zero, in m/s"),
        ] {
            if !(value.is_finite() && value > 0.0) {
                let value = value.to_string();
                return Err(SceneError::Quantity { what, value, must });
            }
        }
        let way = self.through - self.from;
        if way.is_finite() && way.length() > 0.0 {
            return Ok(());
        }
        Err(SceneError::Quantity {
            what: "the throw's direction",
            value: way.to_string(),
            must: "a vector of non-zero length, in m",
        })
    }
}

impl LiveScene {
    /// Throws a ball so that it flies through the point aimed at, gravity allowed for; it is the last of
    /// [`LiveScene::things`] then.
    ///
    /// # Errors
    /// An invalid number, an unknown material, a start below the floor.
    pub fn throw(&mut self, throw: &Throw) -> Result<(), SceneError> {
        throw.check()?;
        let radius = throw.radius as f32;
        let material = Material::preset(&throw.material)?;
        let properties = SurfaceProperties::of(&material, radius);
        if self.floor.is_some() && throw.from.y < radius {
            return Err(SceneError::Quantity {
                what: "the height at which the ball starts",
                value: format!("{} m", throw.from.y),
                must: "at least the ball's radius above the floor; raise the camera",
            });
        }
        let way = throw.through - throw.from;
        let flight = way.length() / throw.speed as f32;
        let gravity = Vec3::from(self.world.physics.gravity.to_array());
        // Slow balls would need a lob of their own; beyond half a second they fall short instead.
        let velocity = way / flight - 0.5 * gravity * flight.min(0.5);
        let solid = Ball {
            mass: throw.mass as f32,
            radius,
        };
        let pose = Pose::from_translation(vector(throw.from));
        let handle = self
            .world
            .insert_ball(solid, properties, pose, vector(velocity))?;
        self.throws += 1;
        let name = format!("ball {}", self.throws);
        let surface = self.surface(projectile_surface("ball", &throw.material));
        let mut mesh = ball(radius, surface);
        mesh.name.clone_from(&name);
        self.things.push(Arc::new(Thing {
            name,
            kind: ThingKind::Projectile,
            mesh,
            mass: throw.mass,
            volume: 4.0 / 3.0 * std::f64::consts::PI * throw.radius.powi(3),
            handle,
            sounding: Sounding::Ball(material, throw.radius, throw.mass),
            surfaces: None,
            plain: None,
        }));
        Ok(())
    }
}
