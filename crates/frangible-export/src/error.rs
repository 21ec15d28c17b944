//! What can be wrong with a recording, or go wrong while writing it.

use std::path::PathBuf;

use thiserror::Error;

/// Why a recording cannot be written or drawn; each message says how to mend it.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum RecordingError {
    /// There is no frame.
    #[error("the recording has no frame; record at least one")]
    NoFrame,
    /// A number is NaN or infinite.
    #[error("{what} is {value}, not a finite number; check the simulation step that produced it")]
    NotFinite {
        /// Which number, in words.
        what: String,
        /// Its value.
        value: f64,
    },
    /// A number is finite but outside its range.
    #[error("{what} is {value}, but must be {range}")]
    OutOfRange {
        /// Which number, in words.
        what: String,
        /// Its value.
        value: f64,
        /// The range, in words.
        range: &'static str,
    },
    /// An index points past the end of its list.
    #[error("{what} is {index}, but there are only {count}; indices start at 0")]
    BadIndex {
        /// Which index, in words.
        what: String,
        /// Its value.
        index: usize,
        /// How many entries the list has.
        count: usize,
    },
    /// Two lists that belong together differ in length.
    #[error("{what} has {count} entries, but {expected} expected")]
    BadCount {
        /// Which list, in words.
        what: String,
        /// How many entries it has.
        count: usize,
        /// How many it should have, in words.
        expected: String,
    },
    /// The camera looks nowhere.
    #[error(
        "the camera's eye and target coincide or its up direction is along the view; move the eye or change up"
    )]
    BadView,
}

/// Why an export failed.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ExportError {
    /// The recording is not sound.
    #[error("the recording cannot be exported: {0}")]
    Recording(#[from] RecordingError),
    /// A GLB file holds at most 4 GiB, as its lengths are 32 bits wide.
    #[error(
        "the file would take {bytes} bytes, but GLB ends at 4294967295; record fewer frames or export fewer shards"
    )]
    TooLarge {
        /// The size it would have.
        bytes: usize,
    },
    /// The JSON part could not be written.
    #[error("the glTF description could not be written: {0}; please report this as a bug")]
    Json(#[from] serde_json::Error),
    /// A mesh with its fields does not fit together.
    #[error("the mesh cannot be exported: {0}; check the mesh and its fields")]
    Grid(String),
    /// The file system refused.
    #[error("cannot write {}: {source}; check that the folder exists, is writable and has room", path.display())]
    Write {
        /// The file that was to be written.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
}
