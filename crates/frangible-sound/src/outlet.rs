//! A queue of samples for playback, shared by two threads.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Channels: left and right.
const CHANNELS: usize = 2;

/// Stock at which an empty queue is played again, beyond what the loudspeaker takes at once, s: a step may come as much later
/// than the one before without a gap.
const AHEAD: f64 = 0.04;

/// Stock beyond which no samples are added, s: a simulation that runs ahead of the clock is not heard to the end.
const MOST: f64 = 0.5;

/// Share of the last sample that the next one keeps where the queue ran empty, so that the end is no click.
const FADE: f32 = 0.98;

/// A queue of samples, −1 to 1, left and right interleaved. Clones share one queue.
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
    /// True while the queue is played; false while it is silent until enough samples wait.
    flows: bool,
}

impl Outlet {
    /// Creates an empty queue with this sampling rate, samples per second.
    #[must_use]
    pub fn new(rate: f64) -> Self {
        Self {
            rate,
            waiting: Arc::default(),
        }
    }

    /// Returns the sampling rate, samples per second.
    #[must_use]
    pub fn rate(&self) -> f64 {
        self.rate
    }

    fn waiting(&self) -> MutexGuard<'_, Waiting> {
        self.waiting.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Fills `out` with the next samples, or with silence if the queue is empty.
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

    /// Removes and returns all queued samples.
    #[must_use]
    pub fn drain(&self) -> Vec<f32> {
        self.waiting().samples.drain(..).collect()
    }

    /// Discards the queued samples.
    pub fn clear(&self) {
        self.waiting().samples.clear();
    }

    /// Adds samples to the queue, unless it already holds half a second.
    pub fn put(&self, samples: &[f32]) {
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

#[cfg(test)]
mod tests {
    use super::*;

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
