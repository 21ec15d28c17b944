//! A blow that a script asks for.

use glam::Vec3;

use crate::body::Body;
use crate::config::FractureConfig;
use crate::contact::{Contact, Striker};
use crate::error::InputError;
use crate::impact::impact;
use crate::outcome::Outcome;

/// Radius of curvature of what strikes, m: a fingertip, a hammer's edge.
const RADIUS: f32 = 0.01;

/// What an impulse (N·s, body frame) at a point of the surface (m, the nearest one is taken) does to a body, as if a
/// rigid thing of 1 cm radius had struck there. Whether it breaks depends on the impulse, as ever.
///
/// # Errors
/// A number that is not finite, or an impulse of no length.
pub fn fracture_at(
    body: &Body,
    point: Vec3,
    impulse: Vec3,
    config: &FractureConfig,
) -> Result<Outcome, InputError> {
    // The speed that an immovable striker without bounce needs for this impulse.
    let size = impulse.length();
    let mass = &body.asset.mass;
    let direction = impulse.normalize_or_zero().as_dvec3();
    let give = mass.inverse_effective_mass(point.as_dvec3(), direction) as f32;
    let striker = Striker {
        curvature_radius: RADIUS,
        ..Striker::rigid()
    };
    impact(
        body,
        &[Contact::new(point, impulse, size, size * give, striker)],
        config,
    )
}
