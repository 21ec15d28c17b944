//! Samples as a WAV file.

use std::io::Cursor;

use hound::{SampleFormat, WavSpec, WavWriter};

use crate::error::{SoundError, within};

/// The bytes of a WAV file with 16 bits per sample: samples from −1 to 1, channel after channel in turn, and samples per second.
///
/// # Errors
/// A rate that is no whole number of samples, a number of channels other than 1 and 2, samples that are not a multiple of it or not finite.
pub fn wav(samples: &[f32], channels: usize, rate: f64) -> Result<Vec<u8>, SoundError> {
    let whole = rate.fract() == 0.0 && (1.0..=1e6).contains(&rate);
    within(
        || "the sampling rate of a WAV file".into(),
        rate,
        whole,
        "whole, from 1 to 1000000",
    )?;
    let count = channels as f64;
    let fits = (1..=2).contains(&channels);
    within(|| "the number of channels".into(), count, fits, "1 or 2")?;
    if !samples.len().is_multiple_of(channels) {
        return Err(SoundError::BadCount {
            what: "the list of samples".into(),
            count: samples.len(),
            expected: format!("a multiple of {channels} is"),
        });
    }
    let spec = WavSpec {
        channels: channels as u16,
        sample_rate: rate as u32,
        bits_per_sample: 16,
        sample_format: SampleFormat::Int,
    };
    let told = |error: hound::Error| SoundError::Wav(error.to_string());
    let mut bytes = Cursor::new(Vec::new());
    let mut writer = WavWriter::new(&mut bytes, spec).map_err(told)?;
    for &sample in samples {
        let fits = (-1.0..=1.0).contains(&sample);
        within(
            || "a sample".into(),
            f64::from(sample),
            fits,
            "from -1 to 1",
        )?;
        let value = (f32::from(i16::MAX) * sample).round() as i16;
        writer.write_sample(value).map_err(told)?;
    }
    writer.finalize().map_err(told)?;
    Ok(bytes.into_inner())
}
