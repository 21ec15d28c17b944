//! Validation of the physics: cases with known answers, run by `frangible-lab verify` and by the tests.
//!
//! A [`Case`] computes a quantity with the production code and compares it with an independent reference: a closed-form solution, a published
//! number, or our own integrator or Ritz series that shares no code with it. [`CASES`] lists them all; [`report`] writes the results as text,
//! [`plot`] as pictures. [`experiments`] compares cracks and pieces with published experiments, which takes minutes; [`pieces`] compares methods
//! for the vibration modes of fragments.

mod blows;
mod case;
mod cases;
mod check;
pub mod experiments;
mod models;
pub mod near_field;
mod ode;
pub mod pieces;
pub mod report;
mod ritz;

pub use case::{CASES, Case, Findings, Plot, case};
pub use check::Check;
pub use ritz::{box_frequencies, first_box_frequency};

use frangible::InputError;
use frangible::internals::UnknownMaterial;
use frangible_bake::BakeError;
use image::RgbImage;
use thiserror::Error;

use crate::plot;

/// Error of computing a report.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum VerifyError {
    /// The bake or the fracture model rejected the input of a case.
    #[error("the case `{case}` could not be computed: {source}")]
    Bake {
        /// Name of the case.
        case: &'static str,
        /// Error of the bake.
        source: BakeError,
    },
    /// A material of an experiment is missing.
    #[error("the material `{name}` is missing: {source}")]
    Material {
        /// Name of the preset.
        name: &'static str,
        /// Error of the material.
        source: UnknownMaterial,
    },
    /// The fracture model rejected the input of an experiment.
    #[error("the experiment `{case}` could not be computed: {source}")]
    Impact {
        /// Name of the experiment.
        case: &'static str,
        /// Error of the fracture code.
        source: InputError,
    },
    /// The methods for the modes of pieces could not be compared.
    #[error("the pieces could not be compared: {reason}")]
    Pieces {
        /// Reason of the failure.
        reason: String,
    },
    /// A chart could not be drawn or written as PNG.
    #[error("the plot `{name}` could not be made: {reason}")]
    Plot {
        /// Name of the plot.
        name: String,
        /// Reason of the failure.
        reason: String,
    },
}

/// A plot as a PNG file.
pub(crate) fn png(name: &str, picture: &RgbImage) -> Result<Vec<u8>, VerifyError> {
    plot::png(picture).map_err(|error| VerifyError::Plot {
        name: name.into(),
        reason: error.to_string(),
    })
}
