//! MP4 by `ffmpeg`, if it is there.

use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};

use crate::film::{part_of, unwritten};
use crate::{PhotoError, Picture};

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
    ) -> Result<Self, PhotoError> {
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
                std::io::ErrorKind::NotFound => PhotoError::NoFfmpeg,
                _ => unwritten(path, error),
            })?;
        Ok(Self {
            pictures: child.stdin.take(),
            child,
            part,
            path: path.to_path_buf(),
        })
    }

    pub(super) fn give(&mut self, picture: &Picture) -> Result<(), PhotoError> {
        let given = match &mut self.pictures {
            Some(pictures) => pictures.write_all(picture.bytes()),
            None => Ok(()),
        };
        match given {
            Ok(()) => Ok(()),
            // It has ended, and says why.
            Err(_) => self.close(),
        }
    }

    /// Ends the film, with a sound if there is one: the bytes of a WAV.
    pub(super) fn finish(mut self, sound: Option<&[u8]>) -> Result<(), PhotoError> {
        self.close()?;
        if let Some(sound) = sound {
            self.add_sound(sound)?;
        }
        std::fs::rename(&self.part, &self.path).map_err(|error| unwritten(&self.path, error))
    }

    /// Puts a sound beside the pictures, which stay as they are.
    fn add_sound(&self, sound: &[u8]) -> Result<(), PhotoError> {
        let failed = |error| unwritten(&self.path, error);
        let wav = self.part.with_extension("wav");
        let both = self.part.with_extension("sound.mp4");
        std::fs::write(&wav, sound).map_err(failed)?;
        let done = Command::new("ffmpeg")
            .args(["-y", "-loglevel", "error", "-i"])
            .arg(&self.part)
            .arg("-i")
            .arg(&wav)
            .args(["-c:v", "copy", "-c:a", "aac", "-b:a", "192k", "-shortest"])
            .args(["-movflags", "+faststart"])
            .arg(&both)
            .output();
        let _ = std::fs::remove_file(&wav);
        let done = done.map_err(failed)?;
        if !done.status.success() {
            let _ = std::fs::remove_file(&both);
            let said = String::from_utf8_lossy(&done.stderr);
            let said = format!("ffmpeg failed with {}: {}", done.status, said.trim());
            return Err(failed(std::io::Error::other(said)));
        }
        std::fs::rename(&both, &self.part).map_err(failed)
    }

    /// Waits for its end.
    fn close(&mut self) -> Result<(), PhotoError> {
        self.pictures = None;
        let mut said = String::new();
        if let Some(mut errors) = self.child.stderr.take() {
            let _ = errors.read_to_string(&mut said);
        }
        let status = self.child.wait().map_err(|e| unwritten(&self.path, e))?;
        if status.success() {
            return Ok(());
        }
        let said = format!("ffmpeg failed with {status}: {}", said.trim());
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
