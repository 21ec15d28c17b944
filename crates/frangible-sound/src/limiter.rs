//! A soft limiter for live playback, where the largest pressure is not known in advance.

use crate::error::{SoundError, checked_full_scale};

/// Statistics of a limiter so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LimiterReport {
    /// Loudest pressure so far, Pa.
    pub peak: f64,
    /// Number of samples whose level was reduced.
    pub limited: u64,
    /// Reduction of the loudest of them, dB; 0 if none.
    pub reduction: f64,
}

/// Share of full scale up to which a pressure stays as it is; above it, it is bent ever more.
const KNEE: f64 = 0.7;

/// Converts pressures to samples from −1 to 1, with soft limiting above 0.7 of full scale.
#[derive(Clone, Debug)]
pub struct Limiter {
    /// Pressure of full scale, Pa.
    full_scale: f64,
    report: LimiterReport,
}

impl Default for Limiter {
    /// A full scale of 20 Pa, 117 dB: the first blow of a glass a metre away is louder and is bent, and its shards are clear.
    fn default() -> Self {
        Self {
            full_scale: 20.0,
            report: LimiterReport::default(),
        }
    }
}

impl Limiter {
    /// Creates a limiter with this full-scale pressure, Pa; [`Limiter::default`] uses 20.
    ///
    /// # Errors
    /// The pressure is not finite or not positive.
    pub fn new(full_scale: f64) -> Result<Self, SoundError> {
        Ok(Self {
            full_scale: checked_full_scale(full_scale)?,
            ..Self::default()
        })
    }

    /// Returns its statistics so far.
    #[must_use]
    pub fn report(&self) -> LimiterReport {
        self.report
    }

    /// Converts a pressure, Pa, to a sample within ±1, with a continuous slope.
    #[must_use]
    pub fn sample(&mut self, pressure: f32) -> f32 {
        let size = f64::from(pressure.abs());
        // A pressure that is no number can only come of an overflow, and is full scale.
        let size = if size.is_finite() {
            size
        } else {
            1e6 * self.full_scale
        };
        self.report.peak = self.report.peak.max(size);
        let share = size / self.full_scale;
        if share <= KNEE {
            return (share as f32).copysign(pressure);
        }
        let room = 1.0 - KNEE;
        let bent = KNEE + room * ((share - KNEE) / room).tanh();
        self.report.limited += 1;
        self.report.reduction = self.report.reduction.max(20.0 * (share / bent).log10());
        // Below 1 also after rounding.
        (bent.min(0.999_99) as f32).copysign(pressure)
    }
}
