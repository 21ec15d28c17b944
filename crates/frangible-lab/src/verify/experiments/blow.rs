//! The blow of a small projectile on a plate.

use frangible::glam::Vec3;
use frangible::{Contact, Material, Striker};

/// Density of the steel that projectiles are made of, kg/m³.
pub(crate) const STEEL_DENSITY: f64 = 7800.0;

/// A steel ball, or a cylinder with a round nose, that hits the middle of a plate's upper face.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Projectile {
    /// Mass, kg.
    pub(crate) mass: f64,
    /// Radius of the ball or of the nose, m.
    pub(crate) radius: f64,
}

impl Projectile {
    /// The contact at this speed, m/s, on a plate of this thickness, m. Force, duration and impulse are outcomes.
    pub(crate) fn contact(&self, steel: &Material, thickness: f64, speed: f64) -> Contact {
        let top = Vec3::new(0.0, 0.0, (0.5 * thickness) as f32);
        let striker = Striker::ball(steel, self.mass, self.radius);
        // A projectile that stops: the impulse in the paper's model.
        let impulse = (self.mass * speed) as f32;
        Contact {
            impulse,
            ..Contact::strike(top, Vec3::NEG_Z, speed as f32, striker)
        }
    }
}
