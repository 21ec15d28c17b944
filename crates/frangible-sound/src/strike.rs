//! What makes a body sound: forces on it, and cracks through it.

use std::sync::Arc;

use glam::Vec3;

use crate::body::Body;
use crate::complex::Complex;
use crate::error::{SoundError, finite};
use crate::pulse::Pulse;

/// A force on a body, or several that act together.
#[derive(Clone, Debug, PartialEq)]
pub struct Strike {
    /// The force over time.
    pub pulse: Arc<Pulse>,
    /// What one newton of it gives each mode, 1/√kg: φ_i(x)·n, as [`AssetSound::push`](crate::AssetSound::push) finds it. Empty: nothing; else
    /// one per mode.
    pub push: Vec<f32>,
    /// The direction of the force in the body's frame, by which the body is moved as a whole; zero for forces in balance.
    pub direction: Vec3,
}

impl Strike {
    /// Checks every number, for this body.
    ///
    /// # Errors
    /// The first number at fault.
    pub fn validate(&self, body: &Body) -> Result<(), SoundError> {
        self.pulse.validate()?;
        let name = &body.name;
        if !self.push.is_empty() && self.push.len() != body.modes.len() {
            return Err(SoundError::BadCount {
                what: format!("the push of a strike on \"{name}\""),
                count: self.push.len(),
                expected: format!("none or {}, one per mode, are", body.modes.len()),
            });
        }
        for &push in &self.push {
            finite(
                || format!("the push of a strike on \"{name}\""),
                f64::from(push),
            )?;
        }
        for part in self.direction.to_array() {
            let what = || format!("the direction of a strike on \"{name}\"");
            finite(what, f64::from(part))?;
        }
        Ok(())
    }

    /// The vibration energy that a body is left with, J, at the time of the strike's beginning and without what it loses meanwhile.
    #[must_use]
    pub fn energy(&self, body: &Body) -> f64 {
        let modes = body.modes.iter().zip(&self.push);
        let energy = modes.filter_map(|(mode, &push)| {
            let given = self.pulse.spectrum(pole(mode.frequency, 0.0)?);
            Some(0.5 * f64::from(push).powi(2) * given.norm_squared())
        });
        energy.sum()
    }

    /// A crack that is heard: while it opens the stress of its faces falls, on both sides alike, and that shakes what it runs through.
    ///
    /// The release is a half-sine of a duration, s: the crack's length over its speed. Its shape on the modes is the push of a force on the
    /// crack's faces, and its size is such that the modes get this energy, J. `None` where they cannot take any.
    #[must_use]
    pub fn crack(body: &Body, push: Vec<f32>, duration: f64, energy: f64) -> Option<Self> {
        if duration <= 0.0 || energy <= 0.0 || !(duration * energy).is_finite() {
            return None;
        }
        let unit = Self {
            pulse: Arc::new(Pulse::half_sine(duration, duration)),
            push,
            direction: Vec3::ZERO,
        };
        let given = unit.energy(body);
        let scale = (energy / given).sqrt();
        (given > 0.0 && scale.is_finite()).then(|| Self {
            pulse: Arc::new(Pulse::half_sine(scale * duration, duration)),
            ..unit
        })
    }
}

/// Share of the energy that cracks take which leaves them as waves in the body. The rest opens the surfaces and is heat. No figure for
/// glass or porcelain was found; Boudet, Ciliberto and Steinberg (J. Phys. II France 6, 1996, 1493) heard sound from cracks in PMMA that grows
/// with their roughness, and a few per cent is the size of it in reviews of the dynamic fracture. An estimate.
pub const CRACK_SHARE: f64 = 0.03;

/// Speed at which cracks are taken to run, as a share of the Rayleigh wave's; brittle cracks fork and keep to about this.
pub const CRACK_SPEED: f64 = 0.4;

/// λ of a mode: frequency, Hz, and loss of energy, 1/s. `None` where it does not swing even twice before it is gone.
pub(crate) fn pole(frequency: f64, loss: f64) -> Option<Complex> {
    let (omega, half) = (std::f64::consts::TAU * frequency, 0.5 * loss);
    (half < 0.3 * omega).then(|| Complex::new(-half, (omega * omega - half * half).sqrt()))
}
