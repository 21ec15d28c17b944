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

/// A check of a frequency, Hz.
pub(crate) fn hertz(
    name: impl Into<String>,
    value: f64,
    reference: f64,
    tolerance: f64,
    source: &'static str,
) -> Check {
    Check {
        unit: "Hz",
        ..number(name, value, reference, tolerance, source)
    }
}

/// A check of a pure number.
pub(crate) fn number(
    name: impl Into<String>,
    value: f64,
    reference: f64,
    tolerance: f64,
    source: &'static str,
) -> Check {
    Check {
        name: name.into(),
        reference,
        value,
        tolerance,
        unit: "",
        source,
    }
}
