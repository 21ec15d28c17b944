//! Films: sequences of pictures, written to a file or a folder.

use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};

use frangible_recording::write_atomically;
use gif::{Encoder, Frame, Repeat};

use crate::ffmpeg::Ffmpeg;
#[cfg(feature = "webp")]
use crate::webp::{WEBP_QUALITY, WebP};
use crate::{PhotoError, Picture, encode_png_within};

/// Speed of the GIF encoder, from 1, the best colours, to 30, the fastest.
const GIF_SPEED: i32 = 10;

/// File format of a film.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FilmFormat {
    /// GIF, supported everywhere.
    Gif,
    /// Animated WebP, supported by browsers: smaller than a GIF, with full colour. Requires the feature `webp`.
    WebP,
    /// MP4. Requires the program `ffmpeg`.
    Mp4,
    /// Folder of pictures, `frame-0001.png` and so on.
    Frames,
}

impl FilmFormat {
    /// Returns the format for a file name: `.gif`, `.webp`, `.mp4`, or a folder if there is no extension.
    #[must_use]
    pub fn of(path: &Path) -> Option<Self> {
        match path.extension() {
            None => Some(Self::Frames),
            Some(end) if end.eq_ignore_ascii_case("gif") => Some(Self::Gif),
            Some(end) if end.eq_ignore_ascii_case("webp") => Some(Self::WebP),
            Some(end) if end.eq_ignore_ascii_case("mp4") => Some(Self::Mp4),
            Some(_) => None,
        }
    }
}

/// Writer of a film. [`FilmWriter::finish`] gives the file its final name; if it is dropped before, no file remains, except separate pictures.
pub struct FilmWriter {
    path: PathBuf,
    pictures: u32,
    /// Pictures per second.
    #[cfg(feature = "webp")]
    rate: f64,
    /// A WAV.
    sound: Option<Vec<u8>>,
    to: To,
}

enum To {
    Gif(Gif),
    #[cfg(feature = "webp")]
    WebP(Box<WebP>),
    Mp4(Ffmpeg),
    Frames,
}

impl FilmWriter {
    /// Starts a film with pictures of this size, `[width, height]` in pixels, and this frame rate, 1/s. Creates missing parent folders.
    ///
    /// # Errors
    /// [`PhotoError::File`] if it cannot be written, [`PhotoError::NoFfmpeg`] for an MP4 without ffmpeg, [`PhotoError::NoWebP`] in a build
    /// without WebP, [`PhotoError::BadSize`] for an invalid size of a GIF.
    pub fn begin(
        path: &Path,
        format: FilmFormat,
        size: [u32; 2],
        rate: f64,
    ) -> Result<Self, PhotoError> {
        let folder = match format {
            FilmFormat::Frames => Some(path),
            _ => path
                .parent()
                .filter(|folder| !folder.as_os_str().is_empty()),
        };
        if let Some(folder) = folder {
            std::fs::create_dir_all(folder).map_err(|source| PhotoError::File {
                path: folder.to_path_buf(),
                doing: "made",
                source,
            })?;
        }
        Ok(Self {
            path: path.to_path_buf(),
            pictures: 0,
            #[cfg(feature = "webp")]
            rate,
            sound: None,
            to: match format {
                FilmFormat::Gif => To::Gif(Gif::begin(path, size, rate)?),
                #[cfg(feature = "webp")]
                FilmFormat::WebP => To::WebP(Box::new(WebP::begin(path, size, WEBP_QUALITY)?)),
                #[cfg(not(feature = "webp"))]
                FilmFormat::WebP => return Err(PhotoError::NoWebP),
                FilmFormat::Mp4 => To::Mp4(Ffmpeg::start(path, size, rate)?),
                FilmFormat::Frames => To::Frames,
            },
        })
    }

