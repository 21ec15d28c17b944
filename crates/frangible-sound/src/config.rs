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
    /// Resonators that ring at once, default 16 384. Fewer cost less time, and the quietest are left out.
    pub budget: usize,
    /// Strikes that begin in one block of 128 samples, default 4096. Of more, those of the least impulse are left out.
    pub strikes: usize,
}

impl SynthConfig {
    /// Settings for 48 kHz without a floor.
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

    /// These settings for a game: a budget of 1000 resonators and 64 strikes per block.
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
    /// The first number at fault.
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
    /// Most resonators that rang at once.
    pub most_resonators: usize,
    /// Most bodies that rang at once.
    pub most_bodies: usize,
    /// Resonators that were let go because louder ones of the same pitch mask them.
    pub masked: u64,
    /// Resonators that were let go because there were more than the budget.
    pub over_budget: u64,
    /// Strikes that were left out because too many began at once.
    pub strikes_left_out: u64,
}
