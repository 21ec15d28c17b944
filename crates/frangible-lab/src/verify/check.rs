//! One comparison with a reference.

use serde::Serialize;
use serde_json::{Value, json};

/// A computed value and its reference.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Check {
    /// Name of the quantity, unique within its case.
    pub name: String,
    /// Reference value, in `unit`; 0 makes the error absolute.
    pub reference: f64,
    /// Computed value, in `unit`.
    pub value: f64,
    /// Largest error that passes: relative to the reference, or absolute where that is 0.
    pub tolerance: f64,
    /// Unit of value and reference, "" for a pure number.
    pub unit: &'static str,
    /// Source of the reference.
    pub source: &'static str,
}

impl Check {
    /// Error of the value: relative to the reference, or absolute where that is 0.
    #[must_use]
    pub fn error(&self) -> f64 {
        if self.reference == 0.0 {
            self.value.abs()
        } else {
            (self.value / self.reference - 1.0).abs()
        }
    }

    /// The numbers of the check, with its error.
    #[must_use]
    pub fn data(&self) -> Value {
        let mut data = json!(self);
        data["error"] = json!(self.error());
        data
    }

    /// Returns true if the error is within the tolerance. A NaN never is.
    #[must_use]
    pub fn passes(&self) -> bool {
        self.error() <= self.tolerance
    }
}

/// A check of a computed value and its reference.
pub(crate) fn check(
    name: impl Into<String>,
    unit: &'static str,
    [value, reference]: [f64; 2],
    tolerance: f64,
    source: &'static str,
) -> Check {
    Check {
        name: name.into(),
        reference,
        value,
        tolerance,
        unit,
        source,
    }
}

/// Checks, one a line: name, unit, value and reference, tolerance, source of the reference.
macro_rules! checks {
    ($($name:expr, $unit:literal, $value:expr => $reference:expr, $tolerance:expr, $source:expr;)*) => {
        vec![$($crate::verify::check::check($name, $unit, [$value, $reference], $tolerance, $source)),*]
    };
}

pub(crate) use checks;
