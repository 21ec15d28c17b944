//! Loudness and true peak by the recommendation EBU R 128.

use ebur128::{EbuR128, Mode};

use crate::error::{SoundError, finite, within};

/// The shortest sound that R 128 measures, s: one of its blocks. A shorter one is taken to be followed by silence.
const BLOCK: f64 = 0.4;

/// Loudness of a sound, by the recommendation EBU R 128.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Loudness {
    /// Integrated loudness, LUFS; `None` where all of the sound is below the gate of −70 LUFS.
    pub integrated: Option<f64>,
    /// Largest loudness of 400 ms, LUFS; `None` for silence.
    pub momentary: Option<f64>,
    /// True peak, dB over full scale (dBTP); `None` for silence.
    pub true_peak: Option<f64>,
}

impl Loudness {
    /// Measures samples, 1 at full scale, with interleaved channels. `rate` is in samples per second.
    ///
    /// # Errors
    /// The rate is not a whole number from 8000 to 192 000, the number of channels is not 1 or 2, the number of samples is not a multiple of
    /// it, or a sample is not finite.
    pub fn of(samples: &[f32], channels: usize, rate: f64) -> Result<Self, SoundError> {
        checked(samples, channels, rate)?;
        let mut meter = meter(channels, rate, Mode::I | Mode::M | Mode::TRUE_PEAK)?;
        let mut momentary = f64::NEG_INFINITY;
        // R 128 moves its block by a quarter of its length.
        for part in parts(samples, channels, rate) {
            meter.add_frames_f32(&part).map_err(told)?;
            momentary = momentary.max(meter.loudness_momentary().map_err(told)?);
        }
        let mut peak = 0.0_f64;
        for channel in 0..channels {
            peak = peak.max(meter.true_peak(channel as u32).map_err(told)?);
        }
        Ok(Self {
            integrated: known(meter.loudness_global().map_err(told)?),
            momentary: known(momentary),
            true_peak: known(20.0 * peak.log10()),
        })
    }
}

/// Integrated loudness alone, which takes a fraction of the time, of samples that were checked.
pub(super) fn integrated(
    samples: &[f32],
    channels: usize,
    rate: f64,
) -> Result<Option<f64>, SoundError> {
    let mut meter = meter(channels, rate, Mode::I)?;
    for part in parts(samples, channels, rate) {
        meter.add_frames_f32(&part).map_err(told)?;
    }
    Ok(known(meter.loudness_global().map_err(told)?))
}

fn meter(channels: usize, rate: f64, mode: Mode) -> Result<EbuR128, SoundError> {
    EbuR128::new(channels as u32, rate as u32, mode).map_err(told)
}

fn told(error: ebur128::Error) -> SoundError {
    SoundError::Loudness(error.to_string())
}

fn known(level: f64) -> Option<f64> {
    Some(level).filter(|level| level.is_finite())
}

/// The samples in quarters of a block, at least four.
fn parts(samples: &[f32], channels: usize, rate: f64) -> impl Iterator<Item = Vec<f32>> {
    let quarter = channels * (0.25 * BLOCK * rate) as usize;
    let count = samples.len().div_ceil(quarter).max(4);
    (0..count).map(move |i| {
        let [from, to] = [i, i + 1].map(|k| (k * quarter).min(samples.len()));
        let mut part = samples[from..to].to_vec();
        if i < 4 {
            part.resize(quarter, 0.0);
        }
        part
    })
}

/// Refuses samples that cannot be measured.
pub(super) fn checked(samples: &[f32], channels: usize, rate: f64) -> Result<(), SoundError> {
    let whole = rate.fract() == 0.0 && (8_000.0..=192_000.0).contains(&rate);
    within(
        || "the sampling rate of a sound".into(),
        rate,
        whole,
        "whole, from 8000 to 192000, in 1/s",
    )?;
    let fits = (1..=2).contains(&channels);
    within(
        || "the number of channels".into(),
        channels as f64,
        fits,
        "1 or 2",
    )?;
    if !samples.len().is_multiple_of(channels) {
        return Err(SoundError::BadCount {
            what: "the list of samples".into(),
            count: samples.len(),
            expected: format!("a multiple of {channels} is"),
        });
    }
    for (i, &sample) in samples.iter().enumerate() {
        finite(|| format!("sample {i}"), f64::from(sample))?;
    }
    Ok(())
}
