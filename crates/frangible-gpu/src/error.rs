//! Errors of the GPU path: each names the problem and its remedy.

use frangible::InputError;
use thiserror::Error;

/// Errors of the GPU.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum GpuError {
    /// No adapter, in hardware or in software.
    #[error(
        "no graphics adapter was found; install a Vulkan driver (on Linux `mesa-vulkan-drivers` has one in software), or choose the CPU"
    )]
    NoAdapter,
    /// An adapter that is too small.
    #[error(
        "the graphics adapter `{adapter}` cannot be used: {problem}; update its driver, or choose the CPU"
    )]
    Adapter {
        /// Its name.
        adapter: String,
        /// The missing capability.
        problem: String,
    },
    /// Something that does not fit one buffer.
    #[error(
        "{what} of `{asset}` needs {bytes} bytes and a buffer holds {limit}; bake with fewer modes or a coarser mesh, or choose the CPU"
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
    /// A body that is not of the kind that was loaded for it.
    #[error(
        "impact {0} has a body of another asset than the one loaded for it; load its own Breakable"
    )]
    WrongBody(usize),
    /// A kind of body that was loaded by another [`Solver`](crate::Solver), or without a GPU.
    #[error(
        "impact {0} has a kind that was not loaded onto this GPU; load it with the Gpu or Solver that computes"
    )]
    NotLoaded(usize),
    /// Memory, the driver or the device failed.
    #[error("the GPU failed: {0}; try smaller batches, or choose the CPU")]
    Device(String),
    /// A contact that cannot be used.
    #[error("impact {impact}: {error}")]
    Input {
        /// Its number in the batch, from 0.
        impact: usize,
        /// The error in it.
        error: InputError,
    },
}