    /// Sets the quality of WebP pictures, 1 to 100, default 75. Call it before adding the first picture.
    ///
    /// # Errors
    /// [`PhotoError::File`] if the encoder rejects it.
    #[cfg(feature = "webp")]
    pub fn set_quality(&mut self, size: [u32; 2], quality: f32) -> Result<(), PhotoError> {
        if let To::WebP(webp) = &mut self.to {
            **webp = WebP::begin(&self.path, size, quality)?;
        }
        Ok(())
    }

    /// Adds sound, the bytes of a WAV: as a track of an MP4, or for other formats as a separate file, `glass-film.wav` for `glass.gif`.
    pub fn set_sound(&mut self, wav: Vec<u8>) {
        self.sound = Some(wav);
    }

    /// Adds a picture.
    ///
    /// # Errors
    /// [`PhotoError::File`] if it cannot be written.
    pub fn add(&mut self, picture: &Picture) -> Result<(), PhotoError> {
        self.pictures += 1;
        match &mut self.to {
            To::Gif(gif) => gif.add(picture, &self.path),
            #[cfg(feature = "webp")]
            To::WebP(webp) => {
                let time = f64::from(self.pictures - 1) / self.rate;
                webp.add(picture, time, &self.path)
            }
            To::Mp4(ffmpeg) => ffmpeg.give(picture),
            To::Frames => {
                let name = format!("frame-{:04}.png", self.pictures);
                Ok(write_atomically(
                    &self.path.join(name),
                    &encode_png_within(picture, usize::MAX)?,
                )?)
            }
        }
    }

    /// Finishes the film and gives it its final name. A film without pictures leaves no file.
    ///
    /// # Errors
    /// [`PhotoError::File`] if it cannot be written.
    pub fn finish(self) -> Result<(), PhotoError> {
        if self.pictures == 0 {
            return Ok(());
        }
        match self.to {
            To::Gif(gif) => gif.finish(&self.path)?,
            #[cfg(feature = "webp")]
            To::WebP(webp) => webp.finish(f64::from(self.pictures) / self.rate, &self.path)?,
            To::Mp4(ffmpeg) => return ffmpeg.finish(self.sound.as_deref()),
            To::Frames => {}
        }
        match self.sound {
            Some(sound) => Ok(write_atomically(&sound_beside(&self.path), &sound)?),
            None => Ok(()),
        }
    }
}

/// Path of a film's sound: in the folder of its pictures, or beside its file under a name that differs from that of a break's sound.
fn sound_beside(film: &Path) -> PathBuf {
    let (Some(_), Some(stem)) = (film.extension(), film.file_stem()) else {
        return film.join("sound.wav");
    };
    let mut name = stem.to_os_string();
    name.push("-film.wav");
    film.with_file_name(name)
}

/// A GIF in a file beside the one wanted, removed when it is dropped unfinished.
struct Gif {
    encoder: Option<Encoder<BufWriter<File>>>,
    /// Width and height, pixels.
    size: [u16; 2],
    /// Time that each picture is seen, hundredths of a second.
    delay: u16,
    part: PathBuf,
}

impl Gif {
    fn begin(path: &Path, [width, height]: [u32; 2], rate: f64) -> Result<Self, PhotoError> {
        let too_large = |_| PhotoError::BadSize {
            width,
            height,
            limit: u16::MAX.into(),
        };
        let size = [
            u16::try_from(width).map_err(too_large)?,
            u16::try_from(height).map_err(too_large)?,
        ];
        let part = part_of(path);
        let file = File::create(&part).map_err(|error| unwritten(path, error))?;
        let mut gif = Self {
            encoder: None,
            size,
            delay: (1e2 / rate).round() as u16,
            part,
        };
        let failed = |error| unwritten(path, std::io::Error::other(error));
        let mut encoder =
            Encoder::new(BufWriter::new(file), size[0], size[1], &[]).map_err(failed)?;
        encoder.set_repeat(Repeat::Infinite).map_err(failed)?;
        gif.encoder = Some(encoder);
        Ok(gif)
    }

