//! Small PNG files.

use crate::{PhotoError, Picture};

/// Size limit of a picture, bytes. A sheet of four stills takes 0.7 to 1.2 million as it is, and with rounded colours grey things get blotches of
/// pink and green.
const TARGET_BYTES: usize = 1_250_000;

/// Steps between the colours kept, of 255; the first is exact. At 2 no eye sees
/// a difference, at 8 smooth shadows show bands.
const STEPS: [u8; 6] = [1, 2, 3, 4, 6, 8];

/// Encodes a picture as PNG: exactly if that takes less than 1.25 MB, else with
/// colours rounded as little as makes it fit; at most to 32 shades per channel,
/// so a very large picture can still come out larger.
///
/// # Errors
///
/// [`PhotoError::Encode`] if the picture has no pixel.
pub fn encode_png(picture: &Picture) -> Result<Vec<u8>, PhotoError> {
    encode_png_within(picture, TARGET_BYTES)
}

/// [`encode_png`] with another limit than 1.25 MB, bytes.
///
/// # Errors
///
/// The same as [`encode_png`].
pub fn encode_png_within(picture: &Picture, most: usize) -> Result<Vec<u8>, PhotoError> {
    let mut bytes = Vec::new();
    for step in STEPS {
        bytes = encode_rounded(picture, step)?;
        if bytes.len() <= most {
            break;
        }
    }
    Ok(bytes)
}

fn encode_rounded(picture: &Picture, step: u8) -> Result<Vec<u8>, PhotoError> {
    let (step, half) = (u16::from(step), u16::from(step / 2));
    let round = |&value: &u8| ((u16::from(value) + half) / step * step).min(255) as u8;
    let pixels: Vec<u8> = picture.bytes().iter().map(round).collect();
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, picture.width(), picture.height());
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_compression(png::Compression::High);
    encoder.set_filter(png::Filter::Adaptive);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&pixels)?;
    writer.finish()?;
    Ok(bytes)
}
