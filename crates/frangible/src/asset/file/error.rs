//! Errors of reading and writing asset files.

use std::path::PathBuf;

use thiserror::Error;

use crate::error::InputError;

/// Error of reading a file, or bytes, as an asset, or of writing an asset.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum AssetFileError {
    /// The first bytes are not those of an asset.
    #[error(
        "it is not a baked asset but looks like {looks_like}; bake the mesh and load the resulting file"
    )]
    NotAnAsset {
        /// Kind of file that the bytes look like.
        looks_like: &'static str,
    },
    /// Written by another version of the format.
    #[error(
        "it was baked by another version of Frangible (its format version is {found}, but this build reads version {supported}); bake it again: frangible bake FILE --output NAME.frangible"
    )]
    Version {
        /// Version of the file.
        found: u32,
        /// Version that this build reads.
        supported: u32,
    },
    /// The end is missing.
    #[error("it ends after {found} of {expected} bytes; copy it again, or bake it again")]
    Truncated {
        /// Length that the header states, bytes.
        expected: u64,
        /// Length found, bytes.
        found: u64,
    },
    /// Something follows the end.
    #[error(
        "it has {found} bytes, but its header states {expected}; copy it again, or bake it again"
    )]
    TooLong {
        /// Length that the header states, bytes.
        expected: u64,
        /// Length found, bytes.
        found: u64,
    },
    /// Some byte has changed since it was written.
    #[error(
        "it is damaged: its checksum does not match its content; copy it again, or bake it again"
    )]
    Checksum,
    /// A section cannot be used.
    #[error("its section `{name}` {problem}; bake it again")]
    Section {
        /// Name of the section in `docs/asset-format.md`, or its number where it has none.
        name: String,
        /// Problem, as the rest of a sentence.
        problem: String,
    },
    /// The arrays do not fit together, or hold unusable numbers.
    #[error(transparent)]
    Input(#[from] InputError),
    /// The operating system refused.
    #[error("`{}`: {problem}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// Message of the operating system.
        problem: String,
    },
    /// The file was read, and its content is at fault.
    #[error("`{}`: {problem}", path.display())]
    InFile {
        /// The file.
        path: PathBuf,
        /// Problem with its content.
        problem: Box<AssetFileError>,
    },
}

impl AssetFileError {
    pub(super) fn section(name: impl Into<String>, problem: impl Into<String>) -> Self {
        Self::Section {
            name: name.into(),
            problem: problem.into(),
        }
    }
}
