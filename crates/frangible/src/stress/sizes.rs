//! Largest stress of each mode at each point of a cluster.
//!
//! The largest tension of a sum of stresses is no more than the sum of their sizes. Where modes move little, that is enough to know that a
//! point holds at all steps of a batch, for a small part of what its stress takes: one number for a mode in place of three rows at sixteen steps.

use super::frame::{Frame, MOST};
use super::rows::Rows;

/// Rounding of the sums, relative to what the modes could add up to.
const ROUNDING: f32 = 1e-4;

/// The largest tension or pressure of each mode at each point of a cluster.
#[derive(Debug)]
pub(crate) struct Sizes {
    /// Pa per m·√kg: `[mode, from the lowest][point]`.
    numbers: Vec<f32>,
    points: usize,
}

impl Sizes {
    /// Sizes of the rows of points with these frames.
    pub(crate) fn new(frames: &[Frame], rows: &Rows) -> Self {
        let points = frames.len();
        let mut sizes = Self {
            numbers: vec![0.0; points * rows.modes()],
            points,
        };
        let mut first = 0;
        for (point, frame) in frames.iter().enumerate() {
            let count = frame.count();
            let mut of_mode = vec![[0.0; MOST]; rows.modes()];
            for number in 0..count {
                for (to, from) in of_mode.iter_mut().zip(rows.row(first + number)) {
                    to[number] = from;
                }
            }
            for (mode, numbers) in of_mode.iter().enumerate() {
                let size = frame.size(&numbers[..count]);
                sizes.numbers[mode * points + point] = (1.0 + ROUNDING) * size;
            }
            first += count;
        }
        sizes
    }

    /// Bounds of the tension at each point, Pa, where the first modes move no farther than this, m·√kg.
    #[inline(always)]
    pub(crate) fn bounds(&self, farthest: &[f32], bounds: &mut Vec<f32>) {
        bounds.clear();
        bounds.resize(self.points, 0.0);
        let sizes = self.numbers.chunks_exact(self.points.max(1));
        for (far, sizes) in farthest.iter().zip(sizes) {
            for (bound, size) in bounds.iter_mut().zip(sizes) {
                *bound += far * size;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::rng::{Purpose, stream, uniform};
    use crate::stress::{BATCH, Lanes};

    #[test]
    fn no_tension_is_larger_than_its_bound_and_one_mode_reaches_it() {
        const MODES: usize = 20;
        let mut rng = stream(7, Purpose::WeakPoints, 0);
        let mut number = || 2.0 * uniform(&mut rng) as f32 - 1.0;
        let frames = [
            Frame::Surface([Vec3::X, Vec3::Y]),
            Frame::Edge(Vec3::Z),
            Frame::Space,
        ];
        let count: usize = frames.iter().map(|f| f.count()).sum();
        let all: Vec<Vec<f32>> = (0..count)
            .map(|_| (0..MODES).map(|_| number()).collect())
            .collect();
        let rows = Rows::of(MODES, all.into_iter());
        let sizes = Sizes::new(&frames, &rows);
        let tension = |amplitudes: &[Lanes]| {
            let mut sums = vec![[0.0; BATCH]; rows.padded()];
            rows.add(amplitudes, &mut sums);
            let mut first = 0;
            frames.map(|frame| {
                let numbers = &sums[first..first + frame.count()];
                first += frame.count();
                let stress = frame.stress(numbers);
                let at = |k| crate::stress::largest_eigenvalue(&stress.stress(k));
                std::array::from_fn::<f32, BATCH, _>(at)
            })
        };
        let mut bounds = Vec::new();
        for alone in 0..=MODES {
            // One mode by itself, or all of them.
            let amplitudes: Vec<Lanes> = (0..MODES)
                .map(|mode| {
                    std::array::from_fn(|_| match alone == MODES || alone == mode {
                        true => number(),
                        false => 0.0,
                    })
                })
                .collect();
            let farthest = amplitudes
                .iter()
                .map(|q| q.iter().fold(0.0_f32, |a, q| a.max(q.abs())));
            sizes.bounds(&farthest.collect::<Vec<_>>(), &mut bounds);
            for (most, bound) in tension(&amplitudes).into_iter().zip(&bounds) {
                assert!(most.iter().all(|t| t <= bound), "{alone}: {most:?} {bound}");
            }
        }
    }
}
