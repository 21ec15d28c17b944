//! A stage that brings loud and soft sounds together, for files and for live playback.

use std::collections::VecDeque;

use super::least::Least;
use crate::error::{SoundError, checked_full_scale, within};

/// Largest sample: −4 dB. What is bent has peaks between its samples: those of a broken cup are 3.8 dB higher, those of white noise 4 dB.
const CEILING: f64 = 0.630_957_344_480_193_2;

/// Samples above this are bent: −9 dB.
const BENT: f64 = 0.354_813_389_233_575_5;

/// Size to which the gain limits peaks: 9 dB, which is 13 dB above the ceiling; bending takes the rest.
const DRIVEN: f64 = 2.818_382_931_264_453_6;

/// Level above which sounds are not raised: −6 dB.
const LOUD: f64 = 0.501_187_233_627_272_2;

/// Largest gain of soft sounds: 18 dB, which those 36 dB below [`LOUD`] get. Whatever is softer gets no more than that.
const MOST: f64 = 7.943_282_347_242_815;

/// Fall of the level on which the gain of soft sounds hangs, as a natural logarithm in a second: 20 dB/s.
const FALL: f64 = std::f64::consts::LN_10;

/// Time in which the limiter's reduction falls to 1/e, s.
const RELEASE: f64 = 0.03;

/// Time by which the gain is ahead of the sound, s: it falls within that time, along a line.
const AHEAD: f64 = 1e-3;

/// Statistics of a leveller so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LevellerReport {
    /// Loudest pressure, Pa.
    pub peak: f64,
    /// Largest reduction of a loud sample below that of full scale, dB; 0 if none.
    pub reduction: f64,
    /// Largest gain of a soft sample beyond that of full scale, dB; 0 if none.
    pub raised: f64,
}

/// Converts pressures to samples for a loudspeaker: raises soft sounds and limits loud ones.
///
/// A crash and the shards that settle after it are 60 dB and more apart. The ear takes both in; a loudspeaker at a volume at which one can bear the
/// crash plays the rest below the noise of a room. Therefore
///
/// - sounds whose peaks are below −6 dB of full scale are raised by half of what they lack (a ratio of 2 : 1), at most by 18 dB. The
///   level on which that hangs rises at once, to full scale and no further, and falls by 20 dB/s, so that the decay of a tone becomes slower by at
///   most half as much, and what follows a click is raised as soon as what follows a crash;
/// - samples above −9 dB are bent more and more, and stay below −4 dB, so that what lies between them does not exceed full scale. Peaks more than
///   13 dB above that are first limited by the gain, which begins to fall one millisecond before and returns with a time constant of 30 ms.
///
/// A crash is bent for some milliseconds, in which it is noise, and keeps its place above what follows; a gain alone would duck its shards.
///
/// Both channels have the same gain, silence stays silence, and the same calls give the same samples.
#[derive(Clone, Debug)]
pub struct Leveller {
    channels: usize,
    full_scale: f64,
    /// Frames by which the gain is ahead; per frame the share of the level that stays, and that of the reduction that is released.
    ahead: usize,
    stays: f64,
    release: f64,
    least: Least,
    /// Pressures that wait for their gain, and the gains of which the mean is taken, with their sum.
    waiting: VecDeque<f32>,
    gains: VecDeque<f64>,
    sum: f64,
    level: f64,
    gain: f64,
    /// Loudest pressure, Pa, and the smallest and the largest factor that a sample got.
    peak: f64,
    factors: [f64; 2],
}

impl Leveller {
    /// Full scale for live playback, where no loudness is known in advance: 10 Pa, 114 dB. That is in the middle of what [`by_loudness`](crate::by_loudness)
    /// finds for tableware, panes and bottles that break a metre away.
    pub const LIVE: f64 = 10.0;

