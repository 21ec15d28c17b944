//! Samples as a WAV file.

use std::io::Cursor;

use hound::{SampleFormat, WavSpec, WavWriter};

use crate::error::{SoundError, checked_full_scale, within};

/// The bytes of a WAV file with 16 bits per sample: pressures, Pa, channel after channel in turn, samples per second, and the pressure of the
/// file's largest number, Pa. With that of the loudest sample nothing is bent and nothing is lost; with one of their own, files can be compared.
///
/// # Errors
/// A rate that is no whole number of samples, a number of channels other than 1 and 2, samples that are not a multiple of it, or not finite, or
/// louder than full scale.
pub fn wav(
    samples: &[f32],
    channels: usize,
    rate: f64,
    full_scale: f64,
) -> Result<Vec<u8>, SoundError> {
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
    // Silence has no loudest sample.
    let full_scale = checked_full_scale(if full_scale == 0.0 { 1.0 } else { full_scale })?;
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
        let share = f64::from(sample) / full_scale;
        // Rounding may exceed full scale by this much.
        within(
            || "a sample, as a share of full scale,".into(),
            share,
            share.abs() <= 1.0 + 1e-6,
            "from -1 to 1",
        )?;
        let value = (f64::from(i16::MAX) * share).round() as i16;
        writer.write_sample(value).map_err(told)?;
    }
    writer.finalize().map_err(told)?;
    Ok(bytes.into_inner())
}
