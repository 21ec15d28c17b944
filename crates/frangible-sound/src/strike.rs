//! Excitation of a body: forces and cracks.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use glam::Vec3;
use num_complex::Complex64;

use crate::body::SoundBody;
use crate::error::{SoundError, finite};
use crate::of_asset::HIGHEST;
use crate::pulse::{SoundPulse, half_sine_share};

/// A force on a body, or several simultaneous forces.
#[derive(Clone, Debug, PartialEq)]
pub struct Strike {
    /// The force over time.
    pub pulse: Arc<SoundPulse>,
    /// Modal forces per newton, 1/√kg: φ_i(x)·n, one per mode, as returned by [`AssetSound::push`](crate::AssetSound::push). If empty, no
    /// mode is excited.
    pub push: Vec<f32>,
    /// Direction of the resultant force in the body frame, which moves the body rigidly; zero for balanced forces.
    pub direction: Vec3,
}

impl Strike {
    /// Checks every number, for this body.
    ///
    /// # Errors
    /// The first invalid number.
    pub fn validate(&self, body: &SoundBody) -> Result<(), SoundError> {
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

    /// Returns the vibration energy that the strike leaves in a body, J, neglecting losses during the strike.
    #[must_use]
    pub fn energy(&self, body: &SoundBody) -> f64 {
        let modes = body.modes.iter().zip(&self.push);
        let energy = modes.filter_map(|(mode, &push)| {
            let given = self.pulse.spectrum(pole(mode.frequency, 0.0)?);
            Some(0.5 * f64::from(push).powi(2) * given.norm_sqr())
        });
        energy.sum()
    }

    /// A crack that is heard: while it opens, the stress of its faces falls, on both sides alike, and that shakes the body.
    ///
    /// The release is a half-sine of a duration, s: the crack's length over its speed. Its shape on the modes is the push of a force on the
    /// crack's faces, and its size is such that all modes together get this energy, J; those that are heard get the part of it that a
    /// half-sine has between the lowest mode and [`HIGHEST`](crate::HIGHEST), modes being about as many in each hertz. `None` where they
    /// cannot take any.
    #[must_use]
    pub fn crack(body: &SoundBody, push: Vec<f32>, duration: f64, energy: f64) -> Option<Self> {
        if duration <= 0.0 || energy <= 0.0 || !(duration * energy).is_finite() {
            return None;
        }
        let unit = Self {
            pulse: Arc::new(SoundPulse::half_sine(duration, duration)),
            push,
            direction: Vec3::ZERO,
        };
        let given = unit.energy(body);
        let lowest = body.modes.first().map_or(HIGHEST, |mode| mode.frequency);
        // The square of a half-sine's spectrum is at most 1, and is π²/(16 τ) in sum over all frequencies.
        let band = (HIGHEST - lowest).max(0.0);
        let heard = (band * 16.0 * duration / PI.powi(2)).min(1.0);
        let scale = (heard * energy / given).sqrt();
        (given > 0.0 && scale.is_finite()).then(|| Self {
            pulse: Arc::new(SoundPulse::half_sine(scale * duration, duration)),
            ..unit
        })
    }
}

/// The first push between two bodies that come together with a speed, m/s: its impulse, N·s, and its duration, s.
///
/// One newton-second changes the speed of rigid bodies by their [`SoundBody::yields`] in sum, m/s. Modes that are fast enough to answer
/// yield as well, so that less mass has to be stopped at first, and the push is both smaller and shorter. The modes then never get more than
/// a quarter of the energy of the approach, where the impulse of rigid bodies could give them many times that. `takes` finds a push's
/// duration, s, from the mass that it stops, kg.
#[must_use]
pub fn first_push(
    speed: f64,
    yields: f64,
    bodies: &[(&SoundBody, &[f32])],
    takes: impl Fn(f64) -> f64,
) -> (f64, f64) {
    if yields <= 0.0 {
        return (0.0, takes(f64::MAX));
    }
    let mut mass = 1.0 / yields;
    let mut duration = takes(mass);
    for _ in 0..ROUNDS {
        let ringing: f64 = bodies
            .iter()
            .flat_map(|(body, push)| body.modes.iter().zip(*push))
            .map(|(mode, &push)| {
                let share = half_sine_share(TAU * mode.frequency, duration);
                (f64::from(push) * share).powi(2)
            })
            .sum();
        // The mean of both in their logarithm: a shorter push rings more, and that makes it shorter.
        mass = (mass / (yields + ringing)).sqrt();
        duration = takes(mass);
    }
    (speed * mass, duration)
}

/// Rounds in which the push and the answering modes are made to agree: each halves the error, so that a factor of ten becomes 0.2 %.
const ROUNDS: usize = 10;

/// Share of the energy that cracks take which leaves them as waves in the body. The rest opens the surfaces and is heat. No figure for
/// glass or porcelain was found; Boudet, Ciliberto and Steinberg (J. Phys. II France 6, 1996, 1493) heard sound from cracks in PMMA that grows
/// with their roughness, and a few per cent is the size of it in reviews of the dynamic fracture. An estimate.
pub const CRACK_SHARE: f64 = 0.03;

/// Speed at which cracks are taken to run, as a share of the Rayleigh wave's; brittle cracks fork and keep to about this.
pub const CRACK_SPEED: f64 = 0.4;

/// λ of a mode: frequency, Hz, and loss of energy, 1/s. `None` where it does not swing even twice before it is gone.
pub(crate) fn pole(frequency: f64, loss: f64) -> Option<Complex64> {
    let (omega, half) = (TAU * frequency, 0.5 * loss);
    (half < 0.3 * omega).then(|| Complex64::new(-half, (omega * omega - half * half).sqrt()))
}
