//! Duration of a contact `[G12 §4.1]`.
//!
//! Hertz: two elastic spheres touch for `t_d = 2.868 (m*²/(E*² r* v))^(1/5)` `[G12 Eq. 1]`.
//! `[G12 Eq. 2]` puts the most excited mode in its place, but as printed its dimensions do not agree;
//! since m/(E r) is 1/ω² up to a constant, the modal form of Eq. 1 is `t_d = 2.868 (r/(λ² v))^(1/5)`.
//!
//! Range of validity: Hertz for a small hard striker on a large body, because the blow is over before the slow modes respond; the modal
//! form for a whole body that lands softly, so that the contact lasts through its own oscillation.

use glam::Vec3;

use super::{Contact, Load, Touch, modal_load};
use crate::asset::Asset;
use crate::body::Body;
use crate::config::DurationModel;

/// Hertz's constant for the duration of the contact of two spheres.
pub(super) const HERTZ: f64 = 2.868;

/// Sharpest radius of a contact, m: edges and corners of real things are rounded or crumble to about this.
pub(super) const SHARPEST_RADIUS: f64 = 3e-3;

/// Slowest approach a duration is computed for, m/s; the fifth root makes its choice unimportant.
const SLOWEST_APPROACH: f64 = 1e-3;

/// `2.868 (m*²/(E*² r* v))^(1/5)`, s, from effective mass (kg), modulus (Pa), radius (m), approach speed (m/s) `[G12 Eq. 1]`.
#[must_use]
pub fn hertz_duration(mass: f64, modulus: f64, radius: f64, speed: f64) -> f64 {
    HERTZ * libm::pow(mass * mass / (modulus * modulus * radius * speed), 0.2)
}

/// `2.868 (r/(λ² v))^(1/5)`, s: `[G12 Eq. 2]` with consistent dimensions.
#[must_use]
pub fn modal_hertz_duration(eigenvalue: f64, radius: f64, speed: f64) -> f64 {
    HERTZ * libm::pow(radius / (eigenvalue * eigenvalue * speed), 0.2)
}

/// The mode that an impulse displaces most, `argmax |ξ_i|/√λ_i`, among those with a damping ratio below 0.9
/// (just below critical damping Im ω → 0 would win every time) `[G12 §4.1]`.
#[must_use]
pub fn most_excited_mode(asset: &Asset, modal_shape: &[f64]) -> Option<usize> {
    let amplitude = |i: usize| modal_shape[i].abs() / asset.modes.eigenvalues[i].sqrt();
    (0..asset.modes.followed())
        .filter(|&i| {
            asset.modes.damping(i, &asset.material) < 0.9 * 2.0 * asset.modes.eigenvalues[i].sqrt()
        })
        .max_by(|&i, &j| amplitude(i).total_cmp(&amplitude(j)).then(j.cmp(&i)))
}

/// Contact duration of a breakable body's own vibration, s: the [`Striker::modal_duration`](super::Striker::modal_duration) that the other
/// body uses.
#[must_use]
pub fn answer_duration(body: &Body, contact: &Contact, model: DurationModel) -> f64 {
    let alone = [Contact {
        friction: Vec3::ZERO,
        striker: super::Striker {
            contact_modulus: f32::INFINITY,
            modal_duration: 0.0,
            shared: None,
            ..contact.striker.clone()
        },
        ..contact.clone()
    }];
    contact_duration(&body.asset, &modal_load(body, &alone), model)
}

/// Duration of the impact, s: the shortest of its contacts.
#[must_use]
pub fn contact_duration(asset: &Asset, load: &Load, model: DurationModel) -> f64 {
    load.touches
        .iter()
        .map(|touch| touch_duration(asset, touch, model))
        .fold(f64::INFINITY, f64::min)
}

/// Duration of a contact by a model, s, or as a script gives it.
pub(crate) fn touch_duration(asset: &Asset, touch: &Touch, model: DurationModel) -> f64 {
    if touch.contact.is_script() {
        return f64::from(touch.contact.duration);
    }
    let (radius, give) = (touch.curvature_radius, touch.inverse_effective_mass);
    let hertz = hertz_at(asset, &touch.contact, radius, give);
    let speed = f64::from(touch.contact.approach_speed).max(SLOWEST_APPROACH);
    let mode = match model {
        DurationModel::Integrated | DurationModel::Hertz => None,
        _ => most_excited_mode(asset, &touch.modal_shape),
    };
    let Some(mode) = mode else {
        return hertz;
    };
    let eigenvalue = asset.modes.eigenvalues[mode];
    match model {
        DurationModel::Integrated | DurationModel::Hertz => hertz,
        DurationModel::ModalHertz => {
            let radius = touch
                .curvature_radius
                .clamp(SHARPEST_RADIUS, asset.ball_radius());
            // The longer of the two bodies' durations: a rigid striker answers 0, an elastic one with Hertz, one that
            // vibrates itself with its own.
            let striker = &touch.contact.striker;
            let answer = if striker.modal_duration > 0.0 {
                f64::from(striker.modal_duration)
            } else if striker.contact_modulus.is_finite() {
                hertz
            } else {
                0.0
            };
            modal_hertz_duration(eigenvalue, radius, speed).max(answer)
        }
        DurationModel::AsPrinted { c } => {
            let damping = asset.modes.damping(mode, &asset.material);
            let frequency = (eigenvalue - 0.25 * damping * damping).sqrt();
            let own = c * libm::pow((std::f64::consts::TAU / frequency).powi(2) / speed, 0.2);
            own.max(f64::from(touch.contact.striker.modal_duration))
        }
    }
}

/// Hertz's duration of a contact, s, where the body has this radius of curvature, m, and nᵀ K n, 1/kg.
pub(crate) fn hertz_at(
    asset: &Asset,
    contact: &Contact,
    curvature_radius: f64,
    inverse_effective_mass: f64,
) -> f64 {
    let striker = &contact.striker;
    let inverse = inverse_effective_mass + f64::from(striker.inverse_effective_mass);
    // Neither gives way when a held body is hit by an immovable one; the body's own mass stands in.
    let mass = if inverse > 0.0 {
        1.0 / inverse
    } else {
        asset.mass.mass
    };
    let modulus =
        1.0 / (1.0 / asset.material.contact_modulus() + 1.0 / f64::from(striker.contact_modulus));
    let radius = contact_radius_of_curvature(asset, contact, curvature_radius);
    let speed = f64::from(contact.approach_speed).max(SLOWEST_APPROACH);
    hertz_duration(mass, modulus, radius, speed)
}

/// Radius of the curvatures of both bodies together, m, where the struck one has this radius of curvature, m.
pub(crate) fn contact_radius_of_curvature(
    asset: &Asset,
    contact: &Contact,
    curvature_radius: f64,
) -> f64 {
    let own = curvature_radius.max(SHARPEST_RADIUS);
    let other = f64::from(contact.striker.curvature_radius).max(1e-4);
    let curvature = 1.0 / own + 1.0 / other;
    // Flat on flat has no Hertz contact; the ball of the body's volume stands in, of two bodies that vibrate the smaller one.
    let vibrates = contact.striker.receptance.as_ref();
    let ball = vibrates.map_or(f64::INFINITY, |felt| felt.ball_radius);
    let ball = ball.min(asset.ball_radius());
    if curvature > 0.0 {
        (1.0 / curvature).min(ball)
    } else {
        ball
    }
}
