//! Pictures one after the other, into a file or a folder.

use std::path::Path;
use std::sync::Arc;

use frangible_draw::{DrawError, RgbImage, Studio};
use frangible_export::write_atomically;
use image::codecs::gif::{GifEncoder, Repeat};
use image::{Delay, DynamicImage, Frame, ImageFormat};

use super::Take;
use super::ffmpeg::Ffmpeg;
use crate::command::FilmKind;
use crate::error::ViewError;
use crate::jobs::Teller;

/// From 1, the best colours, to 30, the fastest.
const GIF_SPEED: i32 = 10;

/// Makes it.
pub(super) fn shoot(take: &Take, teller: &Teller) -> Result<(), ViewError> {
    let [width, height] = take.options.size;
    let studio = Studio::new(width, height)?;
    if let Some(folder) = take.path.parent().filter(|f| !f.as_os_str().is_empty()) {
        make_folder(folder)?;
    }
    match take.kind {
        FilmKind::Still => still(take, &studio, teller),
        FilmKind::Gif => gif(take, &studio, teller),
        FilmKind::Frames => frames(take, &studio, teller),
        FilmKind::Mp4 => mp4(take, &studio, teller),
    }
}

fn make_folder(folder: &Path) -> Result<(), ViewError> {
    std::fs::create_dir_all(folder).map_err(|source| ViewError::File {
        path: folder.to_path_buf(),
        doing: "made",
        source,
    })
}

fn still(take: &Take, studio: &Studio, teller: &Teller) -> Result<(), ViewError> {
    let samples = take.options.samples;
    let own = teller.clone();
    own.tell("path-tracing".into(), 0.0);
    let go_on = Arc::new(move |done: u32| {
        let share = f64::from(done) / f64::from(samples);
        own.tell(format!("path-tracing: {done} of {samples} samples"), share);
        !own.cancel.is_cancelled()
    });
    let picture = studio.traced(&take.recording, 0, &take.view, samples, go_on)?;
    write_png(&take.path, picture)
}

/// Hands on picture after picture, until nobody wants them any more.
fn each(
    take: &Take,
    studio: &Studio,
    teller: &Teller,
    mut hand_on: impl FnMut(usize, RgbImage) -> Result<(), ViewError>,
) -> Result<(), ViewError> {
    let count = take.recording.frame_count;
    for frame in 0..count {
        if teller.cancel.is_cancelled() {
            return Err(DrawError::Cancelled.into());
        }
        let share = frame as f64 / count as f64;
        teller.tell(format!("film: picture {} of {count}", frame + 1), share);
        hand_on(
            frame,
            studio.film_frame(&take.recording, frame, &take.view)?,
        )?;
    }
    Ok(())
}

fn gif(take: &Take, studio: &Studio, teller: &Teller) -> Result<(), ViewError> {
    let mut bytes = Vec::new();
    {
        let mut encoder = GifEncoder::new_with_speed(&mut bytes, GIF_SPEED);
        let refused = |error| refused(&take.path, error);
        encoder.set_repeat(Repeat::Infinite).map_err(refused)?;
        // Its unit is a hundredth of a second.
        let delay = Delay::from_numer_denom_ms((1e3 / take.options.rate).round() as u32, 1);
        each(take, studio, teller, |_, picture| {
            let picture = DynamicImage::ImageRgb8(picture).into_rgba8();
            let frame = Frame::from_parts(picture, 0, 0, delay);
            encoder.encode_frame(frame).map_err(refused)
        })?;
    }
    Ok(write_atomically(&take.path, &bytes)?)
}

fn frames(take: &Take, studio: &Studio, teller: &Teller) -> Result<(), ViewError> {
    make_folder(&take.path)?;
    each(take, studio, teller, |frame, picture| {
        let name = format!("frame-{:04}.png", frame + 1);
        write_png(&take.path.join(name), picture)
    })
}

fn mp4(take: &Take, studio: &Studio, teller: &Teller) -> Result<(), ViewError> {
    let mut ffmpeg = Ffmpeg::start(&take.path, take.options.size, take.options.rate)?;
    each(take, studio, teller, |_, picture| ffmpeg.give(&picture))?;
    ffmpeg.finish()
}

fn write_png(path: &Path, picture: RgbImage) -> Result<(), ViewError> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    DynamicImage::ImageRgb8(picture)
        .write_to(&mut bytes, ImageFormat::Png)
        .map_err(|error| refused(path, error))?;
    Ok(write_atomically(path, bytes.get_ref())?)
}

fn refused(path: &Path, error: image::ImageError) -> ViewError {
    ViewError::File {
        path: path.to_path_buf(),
        doing: "written",
        source: std::io::Error::other(error),
    }
}
