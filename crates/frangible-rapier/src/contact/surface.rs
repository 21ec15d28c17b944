//! Surface properties for contacts.

use frangible::Material;
use frangible::internals::Preset;

use crate::error::{WorldError, not_negative};

/// Surface properties of a body for contacts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceProperties {
    /// Plane-strain modulus E/(1−ν²), Pa; infinite for a rigid body.
    pub contact_modulus: f32,
    /// Contact pressure that crushes or permanently dents it, Pa; infinite if none does.
    pub crushing_pressure: f32,
    /// Coefficient of restitution, 0..=1. Rapier takes the mean of the two bodies.
    pub restitution: f32,
    /// Coulomb friction coefficient. Rapier takes the mean of the two bodies.
    pub friction: f32,
    /// Radius of curvature at the contact, m; infinite for a flat surface.
    pub curvature_radius: f32,
}

impl SurfaceProperties {
    /// The steel of [`Preset::STEEL`], flat. [`crate::BreakableWorld::insert_ball`] sets the radius.
    pub const STEEL: Self = Self::flat(&Preset::STEEL);
    /// The granite of [`Preset::STONE`], flat: a floor.
    pub const STONE: Self = Self::flat(&Preset::STONE);
    /// The oak of [`Preset::WOOD`], flat: a floor, a table top.
    pub const WOOD: Self = Self::flat(&Preset::WOOD);

    /// A flat surface of a preset material.
    #[must_use]
    pub const fn flat(preset: &Preset) -> Self {
        Self {
            contact_modulus: preset.contact_modulus() as f32,
            crushing_pressure: preset.crushing_pressure() as f32,
            restitution: preset.restitution() as f32,
            friction: preset.friction() as f32,
            curvature_radius: f32::INFINITY,
        }
    }

    /// The surface of a material, with the given radius of curvature, m.
    #[must_use]
    pub fn of(material: &Material, curvature_radius: f32) -> Self {
        Self {
            contact_modulus: material.contact_modulus() as f32,
            crushing_pressure: material.crushing_pressure as f32,
            restitution: material.restitution as f32,
            friction: material.friction as f32,
            curvature_radius,
        }
    }

    /// Checks every number.
    ///
    /// # Errors
    /// The first field that is out of range. Infinite modulus, pressure and radius are allowed, NaN is not.
    pub fn validate(&self) -> Result<(), WorldError> {
        for (what, value) in [
            ("contact modulus (Pa)", self.contact_modulus),
            ("curvature radius (m)", self.curvature_radius),
        ] {
            if value.is_nan() || value <= 0.0 {
                return Err(WorldError::NotPositive { what, value });
            }
        }
        let pressure = f64::from(self.crushing_pressure);
        if pressure.is_nan() || pressure < Material::LEAST_CRUSHING_PRESSURE {
            return Err(WorldError::CrushingPressure(self.crushing_pressure));
        }
        not_negative("friction", self.friction)?;
        if !(0.0..=1.0).contains(&self.restitution) {
            return Err(WorldError::Restitution(self.restitution));
        }
        Ok(())
    }
}
