//! Why there is no picture.

use frangible_export::RecordingError;
use thiserror::Error;

/// Why a picture could not be drawn.
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
    /// The recording or the view is not sound.
    #[error("the recording cannot be drawn: {0}")]
    Recording(#[from] RecordingError),
    /// A frame beyond the end was asked for.
    #[error("frame {frame} cannot be drawn: the recording has {count}, counted from 0")]
    NoSuchFrame {
        /// The frame asked for.
        frame: usize,
        /// How many frames the recording has.
        count: usize,
    },
    /// The picture has no pixels, or more than the adapter can draw.
    #[error(
        "a picture of {width} × {height} pixels cannot be drawn; choose 16 to {limit} each way"
    )]
    BadSize {
        /// Width asked for, pixels.
        width: u32,
        /// Height asked for, pixels.
        height: u32,
        /// The most pixels each way.
        limit: u32,
    },
    /// A sheet without a cell.
    #[error("the sheet has no cell; give it at least one frame and one column")]
    EmptySheet,
    /// A coloured shape that does not fit together.
    #[error("shape {number} of the sheet cannot be drawn: {problem}")]
    BadField {
        /// Which one, from 1.
        number: usize,
        /// What is wrong with it.
        problem: &'static str,
    },
    /// The renderer's thread panicked.
    #[error(
        "the renderer failed; its message is on the error output, often a driver out of memory: try a smaller picture"
    )]
    Renderer,
    /// Whoever asked for the picture does not want it any more.
    #[error("the picture was given up")]
    Cancelled,
    /// A file that cannot be written.
    #[error("`{}` cannot be {doing}: {source}", path.display())]
    File {
        /// The file.
        path: std::path::PathBuf,
        /// Made, written.
        doing: &'static str,
        /// Why not.
        source: std::io::Error,
    },
    /// A picture that cannot be written.
    #[error(transparent)]
    Export(#[from] frangible_export::ExportError),
    /// An MP4 without the program that makes it.
    #[error(
        "an MP4 takes the program `ffmpeg`, which is not there; install it (Debian: apt-get install ffmpeg, macOS: brew install ffmpeg), or make a GIF or single pictures"
    )]
    NoFfmpeg,
    /// The picture could not be compressed.
    #[error("the picture could not be encoded as PNG: {0}")]
    Encode(#[from] png::EncodingError),
}
