//! WebP films, by libwebp.

use std::path::Path;

use frangible_recording::write_atomically;
use webp_animation::{Encoder, EncoderOptions, EncodingConfig, EncodingType, LossyEncodingConfig};

use crate::film::unwritten;
use crate::{PhotoError, Picture};

/// Quality, from 1 to 100; at 75 no difference is seen while things move.
pub(crate) const WEBP_QUALITY: f32 = 75.0;

/// Effort of the encoder, from 0, the fastest, to 6, the smallest file.
const EFFORT: usize = 5;

/// A WebP that grows in memory: it is a few megabytes at most.
pub(crate) struct WebP(Encoder);

impl WebP {
    pub(crate) fn begin(path: &Path, size: [u32; 2], quality: f32) -> Result<Self, PhotoError> {
        let options = EncoderOptions {
            // Each picture by itself: what is kept of the one before would stay behind as blocks in smooth backgrounds.
            kmax: 1,
            encoding_config: Some(EncodingConfig {
                encoding_type: EncodingType::Lossy(LossyEncodingConfig::default()),
                quality,
                method: EFFORT,
            }),
            ..EncoderOptions::default()
        };
        let encoder = Encoder::new_with_options((size[0], size[1]), options);
        encoder.map(Self).map_err(|error| failed(path, &error))
    }

    /// Adds a picture that is seen from a time on, s.
    pub(crate) fn add(
        &mut self,
        picture: &Picture,
        time: f64,
        path: &Path,
    ) -> Result<(), PhotoError> {
        let pixels = picture.bytes().chunks_exact(3);
        let opaque: Vec<u8> = pixels
            .flat_map(|rgb| [rgb[0], rgb[1], rgb[2], 255])
            .collect();
        let added = self.0.add_frame(&opaque, milliseconds(time));
        added.map_err(|error| failed(path, &error))
    }

    /// Writes it, so many seconds long.
    pub(crate) fn finish(self, long: f64, path: &Path) -> Result<(), PhotoError> {
        let bytes = self.0.finalize(milliseconds(long));
        let bytes = bytes.map_err(|error| failed(path, &error))?;
        Ok(write_atomically(path, &bytes)?)
    }
}

fn milliseconds(time: f64) -> i32 {
    (1e3 * time).round() as i32
}

fn failed(path: &Path, error: &webp_animation::Error) -> PhotoError {
    unwritten(path, std::io::Error::other(error.to_string()))
}
