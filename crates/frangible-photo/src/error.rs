//! Errors of pictures and films.

use std::path::PathBuf;

use frangible_recording::{RecordingError, WriteError};
use thiserror::Error;

/// Error that keeps a picture or a film from being made.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PhotoError {
    /// The recording or the view is invalid.
    #[error("the recording cannot be drawn: {0}")]
    Recording(#[from] RecordingError),
    /// The requested frame is beyond the end.
    #[error("frame {frame} cannot be drawn: the recording has {count}, counted from 0")]
    NoSuchFrame {
        /// The requested frame.
        frame: usize,
        /// Number of frames in the recording.
        count: usize,
    },
    /// The picture has no pixels, or more than can be drawn.
    #[error(
        "a picture of {width} × {height} pixels cannot be drawn; choose 16 to {limit} each way"
    )]
    BadSize {
        /// Requested width, pixels.
        width: u32,
        /// Requested height, pixels.
        height: u32,
        /// Largest number of pixels per side.
        limit: u32,
    },
    /// A sheet without a cell.
    #[error("the sheet has no cell; give it at least one frame and one column")]
    EmptySheet,
    /// The caller's `go_on` returned false.
    #[error("the picture was cancelled")]
    Cancelled,
    /// A file or folder that cannot be made.
    #[error("`{}` cannot be {doing}: {source}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// The attempted operation: “made” or “written”.
        doing: &'static str,
        /// Error of the system.
        source: std::io::Error,
    },
    /// A file that cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// An MP4 without the program that makes it.
    #[error(
        "writing an MP4 requires the program `ffmpeg`, which was not found; install it (Debian: apt-get install ffmpeg, macOS: brew install ffmpeg), or write a GIF or separate pictures"
    )]
    NoFfmpeg,
    /// A WebP in a build without its encoder.
    #[error(
        "this build cannot write WebP films; write a .gif or .mp4, or build with the feature `webp` (for the program `frangible`: `view`)"
    )]
    NoWebP,
    /// The picture could not be compressed.
    #[error("the picture could not be encoded as PNG: {0}")]
    Encode(#[from] png::EncodingError),
}
