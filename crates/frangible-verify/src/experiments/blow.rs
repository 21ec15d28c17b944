//! The blow of a small ball on a plate.

use std::f64::consts::PI;

use frangible::contact::hertz_duration;
use frangible::glam::Vec3;
use frangible::{Contact, Material, Striker};

/// A steel ball that hits the middle of a plate's upper face.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ball {
    /// kg.
    pub(crate) mass: f64,
    /// m.
    pub(crate) radius: f64,
}

/// Speed at which the restitution is taken, m/s; the contact's duration goes with its fifth root only.
const TYPICAL_SPEED: f64 = 20.0;

impl Ball {
    /// Coefficient of restitution on a wide plate. Flexural waves carry the blow away, and a thin plate gives none of it
    /// back: the ball feels the plate as a dashpot Z = 8 √(D ρ h) behind the spring of the contact (Zener, Phys. Rev. 59,
    /// 669 (1941), here with a linear spring of Hertz' duration t): e = exp(−π ζ/√(1 − ζ²)), ζ = π m/(2 Z t), 0 for ζ ≥ 1.
    pub(crate) fn restitution(&self, plate: &Material, thickness: f64, steel: &Material) -> f64 {
        let modulus = 1.0 / (1.0 / plate.contact_modulus() + 1.0 / steel.contact_modulus());
        let duration = hertz_duration(self.mass, modulus, self.radius, TYPICAL_SPEED);
        let bending = plate.contact_modulus() * thickness.powi(3) / 12.0;
        let dashpot = 8.0 * (bending * plate.density * thickness).sqrt();
        let damping = PI * self.mass / (2.0 * dashpot * duration);
        if damping < 1.0 {
            (-PI * damping / (1.0 - damping * damping).sqrt()).exp()
        } else {
            0.0
        }
    }

    /// The contact at this speed, m/s, with a plate whose free mass is `plate_mass`, kg: infinite when it is held.
    pub(crate) fn contact(
        &self,
        steel: &Material,
        restitution: f64,
        thickness: f64,
        plate_mass: f64,
        speed: f64,
    ) -> Contact {
        let striker = Striker {
            restitution: restitution as f32,
            ..Striker::ball(steel, self.mass, self.radius)
        };
        let mass = 1.0 / (1.0 / self.mass + 1.0 / plate_mass);
        Contact::new(
            Vec3::new(0.0, 0.0, (0.5 * thickness) as f32),
            Vec3::NEG_Z,
            (mass * speed * (1.0 + restitution)) as f32,
            speed as f32,
            striker,
        )
    }
}
