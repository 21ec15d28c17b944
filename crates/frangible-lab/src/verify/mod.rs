//! Is the physics right? Cases with a known answer, run by `frangible-lab verify` and by the tests alike.
//!
//! A [`Case`] computes something with the code that bakes and breaks, and compares it with a reference found by other
//! means: a closed form, a published number, an integrator or a Ritz series of our own that shares no code with it.
//! [`CASES`] lists them all; [`report`] makes text of what they found, [`plot`] pictures. [`experiments`] compares cracks
//! and pieces with published experiments, which takes minutes; [`pieces`] the ways to find how a fragment vibrates.

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

/// Error that keeps a report from being made.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum VerifyError {
    /// The bake, or the fracture code, refused the input of a case.
    #[error("the case `{case}` could not be computed: {source}")]
    Bake {
        /// Name of the case.
        case: &'static str,
        /// Error of the bake.
        source: BakeError,
    },
    /// A material that an experiment needs is not there.
    #[error("the material `{name}` is missing: {source}")]
    Material {
        /// Name of the preset.
        name: &'static str,
        /// Error of the material.
        source: UnknownMaterial,
    },
    /// The fracture code refused the input of an experiment.
    #[error("the experiment `{case}` could not be computed: {source}")]
    Impact {
        /// Name of the experiment.
        case: &'static str,
        /// Error of the fracture code.
        source: InputError,
    },
    /// The ways to find how pieces vibrate could not be compared.
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
