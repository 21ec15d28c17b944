//! Charts as PNG: points and lines over linear or logarithmic axes, with a legend; line drawings side by side; spectrograms.
//!
//! The project draws them itself, strokes and letters alike, so that a report needs no font file, no system library and no graphics
//! driver, and is the same on every machine. A library would take the place of about half of these 900 lines: those that fit
//! (`plotters`) take their letters from the system or from a font file that would have to lie here, and those without fonts
//! (`poloto`) write SVG, which cannot stand beside the drawn bodies in a figure's picture.

mod canvas;
mod chart;
mod font;
mod fourier;
mod panels;
mod spectrogram;
mod ticks;

pub use chart::{Axis, Chart, Marker, Scale, Series};
pub use panels::{Panel, Panels};
pub use spectrogram::{Spectrogram, Spectrum};

use std::io::Cursor;

use image::{ImageError, ImageFormat, RgbImage};

/// A picture as a PNG file.
///
/// # Errors
/// An error of the encoder.
pub fn png(picture: &RgbImage) -> Result<Vec<u8>, ImageError> {
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, ImageFormat::Png)?;
    Ok(bytes.into_inner())
}
