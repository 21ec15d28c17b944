//! What a contact needs to know of a body's surface.

use frangible::Material;

use crate::error::{WorldError, not_negative};

/// Surface of a body as a striker meets it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceProperties {
    /// Plane-strain modulus E/(1−ν²), Pa; infinite for a rigid body.
    pub contact_modulus: f32,
    /// Coefficient of restitution, 0..=1. Rapier takes the mean of the two bodies.
    pub restitution: f32,
    /// Coulomb friction coefficient. Rapier takes the mean of the two bodies.
    pub friction: f32,
    /// Radius of curvature where it touches, m; infinite for a flat one.
    pub curvature_radius: f32,
}

/// Radius of curvature of edges and corners, m: what fragments strike with.
pub(crate) const EDGE_RADIUS: f32 = 3e-3;

impl SurfaceProperties {
    /// Hardened steel (E 210 GPa, ν 0.3). [`crate::BreakableWorld::insert_ball`] sets the radius.
    pub const STEEL: Self = Self {
        contact_modulus: 2.31e11,
        restitution: 0.6,
        friction: 0.3,
        curvature_radius: f32::INFINITY,
    };
    /// Stone or concrete floor (E 50 GPa, ν 0.2).
    pub const STONE: Self = Self {
        contact_modulus: 5.2e10,
        restitution: 0.3,
        friction: 0.6,
        curvature_radius: f32::INFINITY,
    };
    /// Wooden floor across the grain (E 1 GPa).
    pub const WOOD: Self = Self {
        contact_modulus: 1.1e9,
        restitution: 0.3,
        friction: 0.5,
        curvature_radius: f32::INFINITY,
    };

    /// Of a material, with the given radius of curvature, m.
    #[must_use]
    pub fn of(material: &Material, curvature_radius: f32) -> Self {
        Self {
            contact_modulus: material.contact_modulus() as f32,
            restitution: material.restitution as f32,
            friction: material.friction as f32,
            curvature_radius,
        }
    }

    /// Checks every number.
    ///
    /// # Errors
    /// The first field out of its range; infinite modulus and radius are allowed, NaN is not.
    pub fn validate(&self) -> Result<(), WorldError> {
        for (what, value) in [
            ("contact modulus (Pa)", self.contact_modulus),
            ("curvature radius (m)", self.curvature_radius),
        ] {
            if value.is_nan() || value <= 0.0 {
                return Err(WorldError::NotPositive { what, value });
            }
        }
        not_negative("friction", self.friction)?;
        if !(0.0..=1.0).contains(&self.restitution) {
            return Err(WorldError::Restitution(self.restitution));
        }
        Ok(())
    }
}
