//! The cases to verify, in the order of the report.

use frangible_bake::BakeError;

use serde::Serialize;

use crate::Result;
use crate::verify::cases::CASES;
use crate::verify::check::Check;

/// Something with a known answer.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// Short name, one word.
    pub name: &'static str,
    /// Heading of its part of the report.
    pub title: &'static str,
    compute: Compute,
}

/// Computes a case.
pub(crate) type Compute = fn() -> std::result::Result<Findings, BakeError>;

/// Results of a case.
#[derive(Clone, Debug, Default)]
pub struct Findings {
    /// Comparisons, in the order of the report.
    pub checks: Vec<Check>,
    /// Curves that belong to them.
    pub curves: Vec<Curve>,
}

impl From<Vec<Check>> for Findings {
    fn from(checks: Vec<Check>) -> Self {
        Self {
            checks,
            curves: Vec::new(),
        }
    }
}

/// Points of a chart.
#[derive(Clone, Debug, Serialize)]
pub struct Curve {
    /// Name of the curve.
    pub name: &'static str,
    /// Its points.
    pub points: Vec<[f64; 2]>,
}

/// The case of this name.
#[must_use]
pub fn case(name: &str) -> Option<&'static Case> {
    CASES.iter().find(|case| case.name == name)
}

impl Case {
    pub(crate) const fn new(name: &'static str, title: &'static str, compute: Compute) -> Self {
        Self {
            name,
            title,
            compute,
        }
    }

    /// Computes it.
    ///
    /// # Errors
    /// An error of the code under test.
    pub fn run(&self) -> Result<Findings> {
        let found = (self.compute)();
        Ok(found.map_err(|e| format!("the case `{}` could not be computed: {e}", self.name))?)
    }
}