    fn add(&mut self, picture: &Picture, path: &Path) -> Result<(), PhotoError> {
        let [width, height] = self.size;
        let mut frame = Frame::from_rgb_speed(width, height, picture.bytes(), GIF_SPEED);
        frame.delay = self.delay;
        match &mut self.encoder {
            Some(encoder) => (encoder.write_frame(&frame))
                .map_err(|error| unwritten(path, std::io::Error::other(error))),
            None => Ok(()),
        }
    }

    fn finish(mut self, path: &Path) -> Result<(), PhotoError> {
        // Its end is written when the encoder goes.
        self.encoder = None;
        std::fs::rename(&self.part, path).map_err(|error| unwritten(path, error))
    }
}

impl Drop for Gif {
    fn drop(&mut self) {
        self.encoder = None;
        // In vain where it is finished.
        let _ = std::fs::remove_file(&self.part);
    }
}

/// The file in which a film grows: beside the one wanted, with the same ending.
pub(crate) fn part_of(path: &Path) -> PathBuf {
    let mut end = std::ffi::OsString::from("part.");
    end.push(path.extension().unwrap_or_default());
    path.with_extension(end)
}

pub(crate) fn unwritten(path: &Path, source: std::io::Error) -> PhotoError {
    PhotoError::File {
        path: path.to_path_buf(),
        doing: "written",
        source,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_film_has_its_name_when_it_is_finished_and_not_before() {
        let folder = std::env::temp_dir().join(format!("frangible-film-{}", std::process::id()));
        let path = folder.join("deep/film.gif");
        let begin = || FilmWriter::begin(&path, FilmFormat::Gif, [16, 16], 20.0).unwrap();
        let mut film = begin();
        film.add(&Picture::filled(16, 16, [0; 3])).unwrap();
        drop(film);
        assert_eq!(
            std::fs::read_dir(path.parent().unwrap()).unwrap().count(),
            0
        );
        let mut film = begin();
        for shade in [0, 90, 250] {
            film.add(&Picture::filled(16, 16, [shade; 3])).unwrap();
        }
        assert!(!path.exists());
        film.finish().unwrap();
        let bytes = std::fs::read(&path).unwrap();
        // Each picture begins with its own control block.
        let pictures = bytes
            .windows(3)
            .filter(|w| *w == [0x21, 0xF9, 0x04])
            .count();
        assert_eq!((&bytes[..6], pictures), (&b"GIF89a"[..], 3));
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[cfg(feature = "webp")]
    #[test]
    fn a_webp_has_its_pictures_and_a_sound_beside_it() {
        let folder = std::env::temp_dir().join(format!("frangible-webp-{}", std::process::id()));
        let path = folder.join("film.webp");
        let mut film = FilmWriter::begin(&path, FilmFormat::WebP, [32, 24], 20.0).unwrap();
        film.set_sound(b"RIFF".to_vec());
        for shade in [0, 90, 250] {
            film.add(&Picture::filled(32, 24, [shade, 40, 90])).unwrap();
        }
        assert!(!path.exists());
        film.finish().unwrap();
        let bytes = std::fs::read(&path).unwrap();
        let pictures = bytes.windows(4).filter(|w| *w == b"ANMF").count();
        assert_eq!(
            (&bytes[..4], &bytes[8..12], pictures),
            (&b"RIFF"[..], &b"WEBP"[..], 3)
        );
        assert_eq!(
            std::fs::read(folder.join("film-film.wav")).unwrap(),
            b"RIFF"
        );
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn the_name_says_the_format() {
        let of = |name: &str| FilmFormat::of(Path::new(name));
        assert_eq!(of("a.GIF"), Some(FilmFormat::Gif));
        assert_eq!(of("b/c.mp4"), Some(FilmFormat::Mp4));
        assert_eq!(of("c.webp"), Some(FilmFormat::WebP));
        assert_eq!(of("frames"), Some(FilmFormat::Frames));
        assert_eq!(of("a.avi"), None);
    }
}
