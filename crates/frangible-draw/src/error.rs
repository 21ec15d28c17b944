//! Errors of drawing.

use frangible_photo::PhotoError;
use thiserror::Error;

/// Error that keeps a picture from being drawn.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum DrawError {
    /// No graphics driver answered.
    #[cfg_attr(
        target_family = "wasm",
        error("the browser gives neither WebGPU nor WebGL 2 to draw with")
    )]
    #[cfg_attr(
        not(target_family = "wasm"),
        error(
            "no graphics adapter found; install a Vulkan driver, for example `apt-get install mesa-vulkan-drivers`, which needs neither a graphics card nor a display"
        )
    )]
    NoAdapter,
    /// An error that traced pictures have, too.
    #[error(transparent)]
    Photo(#[from] PhotoError),
    /// A coloured shape that does not fit together.
    #[error("shape {number} of the sheet cannot be drawn: {problem}")]
    BadField {
        /// Number of the shape, from 1.
        number: usize,
        /// The problem.
        problem: &'static str,
    },
    /// The renderer's thread panicked.
    #[error(
        "the renderer failed; its message is on the error output, often a driver out of memory: try a smaller picture"
    )]
    Renderer,
}
