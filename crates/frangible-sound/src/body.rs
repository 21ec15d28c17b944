//! A body that radiates sound: its modes, its mass and its equivalent sphere.

use glam::Vec3;

use crate::damping::{AudibleDamping, Hold};
use crate::error::{SoundError, finite, within};
use crate::sphere::EquivalentSphere;
use crate::waves::HARMONICS;

/// A body that radiates sound, as plain data. The origin of its frame is the centre of mass.
#[derive(Clone, Debug, PartialEq)]
pub struct SoundBody {
    /// Name, for messages.
    pub name: String,
    /// Mass of the rigid motion, kg; infinite for a supported body, which sounds only by its modes.
    pub mass: f64,
    /// Sphere that radiates its motion as sound.
    pub sphere: EquivalentSphere,
    /// Vibration modes; if empty, only the rigid motion is audible.
    pub modes: Vec<Mode>,
}

/// A mass-normalized mode of vibration.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// Natural frequency, Hz.
    pub frequency: f64,
    /// Total energy loss rate, 1/s: material, radiation and support. Amplitudes fall as e^{−loss·t/2}.
    pub loss: f64,
    /// Part of the loss rate due to radiation, 1/s.
    pub radiated: f64,
    /// Normal motion of the [equivalent sphere](EquivalentSphere) per unit of modal motion, 1/√kg, one per
    /// [harmonic](crate::harmonic).
    pub motion: Vec<f32>,
}

impl Mode {
    /// Creates a mode with its losses from its natural frequency, Hz, its motion on the equivalent sphere, and the damping and support of
    /// its body.
    #[must_use]
    pub fn new(
        frequency: f64,
        motion: Vec<f32>,
        sphere: &EquivalentSphere,
        damping: &AudibleDamping,
        hold: Hold,
    ) -> Self {
        let omega = std::f64::consts::TAU * frequency;
        let radiated = sphere.radiation_loss(&motion, omega);
        Self {
            frequency,
            loss: damping.loss(omega) + hold.loss(omega) + radiated,
            radiated,
            motion,
        }
    }

    /// Returns the time in which the level falls by 60 dB, s; infinite without loss.
    #[must_use]
    pub fn reverberation(&self) -> f64 {
        6.0 * std::f64::consts::LN_10 / self.loss
    }
}

impl SoundBody {
    /// Creates a rigid ball, whose modes are above the range of hearing, from its radius, m, and mass, kg.
    ///
    /// # Errors
    /// The radius or mass is not positive.
    pub fn ball(name: impl Into<String>, radius: f64, mass: f64) -> Result<Self, SoundError> {
        let body = Self {
            name: name.into(),
            mass,
            sphere: EquivalentSphere::ball(radius)?,
            modes: Vec::new(),
        };
        body.validate()?;
        Ok(body)
    }

    /// Returns the velocity change at a point, m, along a unit direction, m/s, due to an impulse of 1 N·s along it, for a rigid body with
    /// the second moments of its surface.
    #[must_use]
    pub fn yields(&self, point: Vec3, direction: Vec3) -> f64 {
        if self.mass.is_infinite() {
            return 0.0;
        }
        let back = self.sphere.axes.inverse();
        let moment = (back * point.as_dvec3()).cross(back * direction.as_dvec3());
        let squares = self.sphere.semi_axes().map(|a| a * a / 3.0);
        let all: f64 = squares.iter().sum();
        let turning: f64 = (moment.to_array().iter().zip(squares))
            .map(|(m, square)| m * m / (all - square))
            .sum();
        (1.0 + turning) / self.mass
    }

    /// Checks every number.
    ///
    /// # Errors
    /// The first invalid number.
    pub fn validate(&self) -> Result<(), SoundError> {
        let name = &self.name;
        if self.mass.is_nan() || self.mass <= 0.0 {
            let what = format!("the mass of \"{name}\"");
            return Err(SoundError::OutOfRange {
                what,
                value: self.mass,
                range: "above zero, in kg",
            });
        }
        let radius = self.sphere.radius;
        within(
            || format!("the radius of \"{name}\""),
            radius,
            radius > 0.0,
            "above zero, in m",
        )?;
        for (i, mode) in self.modes.iter().enumerate() {
            let of = |what: &str| format!("the {what} of mode {i} of \"{name}\"");
            within(
                || of("frequency"),
                mode.frequency,
                mode.frequency > 0.0,
                "above zero, in Hz",
            )?;
            within(
                || of("loss"),
                mode.loss,
                mode.loss >= 0.0,
                "zero or above, in 1/s",
            )?;
            if mode.motion.len() != HARMONICS {
                return Err(SoundError::BadCount {
                    what: of("motion"),
                    count: mode.motion.len(),
                    expected: format!("{HARMONICS}, one per harmonic, are"),
                });
            }
            for &c in &mode.motion {
                finite(|| of("motion"), f64::from(c))?;
            }
        }
        Ok(())
    }
}
