//! Small PNG files.

use image::RgbImage;

use crate::DrawError;

/// Encodes a picture as PNG.
///
/// # Errors
///
/// [`DrawError::Encode`] if the picture has no pixel.
pub fn encode_png(picture: &RgbImage) -> Result<Vec<u8>, DrawError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, picture.width(), picture.height());
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_compression(png::Compression::High);
    encoder.set_filter(png::Filter::Adaptive);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(picture.as_raw())?;
    writer.finish()?;
    Ok(bytes)
}
