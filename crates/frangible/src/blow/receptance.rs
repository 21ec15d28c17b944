//! What a contact feels of the body that it touches, and of one that strikes it.

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

/// Waves so much faster than Hertz' time follow the force: angular frequency times that time.
const FOLLOWING: f64 = 120.0;

/// Up to here (angular frequency times Hertz' time) a blow makes waves ring, and wall oscillators are evenly spaced.
const RINGING: f64 = 25.0;

/// Wall oscillators are so close that their echo comes this many times later than the blow is expected to last.
const ECHO: f64 = 1.3;

/// How a contact pushes a body, with its friction.
#[derive(Clone, Debug)]
pub(super) struct Push {
    /// φ · (n + f) of every mode, 1/√kg.
    pub(super) drive: Vec<f64>,
    /// Share of its force that acts across the wall behind it.
    pub(super) across: f64,
}

impl Receptance {
    /// What a contact feels of a body, and how it pushes it.
    pub(super) fn at(body: &Body, touch: &Touch, config: &FractureConfig) -> (Self, Push) {
        let asset = &*body.asset;
        let (contact, modes) = (&touch.contact, &asset.modes);
        let direction = contact.direction();
        let mut drive = touch.project(body, direction);
        let mut shape = touch.modal_shape.clone();
        let mut across = 0.0;
        let wall = (config.near_field).and_then(|theory| wall_at(body, touch, theory));
        let wall = wall.map(|(wall, inwards, served)| {
            // Across the wall the near field goes on where the modes end; along it they serve.
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
    /// A breakable body that strikes another one, and vibrates under the same force: its material, its mass, curvature and modes where it is
    /// touched. Both bodies' blows then find one force over time. `contact`: the contact as the striker feels it, in its own body frame, with the
    /// impulse **on the striker**; of its own striker nothing is asked but the restitution of the pair.
    ///
    /// # Errors
    /// What [`Contact::validate`] and [`FractureConfig::validate`] refuse.
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
    /// The waves that a contact makes of the wall, and its radius, m, for a blow of two bodies of this mass together, kg.
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
        // Never wider than the wall's own way to its edge, nor a point.
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
