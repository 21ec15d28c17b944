//! Sound of a force on the floor, and of a small part of a wall that moves by itself.

use std::sync::Arc;

use glam::DVec3;

use crate::air::{AIR_DENSITY, SPEED_OF_SOUND};
use crate::bank::BLOCK;
use crate::config::SynthConfig;
use crate::listener::Ways;
use crate::pulse::SoundPulse;

/// A source at a place that a pulse drives.
#[derive(Clone, Debug)]
pub(crate) struct Thump {
    start: f64,
    pulse: Arc<SoundPulse>,
    /// Pressure per rate of change of a force on the floor, Pa·s/N, or per acceleration of a volume, Pa·s²/m³.
    size: f64,
    /// True for a force.
    grows: bool,
    pub(crate) ways: Ways,
}

impl Thump {
    /// A push that begins at a time in samples; `None` without a floor.
    pub(crate) fn new(
        config: &SynthConfig,
        start: f64,
        place: DVec3,
        pulse: Arc<SoundPulse>,
    ) -> Option<Self> {
        let floor = config.floor.as_ref()?;
        let listener = &config.listener;
        let way = listener.place - place;
        let sine = DVec3::new(way.x, 0.0, way.z).length() / way.length().max(1e-9);
        let stiffness = floor.shear_modulus * sine.max(0.25) / (1.0 - floor.poisson_ratio);
        let spread = 2.0 * std::f64::consts::PI * listener.distance(place);
        Some(Self {
            start,
            pulse,
            size: AIR_DENSITY * SPEED_OF_SOUND / (spread * stiffness),
            grows: true,
            ways: Ways::from_floor(listener, config.rate, place),
        })
    }

    /// A piston in a wall that begins at a time in samples; its pulse is the acceleration of the volume that it pushes away, m³/s².
    pub(crate) fn piston(
        config: &SynthConfig,
        start: f64,
        place: DVec3,
        pulse: Arc<SoundPulse>,
    ) -> Self {
        let listener = &config.listener;
        let spread = 2.0 * std::f64::consts::PI * listener.distance(place);
        Self {
            start,
            pulse,
            size: AIR_DENSITY / spread,
            grows: false,
            ways: Ways::new(listener, config.floor.as_ref(), config.rate, place, 0.0),
        }
    }

    /// Returns true if it goes on after a time in samples.
    pub(crate) fn lasts(&self, rate: f64, end: f64) -> bool {
        self.start + self.pulse.duration() * rate + 1.0 >= end
    }

    /// The block's pressure: by the growth of a force over each sample, or by the acceleration of a volume.
    pub(crate) fn heard(&self, rate: f64, now: f64) -> [f32; BLOCK] {
        std::array::from_fn(|n| {
            let time = (now + n as f64 - self.start) / rate;
            let value = self.pulse.at(time).0;
            let driven = if self.grows {
                (value - self.pulse.at(time - 1.0 / rate).0) * rate
            } else {
                value
            };
            (self.size * driven) as f32
        })
    }
}
