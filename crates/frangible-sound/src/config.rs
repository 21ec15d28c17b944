//! Settings of the synthesis, and its report.

use crate::error::{SoundError, within};
use crate::listener::{Listener, SoundFloor};

/// Settings of the synthesis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SynthConfig {
    /// Samples per second, 8000 to 192 000, default 48 000.
    pub rate: f64,
    /// The listener.
    pub listener: Listener,
    /// The floor, if there is one.
    pub floor: Option<SoundFloor>,
    /// Largest number of simultaneous resonators, default 16 384. Beyond it, the quietest are omitted.
    pub budget: usize,
    /// Largest number of strikes that start in a block of 128 samples, default 4096. Beyond it, those with the smallest impulses are omitted.
    pub strikes: usize,
}

impl SynthConfig {
    /// Returns settings for 48 kHz without a floor.
    #[must_use]
    pub fn new(listener: Listener) -> Self {
        Self {
            rate: 48_000.0,
            listener,
            floor: None,
            budget: 16_384,
            strikes: 4096,
        }
    }

    /// Reduces the limits for games: 1000 resonators and 64 strikes per block.
    #[must_use]
    pub fn live(self) -> Self {
        Self {
            budget: 1000,
            strikes: 64,
            ..self
        }
    }

    /// Checks every number.
    ///
    /// # Errors
    /// The first invalid number.
    pub fn validate(&self) -> Result<(), SoundError> {
        let fits = (8_000.0..=192_000.0).contains(&self.rate);
        within(
            || "the sampling rate".into(),
            self.rate,
            fits,
            "from 8000 to 192000, in 1/s",
        )?;
        self.listener.validate()?;
        self.floor.as_ref().map_or(Ok(()), SoundFloor::validate)
    }
}

/// Statistics of a synthesiser so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SynthReport {
    /// Loudest pressure, Pa.
    pub peak: f64,
    /// Largest number of simultaneous resonators.
    pub most_resonators: usize,
    /// Largest number of simultaneously ringing bodies.
    pub most_bodies: usize,
    /// Number of resonators dropped because louder ones of the same pitch mask them.
    pub masked: u64,
    /// Number of resonators dropped because of the limit.
    pub over_budget: u64,
    /// Number of strikes omitted because too many started at once.
    pub strikes_left_out: u64,
}
