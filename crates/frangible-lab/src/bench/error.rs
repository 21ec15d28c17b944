//! Errors of the benchmarks.

use std::path::PathBuf;

use crate::reference::ReferenceError;
use frangible::InputError;
use frangible::internals::{AssetFileError, UnknownMaterial};
use frangible_bake::BakeError;
use frangible_rapier::WorldError;
use frangible_scenes::SceneError;
use thiserror::Error;

/// Error that keeps a measurement from being made.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum BenchError {
    /// A body that does not bake.
    #[error(transparent)]
    Bake(#[from] BakeError),
    /// A contact or a body that the run time refuses.
    #[error(transparent)]
    Input(#[from] InputError),
    /// A baked body that cannot be written or read.
    #[error(transparent)]
    File(#[from] AssetFileError),
    /// A material that is not there.
    #[error(transparent)]
    Material(#[from] UnknownMaterial),
    /// The word-for-word program does not take the body.
    #[error(transparent)]
    Reference(#[from] ReferenceError),
    /// A world that cannot be stepped.
    #[error(transparent)]
    World(#[from] WorldError),
    /// A scene that cannot be played.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A GPU that fails.
    #[error(transparent)]
    Gpu(#[from] frangible_gpu::GpuError),
    /// The folder of the baked bodies.
    #[error("`{}` cannot be used for the baked bodies: {problem}; choose another folder with --cache DIR", path.display())]
    Cache {
        /// The folder or file.
        path: PathBuf,
        /// Message of the system.
        problem: String,
    },
    /// A body that is none of Table 1's.
    #[error("there is no body `{name}`; the bodies are {known}")]
    UnknownBody {
        /// The requested name.
        name: String,
        /// Names of the bodies.
        known: String,
    },
    /// A blow that did not reach its stage.
    #[error("{0}")]
    NotAsMeant(String),
}
