//! Errors of export.

use frangible_recording::RecordingError;
use thiserror::Error;

/// Error of an export.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ExportError {
    /// The recording is invalid.
    #[error("the recording cannot be exported: {0}")]
    Recording(#[from] RecordingError),
    /// A GLB file holds at most 4 GiB, as its lengths are 32 bits wide.
    #[error(
        "the file would take {bytes} bytes, but a GLB file holds at most 4294967295; record fewer frames or export fewer pieces"
    )]
    TooLarge {
        /// The size it would have.
        bytes: usize,
    },
    /// The JSON part could not be written.
    #[error("the glTF description could not be written: {0}; please report this as a bug")]
    Json(#[from] serde_json::Error),
    /// The mesh and its fields are inconsistent.
    #[error("the mesh cannot be exported: {0}; check the mesh and its fields")]
    Grid(String),
}
