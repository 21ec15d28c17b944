//! Converts light to the colours of the picture.

use frangible_recording::glam::Vec3A;

use crate::Picture;

/// Factor of the light before the picture is developed.
const EXPOSURE: f32 = 1.12;

/// Share of the picture's contrast that is moved from the ends to the middle.
const CONTRAST: f32 = 0.22;

/// The picture of this light, row by row.
pub(crate) fn develop(light: &[Vec3A], width: u32, height: u32) -> Picture {
    Picture::from_fn(width, height, |x, y| {
        // No noise against bands: the floor has grain, and noise would double the file.
        let code = |part: f32| (255.0 * tone_of(part) + 0.5) as u8;
        light[(y * width + x) as usize].to_array().map(code)
    })
}

/// Brightness of light on the picture, 0 to 1.
pub(crate) fn tone(light: Vec3A) -> f32 {
    tone_of(light.dot(Vec3A::new(0.2126, 0.7152, 0.0722)))
}

/// Film takes up ever less of ever more light; then sRGB's curve, a little steeper in the middle.
fn tone_of(part: f32) -> f32 {
    let taken = 1.0 - (-EXPOSURE * part.max(0.0)).exp();
    let code = if taken <= 0.003_130_8 {
        12.92 * taken
    } else {
        1.055 * taken.powf(1.0 / 2.4) - 0.055
    };
    code + CONTRAST * (code * code * (3.0 - 2.0 * code) - code)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_light_is_brighter_and_no_light_is_too_much() {
        let mut before = tone_of(0.0);
        assert_eq!(before, 0.0);
        for step in 1..400 {
            let now = tone_of(0.01 * step as f32);
            assert!(now > before && now < 1.0, "{step}");
            before = now;
        }
        assert!(tone_of(f32::MAX) <= 1.0);
    }
}
