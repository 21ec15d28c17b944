//! What the rigid-body engine tells us of an impact.

use glam::Vec3;

use crate::error::{InputError, finite, positive};

/// One contact of an impact, in the body frame of the body that may break.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Where, m.
    pub point: Vec3,
    /// Unit direction of the impulse **on this body** (from the striker into the body).
    pub normal: Vec3,
    /// Magnitude φ of the normal impulse, N·s.
    pub impulse: f32,
    /// Speed of approach along the normal before the rigid-body step, m/s.
    pub approach_speed: f32,
    /// What hit the body.
    pub striker: Striker,
}

/// What a contact needs to know of the other body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Striker {
    /// Plane-strain modulus E/(1−ν²), Pa; infinite for a rigid striker.
    pub contact_modulus: f32,
    /// nᵀ K n of the striker at the contact, 1/kg; zero for one that cannot move.
    pub inverse_effective_mass: f32,
    /// Radius of curvature at the contact, m; infinite for a flat one.
    pub curvature_radius: f32,
    /// Coefficient of restitution of the pair, 0..=1.
    pub restitution: f32,
}

impl Contact {
    /// Checks that every number can be used.
    ///
    /// # Errors
    /// Names the first field that is NaN, negative or not a unit vector.
    pub fn validate(&self) -> Result<(), InputError> {
        finite("a contact's point", self.point)?;
        finite("a contact's normal", self.normal)?;
        positive(
            "the length of a contact's normal",
            f64::from(self.normal.length()),
            "",
        )?;
        for (what, value) in [
            ("a contact's impulse (N·s)", self.impulse),
            ("a contact's approach speed (m/s)", self.approach_speed),
            (
                "a striker's inverse effective mass (1/kg)",
                self.striker.inverse_effective_mass,
            ),
        ] {
            if !(value.is_finite() && value >= 0.0) {
                return Err(InputError::Negative {
                    what,
                    value: f64::from(value),
                });
            }
        }
        // Infinity is meant here: a rigid or a flat striker.
        for (what, value) in [
            ("a striker's contact modulus", self.striker.contact_modulus),
            (
                "a striker's radius of curvature",
                self.striker.curvature_radius,
            ),
        ] {
            if value.is_nan() || value <= 0.0 {
                return Err(InputError::NotPositive {
                    what,
                    value: f64::from(value),
                    unit: "",
                });
            }
        }
        if !(0.0..=1.0).contains(&self.striker.restitution) {
            return Err(InputError::Restitution(f64::from(self.striker.restitution)));
        }
        Ok(())
    }
}
