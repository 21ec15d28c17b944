//! The cases to verify, in the order of the report.

use frangible_bake::BakeError;

use serde::Serialize;

use crate::Result;
use crate::verify::cases;
use crate::verify::check::Check;

/// Something with a known answer.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// Short name, one word.
    pub name: &'static str,
    /// Heading of its part of the report.
    pub title: &'static str,
    pub(crate) compute: Compute,
}

/// Computes a case; the callback receives the share done, 0..=1.
pub(crate) type Compute = fn(&mut dyn FnMut(f64)) -> std::result::Result<Findings, BakeError>;

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

/// All cases.
pub const CASES: &[Case] = &[
    cases::bar::CASE,
    cases::plate::CASE,
    cases::block::CASE,
    cases::ball::CASE,
    cases::cantilever::CASE,
    cases::convergence::CASE,
    cases::basis::CASE,
    cases::scaling::CASE,
    cases::oscillator::CASE,
    cases::contact::CASE,
    cases::near_field::CASE,
    cases::blow::CASE,
    cases::two_bodies::CASE,
];

/// The case of this name.
#[must_use]
pub fn case(name: &str) -> Option<&'static Case> {
    CASES.iter().find(|case| case.name == name)
}

impl Case {
    /// Computes it; `progress` receives the share done, 0..=1.
    ///
    /// # Errors
    /// An error of the code under test.
    pub fn run(&self, progress: &mut dyn FnMut(f64)) -> Result<Findings> {
        let found = (self.compute)(progress);
        Ok(found.map_err(|e| format!("the case `{}` could not be computed: {e}", self.name))?)
    }
}
