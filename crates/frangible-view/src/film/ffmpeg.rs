//! MP4 by `ffmpeg`, if it is there.

use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};

use frangible_draw::RgbImage;

use crate::error::ViewError;

/// `ffmpeg` at work on a file beside the one wanted; ended, and the file removed, when it is dropped unfinished.
pub(super) struct Ffmpeg {
    child: Child,
    pictures: Option<ChildStdin>,
    part: PathBuf,
    path: PathBuf,
}

impl Ffmpeg {
    pub(super) fn start(
        path: &Path,
        [width, height]: [u32; 2],
        rate: f64,
    ) -> Result<Self, ViewError> {
        let part = path.with_extension("part.mp4");
        let mut child = Command::new("ffmpeg")
            .args(["-y", "-loglevel", "error", "-f", "rawvideo"])
            .args(["-pixel_format", "rgb24", "-video_size"])
            .arg(format!("{width}x{height}"))
            .args(["-framerate", &rate.to_string(), "-i", "-"])
            // Players want even sizes and this order of colours.
            .args(["-vf", "crop=trunc(iw/2)*2:trunc(ih/2)*2"])
            .args(["-pix_fmt", "yuv420p", "-movflags", "+faststart"])
            .arg(&part)
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .map_err(|error| match error.kind() {
                std::io::ErrorKind::NotFound => ViewError::NotNow(
                    "an MP4 takes the program `ffmpeg`, which is not there; install it (Debian: apt-get install ffmpeg, macOS: brew install ffmpeg), or save a GIF or single pictures (`save gif`, `save frames`)".into(),
                ),
                _ => failed(path, error),
            })?;
        Ok(Self {
            pictures: child.stdin.take(),
            child,
            part,
            path: path.to_path_buf(),
        })
    }

    pub(super) fn give(&mut self, picture: &RgbImage) -> Result<(), ViewError> {
        let given = match &mut self.pictures {
            Some(pictures) => pictures.write_all(picture.as_raw()),
            None => Ok(()),
        };
        match given {
            Ok(()) => Ok(()),
            // It has ended, and says why.
            Err(_) => self.close(),
        }
    }

    pub(super) fn finish(mut self) -> Result<(), ViewError> {
        self.close()?;
        std::fs::rename(&self.part, &self.path).map_err(|error| failed(&self.path, error))
    }

    /// Waits for its end.
    fn close(&mut self) -> Result<(), ViewError> {
        self.pictures = None;
        let mut said = String::new();
        if let Some(mut errors) = self.child.stderr.take() {
            let _ = errors.read_to_string(&mut said);
        }
        let status = self.child.wait().map_err(|e| failed(&self.path, e))?;
        if status.success() {
            return Ok(());
        }
        let said = format!("ffmpeg ended with {status}: {}", said.trim());
        Err(failed(&self.path, std::io::Error::other(said)))
    }
}

impl Drop for Ffmpeg {
    fn drop(&mut self) {
        self.pictures = None;
        // All of this is in vain where it has finished.
        let _ = self.child.kill();
        let _ = self.child.wait();
        let _ = std::fs::remove_file(&self.part);
    }
}

fn failed(path: &Path, source: std::io::Error) -> ViewError {
    ViewError::File {
        path: path.to_path_buf(),
        doing: "written",
        source,
    }
}
