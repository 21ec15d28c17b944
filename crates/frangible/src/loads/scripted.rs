//! A blow that a script asks for.

use glam::Vec3;

use crate::body::Body;
use crate::config::FractureConfig;
use crate::contact::{Contact, Striker, hertz_at};
use crate::error::InputError;
use crate::impact::impact;
use crate::outcome::Outcome;

/// Radius of curvature of what strikes, m: a fingertip, a hammer's edge.
const RADIUS: f32 = 0.01;

/// Computes the outcome of an impulse (N·s, body frame) at a point of the surface (m, the nearest one is taken): a half-sine as long as
/// Hertz's law gives for a rigid striker of 1 cm radius with this impulse. Whether the body breaks depends on the impulse, as ever.
///
/// # Errors
/// A number that is not finite, or an impulse of no length; the errors of [`FractureConfig::validate`].
pub fn fracture_at(
    body: &Body,
    point: Vec3,
    impulse: Vec3,
    config: &FractureConfig,
) -> Result<Outcome, InputError> {
    let striker = Striker {
        curvature_radius: RADIUS,
        ..Striker::rigid()
    };
    // The speed that an immovable striker without bounce needs for this impulse.
    let size = impulse.length();
    let mut contact = Contact {
        impulse: size,
        ..Contact::strike(point, impulse, 0.0, striker)
    };
    contact.validate()?;
    let asset = &*body.asset;
    let at = body.prepared.surface.closest(point);
    let direction = impulse.normalize_or_zero().as_dvec3();
    let give = asset
        .mass
        .inverse_effective_mass(at.position.as_dvec3(), direction);
    contact.approach_speed = size * give as f32;
    let radius = f64::from(asset.surface.curvature_radius[at.triangle as usize]);
    let given = if asset.is_supported() { 0.0 } else { give };
    contact.duration = hertz_at(asset, &contact, radius, given) as f32;
    impact(body, &[contact], config)
}
