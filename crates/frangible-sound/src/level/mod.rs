//! The level of sounds for loudspeakers: by loudness, so that crash, ringing shards and landings are all heard.

mod least;
mod leveller;
mod loudness;

use crate::error::{SoundError, within};

pub use leveller::{Leveller, LevellerReport};
pub use loudness::Loudness;

use loudness::{checked, integrated};

/// Loudness of a file, LUFS, at which speech and music are played on phones and in browsers.
pub const TARGET: f64 = -16.0;

/// Largest true peak of a file, dB over full scale: the ceiling of EBU R 128.
const TRUE_PEAK: f64 = -1.0;

/// Most that full scale may lie below the peak, dB. A click of which more would have to be taken to reach a loudness stays softer.
const MOST_LIMITED: f64 = 48.0;

/// Trials in which full scale is found, the errors with which it is good enough and with which it is not, LU, and the range of the growth of loudness with the
/// gain, LU/dB: the leveller takes some of it.
const TRIALS: usize = 16;
const CLOSE: f64 = 0.02;
const FAR: f64 = 0.2;
const GROWTH: [f64; 2] = [0.3, 1.0];

/// The level at which a sound is played.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Level {
    /// An integrated loudness of −16 LUFS in files: soft sounds are raised and loud ones limited.
    #[default]
    Loudness,
    /// True to scale: all sounds have the same gain.
    True,
}

/// A sound at the level of its loudness.
#[derive(Clone, Debug, PartialEq)]
pub struct Levelled {
    /// Samples within ±1, with interleaved channels.
    pub samples: Vec<f32>,
    /// Pressure, Pa, that is full scale where nothing is raised or limited; `None` for silence.
    pub full_scale: Option<f64>,
    /// Loudness of the samples.
    pub loudness: Loudness,
    /// Statistics of the leveller.
    pub leveller: LevellerReport,
}

/// Levels pressures, Pa, with interleaved channels, to an integrated loudness, LUFS, with a [`Leveller`].
///
/// Full scale is found by trial, so that the samples have that loudness within 0.5 LU and a true peak of at most −1 dB. Where the peak would be more
/// than 48 dB above full scale, the sound stays softer: a click alone does not become loud. Silence stays silence. Pressures that are all
/// larger by a factor give the same samples but for rounding.
///
/// # Errors
/// The target is not from −40 to −10 LUFS, or [`Loudness::of`] refuses the pressures.
pub fn by_loudness(
    pressures: &[f32],
    channels: usize,
    rate: f64,
    target: f64,
) -> Result<Levelled, SoundError> {
    within(
        || "the loudness of a file".into(),
        target,
        (-40.0..=-10.0).contains(&target),
        "from -40 to -10, in LUFS",
    )?;
    checked(pressures, channels, rate)?;
    let peak = pressures.iter().fold(0.0_f32, |most, p| most.max(p.abs()));
    if peak == 0.0 {
        return Ok(Levelled {
            samples: pressures.to_vec(),
            full_scale: None,
            loudness: Loudness::of(pressures, channels, rate)?,
            leveller: LevellerReport::default(),
        });
    }
    let plain: Vec<f32> = pressures.iter().map(|pressure| pressure / peak).collect();
    let sound = Plain {
        samples: &plain,
        channels,
        rate,
    };
    let plain = integrated(sound.samples, channels, rate)?;
    let start = plain.map_or(MOST_LIMITED, |plain| target - plain);
    let mut tried = sound.tried(start, 1.0, target)?;
    let mut loudness = Loudness::of(&tried.samples, channels, rate)?;
    // What peaks between samples ask for is taken from all, and the loudness found anew.
    for again in [true, false] {
        let excess = loudness.true_peak.map_or(0.0, |peak| peak - TRUE_PEAK);
        if excess <= 0.0 {
            break;
        }
        let less = decibels(-excess);
        if again {
            tried = sound.tried(tried.over, less, target)?;
        } else {
            tried.samples.iter_mut().for_each(|s| *s *= less as f32);
        }
        loudness = Loudness::of(&tried.samples, channels, rate)?;
    }
    let full_scale = f64::from(peak) * decibels(-tried.over);
    Ok(Levelled {
        samples: tried.samples,
        full_scale: Some(full_scale),
        loudness,
        leveller: LevellerReport {
            peak: f64::from(peak),
            ..tried.report
        },
    })
}

