//! Range errors.

use thiserror::Error;

/// A number that is out of range.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[error("{what} is {value}{}{unit}; it must be {must}", if unit.is_empty() { "" } else { " " })]
pub struct OutOfRange {
    /// The quantity.
    pub what: &'static str,
    /// The value given.
    pub value: f64,
    /// Unit of the quantity; empty if it has none.
    pub unit: &'static str,
    /// Valid range.
    pub must: &'static str,
}

impl OutOfRange {
    /// The range of a coefficient of restitution.
    pub const RESTITUTION: &'static str = "between 0 (no bounce) and 1 (full bounce)";
    /// The range of a crushing pressure.
    pub const CRUSHING_PRESSURE: &'static str = "10 kPa or more, and may be infinite";

    /// Checks a number without a unit.
    ///
    /// # Errors
    /// An error about the number, unless `fits` is true.
    pub fn unless(
        fits: bool,
        what: &'static str,
        value: f64,
        must: &'static str,
    ) -> Result<(), Self> {
        let unit = "";
        fits.then_some(()).ok_or(Self {
            what,
            value,
            unit,
            must,
        })
    }
}

/// Checks that a number is finite and above zero.
///
/// # Errors
/// A number that is not.
pub fn positive(what: &'static str, value: f64, unit: &'static str) -> Result<(), OutOfRange> {
    let must = "a finite number above zero";
    let fits = value.is_finite() && value > 0.0;
    OutOfRange::unless(fits, what, value, must).map_err(|error| OutOfRange { unit, ..error })
}

/// Checks that a number is finite, and zero or above.
///
/// # Errors
/// A number that is not.
pub fn not_negative(what: &'static str, value: f64) -> Result<(), OutOfRange> {
    let must = "a finite number, zero or above";
    OutOfRange::unless(value.is_finite() && value >= 0.0, what, value, must)
}
