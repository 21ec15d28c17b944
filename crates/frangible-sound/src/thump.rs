//! Sound of a force on the floor.

use std::sync::Arc;

use glam::DVec3;

use crate::air::{AIR_DENSITY, SPEED_OF_SOUND};
use crate::bank::BLOCK;
use crate::config::SynthConfig;
use crate::listener::Ways;
use crate::pulse::SoundPulse;

/// A force on the floor.
#[derive(Clone, Debug)]
pub(crate) struct Thump {
    start: f64,
    pulse: Arc<SoundPulse>,
    /// Pressure per rate of change of the force, Pa·s/N.
    size: f64,
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
            ways: Ways::from_floor(listener, config.rate, place),
        })
    }

    /// Returns true if it goes on after a time in samples.
    pub(crate) fn lasts(&self, rate: f64, end: f64) -> bool {
        self.start + self.pulse.duration() * rate + 1.0 >= end
    }

    /// The block's pressure: the growth of the force over each sample.
    pub(crate) fn heard(&self, rate: f64, now: f64) -> [f32; BLOCK] {
        std::array::from_fn(|n| {
            let time = (now + n as f64 - self.start) / rate;
            let growth = (self.pulse.at(time).0 - self.pulse.at(time - 1.0 / rate).0) * rate;
            (self.size * growth) as f32
        })
    }
}