/// The factor of so many dB.
fn decibels(level: f64) -> f64 {
    10.0_f64.powf(level / 20.0)
}

/// A sound with a peak of 1.
struct Plain<'a> {
    samples: &'a [f32],
    channels: usize,
    rate: f64,
}

/// A levelled sound, and how far its peak was over full scale, dB.
#[derive(Clone)]
struct Tried {
    samples: Vec<f32>,
    over: f64,
    report: LevellerReport,
}

impl Plain<'_> {
    /// Finds the level of a loudness, LUFS, with a factor after the leveller. `start`: a guess of how far the peak is over full scale, dB.
    fn tried(&self, start: f64, factor: f64, target: f64) -> Result<Tried, SoundError> {
        let (mut over, mut before) = (start.min(MOST_LIMITED), None::<[f64; 2]>);
        // The loudness grows with the gain, but for steps where its gate lets a part of the sound in or out.
        let (mut least, mut most) = (f64::NEG_INFINITY, MOST_LIMITED);
        let mut best: Option<(f64, Tried)> = None;
        let mut louder: Option<(f64, Tried)> = None;
        for trial in 0..TRIALS {
            let tried = self.levelled(over, factor)?;
            let loudness = integrated(&tried.samples, self.channels, self.rate)?;
            let off = loudness.map_or(f64::INFINITY, |loudness| target - loudness);
            if off < 0.0 && louder.as_ref().is_none_or(|(known, _)| off > *known) {
                louder = Some((off, tried.clone()));
            }
            if best
                .as_ref()
                .is_none_or(|(known, _)| off.abs() < known.abs())
            {
                best = Some((off, tried));
            }
            let known = loudness.is_some() && off.abs() > CLOSE;
            if !known || (off > 0.0 && over >= MOST_LIMITED) || most - least < CLOSE {
                break;
            }
            *(if off > 0.0 { &mut least } else { &mut most }) = over;
            let growth = before.map_or(GROWTH[1], |[then, off_then]| {
                (off_then - off) / (over - then)
            });
            before = Some([over, off]);
            over += off / growth.clamp(GROWTH[0], GROWTH[1]);
            if !(least..most).contains(&over) || trial > TRIALS / 2 {
                over = if least.is_finite() {
                    0.5 * (least + most)
                } else {
                    over.min(most)
                };
            }
        }
        // At such a step no gain gives the loudness; that above it is turned down as a whole, which leaves the gate where it is.
        if let Some((off, mut tried)) = louder
            && best.as_ref().is_none_or(|(known, _)| known.abs() > FAR)
        {
            let less = decibels(off) as f32;
            tried.samples.iter_mut().for_each(|sample| *sample *= less);
            return Ok(tried);
        }
        best.map_or_else(|| self.levelled(over, factor), |(_, tried)| Ok(tried))
    }

    /// Levels it with its peak so many dB over full scale.
    fn levelled(&self, over: f64, factor: f64) -> Result<Tried, SoundError> {
        let mut leveller = Leveller::new(self.rate, self.channels, decibels(-over))?;
        let late = leveller.delay() * self.channels;
        let mut samples = Vec::with_capacity(self.samples.len() + late);
        leveller.level(self.samples, &mut samples)?;
        leveller.level(&vec![0.0; late], &mut samples)?;
        samples.drain(..late);
        let factor = factor as f32;
        samples.iter_mut().for_each(|sample| *sample *= factor);
        Ok(Tried {
            samples,
            over,
            report: leveller.report(),
        })
    }
}
