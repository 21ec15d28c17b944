//! The cases to verify, in the order of the report.

use frangible_bake::BakeError;

use crate::plot::Chart;
use crate::verify::cases;
use crate::verify::check::Check;
use crate::verify::{VerifyError, png};

/// Something with a known answer.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// Short name, one word.
    pub name: &'static str,
    /// Heading of its part of the report.
    pub title: &'static str,
    /// Description of the computation, and the sources of its references, Markdown.
    pub about: &'static str,
    pub(crate) compute: Compute,
}

/// Computes a case; the callback receives the share done, 0..=1.
pub(crate) type Compute = fn(&mut dyn FnMut(f64)) -> Result<Findings, BakeError>;

/// Results of a case.
#[derive(Clone, Debug, Default)]
pub struct Findings {
    /// Comparisons, in the order of the report.
    pub checks: Vec<Check>,
    /// Pictures that belong to them.
    pub plots: Vec<Plot>,
}

impl From<Vec<Check>> for Findings {
    fn from(checks: Vec<Check>) -> Self {
        Self {
            checks,
            plots: Vec::new(),
        }
    }
}

/// A chart with a name and a caption.
#[derive(Clone, Debug)]
pub struct Plot {
    /// Name of its file without the ending.
    pub name: &'static str,
    /// Caption, Markdown.
    pub caption: String,
    /// The chart itself.
    pub chart: Chart,
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
    /// [`VerifyError::Bake`] when the code under test refuses to compute it at all.
    pub fn run(&self, progress: &mut dyn FnMut(f64)) -> Result<Findings, VerifyError> {
        (self.compute)(progress).map_err(|source| VerifyError::Bake {
            case: self.name,
            source,
        })
    }
}

impl Plot {
    /// The chart as a PNG file.
    ///
    /// # Errors
    /// [`VerifyError::Plot`] with the encoder's error.
    pub fn png(&self, width: u32, height: u32) -> Result<Vec<u8>, VerifyError> {
        png(self.name, &self.chart.draw(width, height))
    }
}
