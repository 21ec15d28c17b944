//! Pictures one after the other, of the last seconds.

use std::path::Path;

use frangible_draw::Raster;
use frangible_photo::{FilmFormat, FilmWriter, PhotoError, Studio, encode_png_within};
use frangible_recording::{Recording, View, write_atomically};

use crate::command::{FilmKind, FilmOptions};
use crate::error::ViewError;
use crate::jobs::Teller;

/// Makes the film of a recording as it is seen from a view, or the still.
pub(super) fn shoot(
    kind: FilmKind,
    options: &FilmOptions,
    (recording, view): (&Recording, &View),
    path: &Path,
    teller: &Teller,
) -> Result<(), ViewError> {
    let [width, height] = options.size;
    let format = match kind {
        FilmKind::Still => {
            let go_on = telling(teller, options.samples);
            let studio = Studio::new(width, height)?;
            let picture = studio.traced(recording, 0, view, options.samples, go_on)?;
            return write_still(path, &encode_png_within(&picture, usize::MAX)?);
        }
        FilmKind::Gif => FilmFormat::Gif,
        FilmKind::Mp4 => FilmFormat::Mp4,
        FilmKind::Frames => FilmFormat::Frames,
    };
    let raster = Raster::new(width, height)?;
    let mut film = FilmWriter::begin(path, format, options.size, options.rate)?;
    let count = recording.frame_count;
    for frame in 0..count {
        if teller.cancel.is_cancelled() {
            return Err(PhotoError::Cancelled.into());
        }
        let share = frame as f64 / count as f64;
        teller.tell(format!("film: picture {} of {count}", frame + 1), share);
        film.add(&raster.frame(recording, frame as f64, view)?)?;
    }
    Ok(film.finish()?)
}

/// Callback of a still: reports the number of samples, and returns true if the still is still wanted.
fn telling(teller: &Teller, samples: u32) -> impl Fn(u32) -> bool {
    let teller = teller.clone();
    teller.tell("path-tracing".into(), 0.0);
    move |done: u32| {
        let share = f64::from(done) / f64::from(samples);
        teller.tell(format!("path-tracing: {done} of {samples} samples"), share);
        !teller.cancel.is_cancelled()
    }
}

fn write_still(path: &Path, png: &[u8]) -> Result<(), ViewError> {
    if let Some(folder) = path.parent().filter(|f| !f.as_os_str().is_empty()) {
        make_folder(folder)?;
    }
    Ok(write_atomically(path, png)?)
}

fn make_folder(folder: &Path) -> Result<(), ViewError> {
    std::fs::create_dir_all(folder).map_err(|source| ViewError::File {
        path: folder.to_path_buf(),
        doing: "made",
        source,
    })
}