    /// Creates a leveller for interleaved channels. `rate` is in samples per second; `full_scale` is the pressure, Pa, that becomes a sample of 1
    /// where nothing is raised or limited.
    ///
    /// # Errors
    /// The rate is not from 8000 to 192 000, the number of channels is not 1 or 2, or the pressure is not finite or not positive.
    pub fn new(rate: f64, channels: usize, full_scale: f64) -> Result<Self, SoundError> {
        within(
            || "the sampling rate of a leveller".into(),
            rate,
            (8_000.0..=192_000.0).contains(&rate),
            "from 8000 to 192000, in 1/s",
        )?;
        within(
            || "the number of channels of a leveller".into(),
            channels as f64,
            (1..=2).contains(&channels),
            "1 or 2",
        )?;
        let ahead = (AHEAD * rate).round() as usize;
        Ok(Self {
            channels,
            full_scale: checked_full_scale(full_scale)?,
            ahead,
            stays: 1.0 - FALL / rate,
            release: 1.0 / (RELEASE * rate),
            least: Least::default(),
            waiting: vec![0.0; channels * (ahead - 1)].into(),
            gains: vec![MOST; ahead].into(),
            sum: MOST * ahead as f64,
            level: 0.0,
            gain: MOST,
            peak: 0.0,
            factors: [1.0; 2],
        })
    }

    /// Returns its statistics so far.
    #[must_use]
    pub fn report(&self) -> LevellerReport {
        let [reduction, raised] = self.factors.map(|factor| 20.0 * factor.log10());
        LevellerReport {
            peak: self.peak,
            reduction: -reduction,
            raised,
        }
    }

    /// Number of frames by which the samples that come out are late: one millisecond.
    #[must_use]
    pub fn delay(&self) -> usize {
        self.ahead - 1
    }

    /// Converts pressures, Pa, with interleaved channels, to as many samples within ±1, which are added to `out`. A pressure that is no
    /// number counts as silence.
    ///
    /// # Errors
    /// The number of pressures is not a multiple of the number of channels.
    pub fn level(&mut self, pressures: &[f32], out: &mut Vec<f32>) -> Result<(), SoundError> {
        if !pressures.len().is_multiple_of(self.channels) {
            return Err(SoundError::BadCount {
                what: "the list of pressures".into(),
                count: pressures.len(),
                expected: format!("a multiple of {} is", self.channels),
            });
        }
        for frame in pressures.chunks_exact(self.channels) {
            let gain = self.gain_after(frame);
            for _ in frame {
                let pressure = self.waiting.pop_front().unwrap_or(0.0);
                out.push(self.bent(pressure, gain));
            }
        }
        Ok(())
    }

    /// Takes a frame, and returns the gain of the one that comes out.
    fn gain_after(&mut self, frame: &[f32]) -> f64 {
        let mut peak = 0.0_f64;
        for &pressure in frame {
            let pressure = if pressure.is_finite() { pressure } else { 0.0 };
            self.waiting.push_back(pressure);
            peak = peak.max(f64::from(pressure.abs()));
        }
        self.peak = self.peak.max(peak);
        peak /= self.full_scale;
        self.level = peak.min(1.0).max(self.stays * self.level);
        let raised = (LOUD / self.level.max(1e-30)).sqrt().clamp(1.0, MOST);
        let wanted = raised.min(DRIVEN / peak.max(1e-30));
        self.gain = wanted.min(self.gain + self.release * (wanted - self.gain));
        let least = self.least.next(self.gain, self.ahead);
        self.sum += least - self.gains.pop_front().unwrap_or(least);
        self.gains.push_back(least);
        self.sum / self.ahead as f64
    }

    /// The sample of a pressure under a gain, bent where it is large: in part the same line, and from there the curve t/√(1 + t²) to the ceiling.
    fn bent(&mut self, pressure: f32, gain: f64) -> f32 {
        let plain = f64::from(pressure.abs()) / self.full_scale;
        let size = gain * plain;
        let room = CEILING - BENT;
        let over = (size - BENT) / room;
        let sample = if over > 0.0 {
            BENT + room * over / (1.0 + over * over).sqrt()
        } else {
            size
        };
        if plain > 0.0 {
            let change = sample / plain;
            let [least, most] = self.factors;
            self.factors = [least.min(change), most.max(change)];
        }
        (sample as f32).copysign(pressure)
    }
}
