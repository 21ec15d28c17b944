//! Errors of invalid recordings and of writing files.

use std::path::PathBuf;

use thiserror::Error;

/// Error of an invalid recording. Each message says how to fix it.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum RecordingError {
    /// There is no frame.
    #[error("the recording has no frame; record at least one")]
    NoFrame,
    /// A number is NaN or infinite.
    #[error("{what} is {value}, not a finite number; check the simulation step that produced it")]
    NotFinite {
        /// Name of the number.
        what: String,
        /// Its value.
        value: f64,
    },
    /// A number is finite but outside its range.
    #[error("{what} is {value}, but must be {range}")]
    OutOfRange {
        /// Name of the number.
        what: String,
        /// Its value.
        value: f64,
        /// The range, in words.
        range: &'static str,
    },
    /// An index points past the end of its list.
    #[error("{what} is {index}, but there are only {count}; indices start at 0")]
    BadIndex {
        /// Name of the index.
        what: String,
        /// Its value.
        index: usize,
        /// Number of entries in the list.
        count: usize,
    },
    /// Two lists that belong together differ in length.
    #[error("{what} has {count} entries, but {expected} expected")]
    BadCount {
        /// Name of the list.
        what: String,
        /// Number of its entries.
        count: usize,
        /// Expected number, in words.
        expected: String,
    },
    /// The camera looks nowhere.
    #[error(
        "the camera's eye and target coincide or its up direction is along the view; move the eye or change up"
    )]
    BadView,
}

/// The file cannot be written.
#[derive(Debug, Error)]
#[error("cannot write {}: {source}; check that the folder exists, is writable and has room", path.display())]
pub struct WriteError {
    /// The file that was to be written.
    pub path: PathBuf,
    /// The system's error.
    pub source: std::io::Error,
}
