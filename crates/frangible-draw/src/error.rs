//! Errors of drawing.

use frangible_photo::PhotoError;
use thiserror::Error;

/// Error of drawing a picture.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum DrawError {
    /// No graphics adapter found.
    #[cfg_attr(
        target_family = "wasm",
        error(
            "the browser offers neither WebGPU nor WebGL 2; use a browser with one of them, or turn on hardware acceleration"
        )
    )]
    #[cfg_attr(
        not(target_family = "wasm"),
        error(
            "no graphics adapter found; install a Vulkan driver, for example `apt-get install mesa-vulkan-drivers`, which needs neither a graphics card nor a display"
        )
    )]
    NoAdapter,
    /// An error shared with path-traced pictures.
    #[error(transparent)]
    Photo(#[from] PhotoError),
    /// A coloured shape whose lists do not match.
    #[error("shape {number} of the sheet cannot be drawn: {problem}")]
    BadField {
        /// Number of the shape, from 1.
        number: usize,
        /// The problem.
        problem: &'static str,
    },
    /// The renderer's thread panicked.
    #[error(
        "the renderer failed, often because the graphics driver ran out of memory; see the error output and try a smaller picture"
    )]
    Renderer,
}
