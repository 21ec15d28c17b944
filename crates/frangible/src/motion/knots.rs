//! A motion sampled at a few of its steps, the *knots*, and the deviation of the modes from linear interpolation between them.
//!
//! Steps are a sixteenth of the period of the highest relevant mode, so the dominant motion is nearly linear between two knots.

use std::ops::RangeInclusive;

use super::Motion;
use crate::stress::{Lanes, STRIDE};

/// Most steps from one knot to the next, where the knots of the whole motion then fit in one batch. Chosen by measurement: on the smallest
/// slab of the paper's Table 1, 85 steps, one batch with gaps of six takes 1.1 ms, two batches with gaps of five 1.8 ms.
const MOST: usize = 7;

/// Steps from one knot to the next of longer motions.
const OTHERWISE: usize = 5;

/// A motion at its knots.
#[derive(Clone, Debug, Default)]
pub(crate) struct Knots {
    /// Its steps are the knots. The rest before the first step is one more, which batches have in front.
    pub(crate) motion: Motion,
    /// Steps from one knot to the next.
    gap: usize,
    /// Largest deviation of each mode from the line in each gap, m·√kg: `[gap * modes + mode]`.
    strays: Vec<f32>,
}

impl Knots {
    /// The knots of a motion, in one batch where they are not too far apart then.
    pub(crate) fn of(motion: &Motion) -> Self {
        let fits = motion.steps().div_ceil(STRIDE).max(1);
        Self::every(motion, if fits <= MOST { fits } else { OTHERWISE })
    }

    /// A knot at the end of every so many steps.
    fn every(motion: &Motion, length: usize) -> Self {
        let modes = motion.modes;
        let gaps = motion.steps().div_ceil(length);
        let mut amplitudes = Vec::with_capacity(gaps * modes);
        let mut strays = vec![0.0_f32; gaps * modes];
        let rest = vec![0.0; modes];
        let mut from = &rest[..];
        for (gap, strays) in strays.chunks_exact_mut(modes.max(1)).enumerate() {
            let last = ((gap + 1) * length).min(motion.steps()) - 1;
            let to = motion.at(last);
            for step in gap * length..last {
                let share = (step + 1 - gap * length) as f32 / (last + 1 - gap * length) as f32;
                for (i, stray) in strays.iter_mut().enumerate() {
                    let line = from[i] + (to[i] - from[i]) * share;
                    *stray = stray.max((motion.at(step)[i] - line).abs());
                }
            }
            amplitudes.extend_from_slice(to);
            from = to;
        }
        Self {
            motion: Motion::new(amplitudes, modes, 0.0, 0.0),
            gap: length,
            strays,
        }
    }

    /// The batch of knots that a batch of the motion's steps lies in, and the lanes of the gaps that hold those steps.
    pub(crate) fn about(&self, batch: usize) -> (usize, RangeInclusive<usize>) {
        let [first, last] = [batch * STRIDE, (batch + 1) * STRIDE - 1].map(|step| step / self.gap);
        let of_knots = first / STRIDE;
        let lane = |gap: usize| (gap - of_knots * STRIDE + 1).min(STRIDE);
        (of_knots, lane(first)..=lane(last))
    }

    /// Largest deviation of each mode from the line in the gaps of a batch of knots, m·√kg: lane k is the gap that ends with the knot of lane k.
    pub(crate) fn strays(&self, batch: usize) -> Vec<Lanes> {
        let modes = self.motion.modes;
        let mut lanes = vec![Lanes::default(); modes];
        let gaps = self.strays.chunks_exact(modes.max(1));
        for (k, gap) in (1..).zip(gaps.skip(batch * STRIDE).take(STRIDE)) {
            for (lanes, stray) in lanes.iter_mut().zip(gap) {
                lanes[k] = *stray;
            }
        }
        lanes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn modes_stray_from_the_lines_between_knots_as_far_as_they_say() {
        // One mode bends, the other does not; the last gap is shorter.
        let at = |step: usize| [(step as f32 + 1.0).powi(2), 3.0 * (step as f32 + 1.0)];
        let motion = Motion::new((0..12).flat_map(at).collect(), 2, 0.0, 0.0);
        let knots = Knots::every(&motion, 5);
        assert_eq!(
            knots.motion.amplitudes,
            [[25.0, 15.0], [100.0, 30.0], [144.0, 36.0]].concat()
        );
        let [bent, straight] = <[Lanes; 2]>::try_from(knots.strays(0)).unwrap();
        // t² is t (T − t) from its chord over T: 6 of 2 · 3, and 1 of 1 · 1.
        for (stray, expected) in bent.iter().zip([0.0, 6.0, 6.0, 1.0, 0.0]) {
            assert!((stray - expected).abs() < 1e-4, "{bent:?}");
        }
        assert!(straight.iter().all(|&stray| stray < 1e-4), "{straight:?}");
    }

    #[test]
    fn every_step_of_a_batch_lies_in_the_gaps_about_it() {
        for steps in [31, 58, 85, 105, 106, 400] {
            let knots = Knots::of(&Motion::new(vec![0.0; steps], 1, 0.0, 0.0));
            for step in 0..steps {
                let (batch, lanes) = knots.about(step / STRIDE);
                let knot = step / knots.gap;
                assert_eq!(knot / STRIDE, batch, "step {step} of {steps}");
                assert!(
                    lanes.contains(&(knot % STRIDE + 1)),
                    "step {step} of {steps}"
                );
            }
        }
    }
}
