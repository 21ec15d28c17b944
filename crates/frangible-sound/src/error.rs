//! Errors in the input of the synthesis.

use thiserror::Error;

/// Error in the input of the synthesis. Each message says how to fix it.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum SoundError {
    /// A number is NaN or infinite.
    #[error("{what} is {value}, not a finite number; check the simulation step that produced it")]
    NotFinite {
        /// Name of the number, in words.
        what: String,
        /// Its value.
        value: f64,
    },
    /// A number is finite but outside its range.
    #[error("{what} is {value}, but must be {range}")]
    OutOfRange {
        /// Name of the number, in words.
        what: String,
        /// Its value.
        value: f64,
        /// The range, in words.
        range: &'static str,
    },
    /// Two lists that belong together differ in length.
    #[error("{what} has {count} entries, but {expected} expected")]
    BadCount {
        /// Name of the list, in words.
        what: String,
        /// Number of its entries.
        count: usize,
        /// Number of entries expected, in words.
        expected: String,
    },
    /// The index of a body that was never added or has been removed.
    #[error("there is no body {index}; {count} bodies were added, numbered from 0 in that order")]
    NoBody {
        /// The number.
        index: usize,
        /// Number of bodies added so far.
        count: usize,
    },
    /// The loudness of the samples could not be measured.
    #[error("the loudness of the samples cannot be measured: {0}")]
    Loudness(String),
    /// The samples could not be written as a WAV file.
    #[error("the samples cannot be written as WAV: {0}")]
    Wav(String),
}

/// Refuses a number that is not finite.
pub(crate) fn finite(what: impl Fn() -> String, value: f64) -> Result<f64, SoundError> {
    if value.is_finite() {
        return Ok(value);
    }
    Err(SoundError::NotFinite {
        what: what(),
        value,
    })
}

/// Refuses a pressure of full scale, Pa, that is not finite or not above zero.
pub(crate) fn checked_full_scale(pressure: f64) -> Result<f64, SoundError> {
    within(
        || "the pressure of full scale".into(),
        pressure,
        pressure > 0.0,
        "above zero, in Pa",
    )
}

/// Refuses a number that is not finite or for which the condition does not hold.
pub(crate) fn within(
    what: impl Fn() -> String,
    value: f64,
    holds: bool,
    range: &'static str,
) -> Result<f64, SoundError> {
    finite(&what, value)?;
    if holds {
        return Ok(value);
    }
    Err(SoundError::OutOfRange {
        what: what(),
        value,
        range,
    })
}
