//! MP4 by `ffmpeg`, if it is there.

use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};

use image::RgbImage;

use crate::DrawError;
use crate::film::{part_of, unwritten};

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
    ) -> Result<Self, DrawError> {
        let part = part_of(path);
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
                std::io::ErrorKind::NotFound => DrawError::NoFfmpeg,
                _ => unwritten(path, error),
            })?;
        Ok(Self {
            pictures: child.stdin.take(),
            child,
            part,
            path: path.to_path_buf(),
        })
    }

    pub(super) fn give(&mut self, picture: &RgbImage) -> Result<(), DrawError> {
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

    pub(super) fn finish(mut self) -> Result<(), DrawError> {
        self.close()?;
        std::fs::rename(&self.part, &self.path).map_err(|error| unwritten(&self.path, error))
    }

    /// Waits for its end.
    fn close(&mut self) -> Result<(), DrawError> {
        self.pictures = None;
        let mut said = String::new();
        if let Some(mut errors) = self.child.stderr.take() {
            let _ = errors.read_to_string(&mut said);
        }
        let status = self.child.wait().map_err(|e| unwritten(&self.path, e))?;
        if status.success() {
            return Ok(());
        }
        let said = format!("ffmpeg ended with {status}: {}", said.trim());
        Err(unwritten(&self.path, std::io::Error::other(said)))
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
