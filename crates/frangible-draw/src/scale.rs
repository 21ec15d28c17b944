//! Downscaling of four drawn pixels to one of the picture.

use image::{Rgb, RgbImage};

/// Halves a picture both ways. Light is averaged, not its 8-bit code: edges
/// between dark and bright else come out too dark.
pub(crate) fn halve(drawn: &RgbImage) -> RgbImage {
    let linear: [f32; 256] = std::array::from_fn(|code| (code as f32 / 255.0).powf(2.2));
    let code = |light: f32| (light.powf(1.0 / 2.2) * 255.0 + 0.5) as u8;
    RgbImage::from_fn(drawn.width() / 2, drawn.height() / 2, |x, y| {
        let at = |dx, dy| drawn.get_pixel(2 * x + dx, 2 * y + dy).0;
        let four = [at(0, 0), at(1, 0), at(0, 1), at(1, 1)];
        if four.iter().all(|pixel| *pixel == four[0]) {
            return Rgb(four[0]);
        }
        Rgb(std::array::from_fn(|channel| {
            code(
                0.25 * four
                    .iter()
                    .map(|pixel| linear[usize::from(pixel[channel])])
                    .sum::<f32>(),
            )
        }))
    })
}
