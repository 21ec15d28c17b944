//! What is heard, on its way from a session to a loudspeaker: a tape that runs as fast as the scene, and a queue.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Channels: left and right.
const CHANNELS: usize = 2;

/// So much waits before the queue is played again after it ran empty, beyond what the loudspeaker takes at once, s: a step may come as much later
/// than the one before without a gap.
const AHEAD: f64 = 0.04;

/// More than this is not put into the queue, s: whoever runs ahead of the clock is not heard to the end.
const MOST: f64 = 0.5;

/// Share of the last sample that the next one keeps where the queue ran empty, so that the end is no click.
const FADE: f32 = 0.98;

/// A queue of samples, −1 to 1, left and right in turn. Its clones are one and the same.
#[derive(Clone, Debug)]
pub struct Outlet {
    rate: f64,
    waiting: Arc<Mutex<Waiting>>,
}

#[derive(Debug, Default)]
struct Waiting {
    samples: VecDeque<f32>,
    /// The last sample of each channel that was played.
    last: [f32; CHANNELS],
    /// Whether the queue is played, and not silent until enough waits.
    flows: bool,
}

impl Outlet {
    /// An empty queue for a loudspeaker of so many samples per second.
    #[must_use]
    pub fn new(rate: f64) -> Self {
        Self {
            rate,
            waiting: Arc::default(),
        }
    }

    /// Samples per second.
    #[must_use]
    pub fn rate(&self) -> f64 {
        self.rate
    }

    fn waiting(&self) -> MutexGuard<'_, Waiting> {
        self.waiting.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Fills `out` with what comes next; silence where nothing waits.
    pub fn play(&self, out: &mut [f32]) {
        let mut waiting = self.waiting();
        waiting.flows |= waiting.samples.len() >= self.values(AHEAD) + out.len();
        for frame in out.chunks_mut(CHANNELS) {
            waiting.flows &= !waiting.samples.is_empty();
            for (channel, sample) in frame.iter_mut().enumerate() {
                let faded = FADE * waiting.last[channel];
                *sample = if faded.abs() > 1e-6 { faded } else { 0.0 };
                if waiting.flows {
                    *sample = waiting.samples.pop_front().unwrap_or(*sample);
                }
                waiting.last[channel] = *sample;
            }
        }
    }

    /// All that waits.
    #[must_use]
    pub fn drain(&self) -> Vec<f32> {
        self.waiting().samples.drain(..).collect()
    }

    /// Forgets what waits.
    pub(crate) fn clear(&self) {
        self.waiting().samples.clear();
    }

    pub(crate) fn put(&self, samples: &[f32]) {
        let mut waiting = self.waiting();
        if waiting.samples.len() <= self.values(MOST) {
            waiting.samples.extend(samples);
        }
    }

    /// Samples of all channels in a time, s.
    fn values(&self, seconds: f64) -> usize {
        CHANNELS * (seconds * self.rate) as usize
    }
}

/// Plays what was heard in simulated time as fast as the scene runs: slower is as much deeper.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tape {
    /// The last sample that was read of each channel, and where the head is after it, in samples, 0 to 1.
    last: [f32; CHANNELS],
    head: f64,
}

impl Tape {
    /// Reads `heard`, left and right in turn, with steps of so many samples, and adds what it reads to `out`: the line between two
    /// samples where the steps are short, the mean over the way where they are long, which keeps out what is too high for the loudspeaker.
    pub(crate) fn read(&mut self, heard: &[f32], step: f64, out: &mut Vec<f32>) {
        let (mut sum, mut count) = ([0.0; CHANNELS], 0.0_f32);
        for frame in heard.as_chunks::<CHANNELS>().0 {
            while self.head < 1.0 {
                let share = self.head as f32;
                for channel in 0..CHANNELS {
                    let line = self.last[channel] * (1.0 - share) + frame[channel] * share;
                    let mean = (sum[channel] + line) / (count + 1.0);
                    out.push(mean);
                }
                (sum, count) = ([0.0; CHANNELS], 0.0);
                self.head += step;
            }
            self.head -= 1.0;
            for (sum, sample) in sum.iter_mut().zip(frame) {
                *sum += sample;
            }
            self.last = *frame;
            count += 1.0;
            if self.head < 1.0 {
                // The next sample to come out is on the line from here.
                (sum, count) = ([0.0; CHANNELS], 0.0);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    fn tone(period: f64, count: usize) -> Vec<f32> {
        let sample = |i: usize| (TAU * i as f64 / period).sin() as f32;
        (0..count).flat_map(|i| [sample(i), -sample(i)]).collect()
    }

    #[test]
    fn a_tape_at_half_the_speed_is_an_octave_deeper_in_whatever_parts_it_comes() {
        let track = tone(60.0, 3000);
        let (mut tape, mut slow) = (Tape::default(), Vec::new());
        for part in track.chunks(2 * 37) {
            tape.read(part, 0.5, &mut slow);
        }
        let (mut whole, mut at_once) = (Tape::default(), Vec::new());
        whole.read(&track, 0.5, &mut at_once);
        assert_eq!(slow, at_once);
        assert_eq!(slow.len(), 2 * track.len());
        // The first sample comes before the first of the track.
        let wanted = tone(120.0, 6000);
        let off = slow[4..].iter().zip(&wanted).map(|(a, b)| (a - b).abs());
        assert!(off.fold(0.0, f32::max) < 0.06);
    }

    #[test]
    fn a_tape_at_its_own_speed_is_the_track_and_a_faster_one_is_shorter() {
        let track = tone(60.0, 3000);
        let (mut same, mut fast) = (Vec::new(), Vec::new());
        Tape::default().read(&track, 1.0, &mut same);
        assert_eq!(same[2..], track[..track.len() - 2]);
        Tape::default().read(&track, 4.0, &mut fast);
        assert_eq!(fast.len(), track.len() / 4);
    }

    #[test]
    fn a_queue_waits_for_a_little_then_plays_what_was_put_in_and_fades() {
        let outlet = Outlet::new(1000.0);
        outlet.put(&[0.5; 100]);
        let mut out = [1.0; 40];
        outlet.clone().play(&mut out);
        assert!(out.iter().all(|&s| s == 0.0));
        outlet.put(&[0.5; 20]);
        outlet.clone().play(&mut out);
        assert!(out.iter().all(|&s| s == 0.5));
        let mut out = [1.0; 120];
        outlet.clone().play(&mut out);
        assert!(out[..80].iter().all(|&s| s == 0.5));
        assert!(out[80..].iter().all(|&s| 0.0 < s && s < 0.5));
        outlet.put(&[0.5; 20]);
        outlet.clear();
        assert!(outlet.drain().is_empty());
        for _ in 0..1000 {
            outlet.put(&[0.1; 100]);
        }
        assert!(outlet.drain().len() < 2 * 700, "half a second and a little");
    }
}
