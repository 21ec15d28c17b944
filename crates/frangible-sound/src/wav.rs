//! Encoding of samples as a WAV file.

use std::io::Cursor;

use hound::{SampleFormat, WavSpec, WavWriter};

use crate::error::{SoundError, checked_full_scale, within};

/// Encodes pressures, Pa, with interleaved channels as a WAV file with 16 bits per sample.
///
/// `rate` is in samples per second and `full_scale` in Pa. The peak pressure as `full_scale` uses the full range without clipping; the
/// same value for several files makes them comparable.
///
/// # Errors
/// The rate is not a whole number, the number of channels is not 1 or 2, the number of samples is not a multiple of it, or a sample is
/// not finite or exceeds full scale.
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
