//! Pictures one after the other, of the last seconds.

use std::path::Path;
use std::sync::Arc;

use frangible_draw::{DrawError, FilmFormat, FilmWriter, Studio, encode_png_within};
use frangible_export::write_atomically;

use super::Take;
use crate::command::FilmKind;
use crate::error::ViewError;
use crate::jobs::Teller;

/// Makes it.
pub(super) fn shoot(take: &Take, teller: &Teller) -> Result<(), ViewError> {
    let [width, height] = take.options.size;
    let studio = Studio::new(width, height)?;
    let format = match take.kind {
        FilmKind::Still => return still(take, &studio, teller),
        FilmKind::Gif => FilmFormat::Gif,
        FilmKind::Mp4 => FilmFormat::Mp4,
        FilmKind::Frames => FilmFormat::Frames,
    };
    let mut film = FilmWriter::begin(&take.path, format, take.options.size, take.options.rate)?;
    let count = take.recording.frame_count;
    for frame in 0..count {
        if teller.cancel.is_cancelled() {
            return Err(DrawError::Cancelled.into());
        }
        let share = frame as f64 / count as f64;
        teller.tell(format!("film: picture {} of {count}", frame + 1), share);
        film.add(studio.film_frame(&take.recording, frame, &take.view)?)?;
    }
    Ok(film.finish()?)
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
    if let Some(folder) = take.path.parent().filter(|f| !f.as_os_str().is_empty()) {
        make_folder(folder)?;
    }
    let png = encode_png_within(&picture, usize::MAX)?;
    Ok(write_atomically(&take.path, &png)?)
}

fn make_folder(folder: &Path) -> Result<(), ViewError> {
    std::fs::create_dir_all(folder).map_err(|source| ViewError::File {
        path: folder.to_path_buf(),
        doing: "made",
        source,
    })
}
