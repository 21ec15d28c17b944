//! Receptance of the body that a contact touches, and of one that strikes it.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use glam::Vec3;

use super::plan::Site;
use super::wall::wall_at;
use crate::body::Body;
use crate::config::FractureConfig;
use crate::contact::{Contact, Receptance, Striker, Touch, WallReceptance, modal_load};
use crate::error::InputError;
use crate::near_field::{Bands, Spacing};

/// Angular frequency times Hertz's time from which on waves follow the force.
const FOLLOWING: f64 = 120.0;

/// Angular frequency times Hertz's time up to which a blow makes waves ring. Up to there wall oscillators are evenly spaced.
const RINGING: f64 = 25.0;

/// Time of the wall oscillators' echo over the expected duration of the blow, which sets their spacing.
const ECHO: f64 = 1.3;

/// Push of a contact on a body, with its friction.
#[derive(Clone, Debug)]
pub(super) struct Push {
    /// φ · (n + f) of every mode, 1/√kg.
    pub(super) drive: Vec<f64>,
    /// Share of its force that acts across the wall behind it.
    pub(super) across: f64,
}

impl Receptance {
    /// Receptance of a body under a contact, and the contact's push on it.
    pub(super) fn at(body: &Body, touch: &Touch, config: &FractureConfig) -> (Self, Push) {
        let asset = &*body.asset;
        let (contact, modes) = (&touch.contact, &asset.modes);
        let direction = contact.direction();
        let mut drive = touch.project(body, direction);
        let mut shape = touch.modal_shape.clone();
        let mut across = 0.0;
        let wall = (config.near_field).and_then(|theory| wall_at(body, touch, theory));
        let wall = wall.map(|(wall, inwards, served)| {
            // Across the wall the near field takes over where the modes end; along it the modes remain.
            let along = |v: Vec3| v - v.dot(inwards) * inwards;
            let (drive_along, shape_along) = (
                touch.project(body, along(direction)),
                touch.project(body, along(contact.normal)),
            );
            drive[served..].copy_from_slice(&drive_along[served..]);
            shape[served..].copy_from_slice(&shape_along[served..]);
            across = f64::from(direction.dot(inwards));
            wall
        });
        let followed = modes.followed();
        if !config.residual {
            drive[followed..].fill(0.0);
            shape[followed..].fill(0.0);
        }
        let felt = Self {
            eigenvalues: modes.eigenvalues.clone(),
            followed,
            stiffness_damping: asset.material.stiffness_damping,
            mass_damping: asset.material.mass_damping,
            shape,
            wall,
            ball_radius: asset.ball_radius(),
        };
        (felt, Push { drive, across })
    }
}

impl Striker {
    /// Describes a breakable body that strikes another one and vibrates under the same force: its material, and its mass, curvature and modes at the
    /// place of contact. The blows on both bodies then have the same force over time.
    ///
    /// `contact` is the contact on the striker, in the striker's body frame, with the impulse **on the striker**; of its own `striker` only the
    /// restitution of the pair is used.
    ///
    /// # Errors
    /// Returns the errors of [`Contact::validate`] and [`FractureConfig::validate`].
    pub fn flexible(
        body: &Body,
        contact: &Contact,
        config: &FractureConfig,
    ) -> Result<Self, InputError> {
        contact.validate()?;
        config.validate()?;
        let load = modal_load(body, [contact]);
        let touch = &load.touches[0];
        Ok(Self {
            inverse_effective_mass: touch.inverse_effective_mass as f32,
            curvature_radius: (touch.curvature_radius as f32).max(Self::EDGE_RADIUS),
            restitution: contact.striker.restitution,
            receptance: Some(Arc::new(Receptance::at(body, touch, config).0)),
            ..Self::fixed(&body.asset.material)
        })
    }
}

impl WallReceptance {
    /// Bands of waves that a contact makes in the wall, and its radius, m, for a blow with this effective mass of both bodies, kg.
    pub(super) fn bands(&self, site: &Site, mass: f64) -> (Bands, f64) {
        let wall = &self.material;
        let speed = f64::from(site.touch.contact.approach_speed);
        let time = site.duration;
        let (duration, peak) = match site.script {
            Some([impulse, duration]) => (duration, 0.5 * PI * impulse / duration),
            None => (
                time * site.spring.stretch(mass, speed) + 3.0 * mass / wall.dashpot(),
                site.spring.peak_force(mass, speed, wall.dashpot()),
            ),
        };
        // Neither wider than the wall allows, nor a point.
        let radius = (site.spring.contact_radius(peak)).clamp(1e-3 * wall.thickness, self.widest);
        let spacing = Spacing {
            width: TAU / (ECHO * duration),
            even_to: RINGING / time,
            follows_from: FOLLOWING / time,
        };
        let start = wall.wave_number(self.lowest);
        (Bands::new(wall, start, radius, spacing), radius)
    }
}
