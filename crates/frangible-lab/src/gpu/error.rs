//! Errors of the GPU path. Each message says what is wrong and how to fix it.

use frangible::InputError;
use thiserror::Error;

/// Errors of the GPU.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum GpuError {
    /// No graphics adapter, neither hardware nor software.
    #[error(
        "no graphics adapter was found; install a Vulkan driver (on Linux `mesa-vulkan-drivers` has one in software)"
    )]
    NoAdapter,
    /// An adapter that lacks a required capability.
    #[error("the graphics adapter `{adapter}` cannot be used: {problem}; update its driver")]
    Adapter {
        /// Its name.
        adapter: String,
        /// The missing capability.
        problem: String,
    },
    /// Data that does not fit into one GPU buffer.
    #[error(
        "{what} of `{asset}` needs {bytes} bytes, but a GPU buffer holds at most {limit}; bake with fewer modes or a coarser mesh"
    )]
    TooLarge {
        /// The thing that does not fit.
        what: &'static str,
        /// The asset's name.
        asset: String,
        /// Its size.
        bytes: u64,
        /// The largest size.
        limit: u64,
    },
    /// A body that does not belong to the asset that was loaded for it.
    #[error(
        "impact {0} pairs a body with the data of another asset; load the Breakable of that body"
    )]
    WrongBody(usize),
    /// A kind of body that was loaded onto another [`Gpu`](super::Gpu).
    #[error(
        "impact {0} uses a Breakable that was not loaded onto this GPU; load it with the Gpu that computes the impact"
    )]
    NotLoaded(usize),
    /// Memory, the driver or the device failed.
    #[error("the GPU failed: {0}; try smaller batches")]
    Device(String),
    /// An invalid contact.
    #[error("impact {impact}: {error}")]
    Input {
        /// Its number in the batch, from 0.
        impact: usize,
        /// The error in it.
        error: InputError,
    },
}
