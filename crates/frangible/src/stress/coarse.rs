//! A few shapes in place of all modes.
//!
//! Neighbouring points move alike, so few of the rows of a cluster are independent of the others: all of them are nearly sums of a few
//! *shapes*. The stress of the shapes is cheap, and what they leave out is bounded mode by mode. Most points that a blow makes one look at
//! are far below their strength, and this is enough to know it.

use super::batch::{BATCH, Lanes};
use super::frame::Frame;
use super::rows::Rows;

/// Number of shapes that are added at a time.
const STEP: usize = 6;

/// The shapes are enough when they leave out no more than this share of what the modes of an impulse could add up to.
const ENOUGH: f32 = 0.02;

/// Least number of modes, and of rows, to each shape. With more shapes it costs too much that a point in doubt is computed twice.
const WORTH: usize = 4;

/// Rounding, relative to what the modes could add up to.
const ROUNDING: f32 = 1e-5;

/// Shapes of the rows of a cluster.
#[derive(Debug)]
pub(crate) struct Coarse {
    /// Coefficient of each shape in each mode.
    shapes: Rows,
    /// The cluster's rows, of the shapes.
    rows: Rows,
    /// Largest stress of each mode that the shapes leave out at any point, Pa per m·√kg.
    rest: Vec<f32>,
}

impl Coarse {
    /// The shapes of the rows of a cluster's points; `periods`: amplitude of each mode under an impulse, in any unit. None where few shapes are not
    /// enough.
    pub(crate) fn new(frames: &[Frame], rows: &Rows, periods: &[f32]) -> Option<Self> {
        find(frames, rows, periods)
    }

    #[inline(always)]
    fn found(frames: &[Frame], rows: &Rows, periods: &[f32]) -> Option<Self> {
        let modes = periods.len();
        let count: usize = frames.iter().map(|f| f.count()).sum();
        // Rows of what an impulse may bring, less what the shapes found so far have of them.
        let mut left: Vec<f32> = Vec::with_capacity(count * modes);
        for row in 0..count {
            left.extend(rows.row(row).zip(periods).map(|(s, p)| s * p));
        }
        let largest = largest(frames, &left, modes);
        let most: f32 = largest.iter().sum();
        let mut shapes: Vec<f32> = Vec::new();
        let mut shares: Vec<f32> = Vec::new();
        for found in (STEP..=modes.min(count) / WORTH).step_by(STEP) {
            for _ in 0..STEP {
                let (shape, of_rows) = next_shape(&mut left, modes)?;
                shapes.extend(shape);
                shares.extend(of_rows);
            }
            let rest = self::largest(frames, &left, modes);
            if rest.iter().sum::<f32>() > ENOUGH * most {
                continue;
            }
            let by_mode = |(i, shape): (usize, &f32)| shape / periods[i % modes];
            let shapes: Vec<f32> = shapes.iter().enumerate().map(by_mode).collect();
            let rest = rest.iter().zip(&largest).zip(periods);
            return Some(Self {
                shapes: Rows::of(modes, shapes.chunks_exact(modes).map(<[f32]>::to_vec)),
                rows: Rows::of(
                    found,
                    (0..count).map(|row| (0..found).map(|k| shares[k * count + row]).collect()),
                ),
                rest: rest.map(|((r, s), p)| (r + ROUNDING * s) / p).collect(),
            });
        }
        None
    }

    /// Adds the rows, as the shapes have them, times the amplitudes of the first modes, m·√kg; returns bounds of what is left out, Pa.
    #[inline(always)]
    pub(crate) fn add(
        &self,
        amplitudes: &[Lanes],
        room: &mut Vec<Lanes>,
        sums: &mut [Lanes],
    ) -> Lanes {
        room.clear();
        room.resize(self.shapes.padded(), [0.0; BATCH]);
        self.shapes.add(amplitudes, room);
        self.rows.add(&room[..self.rows.modes()], sums);
        let mut left_out = [0.0; BATCH];
        for (q, rest) in amplitudes.iter().zip(&self.rest) {
            for (sum, q) in left_out.iter_mut().zip(q) {
                *sum += q.abs() * rest;
            }
        }
        left_out
    }
}

widest! {
    /// Looks for shapes.
    fn find(frames: &[Frame], rows: &Rows, periods: &[f32]) -> Option<Coarse> {
        Coarse::found(frames, rows, periods)
    }
}

/// Takes the largest row's direction out of all rows: the direction, and its coefficient in each row. None where nothing is left.
#[inline(always)]
fn next_shape(left: &mut [f32], modes: usize) -> Option<(Vec<f32>, Vec<f32>)> {
    let (mut row, mut square) = (0, 0.0);
    for (i, other) in left.chunks_exact(modes).enumerate() {
        let others = super::dot(other, other);
        if others > square {
            (row, square) = (i, others);
        }
    }
    if square <= f32::MIN_POSITIVE {
        return None;
    }
    let scale = 1.0 / square.sqrt();
    let shape: Vec<f32> = left[row * modes..][..modes]
        .iter()
        .map(|x| x * scale)
        .collect();
    let mut shares = Vec::with_capacity(left.len() / modes);
    for row in left.chunks_exact_mut(modes) {
        let share = super::dot(row, &shape);
        for (x, s) in row.iter_mut().zip(&shape) {
            *x -= share * s;
        }
        shares.push(share);
    }
    Some((shape, shares))
}

/// The largest norm of a point's stress in each mode: no principal value is larger.
#[inline(always)]
fn largest(frames: &[Frame], rows: &[f32], modes: usize) -> Vec<f32> {
    let mut largest = vec![0.0_f32; modes];
    let mut squares = vec![0.0_f32; modes];
    let mut rows = rows.chunks_exact(modes);
    for frame in frames {
        squares.fill(0.0);
        for (number, row) in rows.by_ref().take(frame.count()).enumerate() {
            let weight = frame.weight(number);
            for (square, x) in squares.iter_mut().zip(row) {
                *square += weight * x * x;
            }
        }
        for (largest, square) in largest.iter_mut().zip(&squares) {
            *largest = largest.max(*square);
        }
    }
    largest.iter_mut().for_each(|x| *x = x.sqrt());
    largest
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::rng::{Purpose, stream, uniform};

    #[test]
    fn what_shapes_leave_out_of_any_point_is_bounded() {
        const MODES: usize = 48;
        let mut rng = stream(3, Purpose::WeakPoints, 0);
        let mut number = || 2.0 * uniform(&mut rng) as f32 - 1.0;
        let frames: Vec<Frame> = (0..40)
            .map(|i| match i % 3 {
                0 => Frame::Surface([Vec3::X, Vec3::Y]),
                1 => Frame::Edge(Vec3::Z),
                _ => Frame::Space,
            })
            .collect();
        let count: usize = frames.iter().map(|f| f.count()).sum();
        // Rows of few shapes, nearly.
        let shapes: Vec<Vec<f32>> = (0..4)
            .map(|_| (0..MODES).map(|_| number()).collect())
            .collect();
        let rows: Vec<Vec<f32>> = (0..count)
            .map(|_| {
                let shares: Vec<f32> = (0..4).map(|_| 1e9 * number()).collect();
                let of = |m: usize| -> f32 { (0..4).map(|k| shares[k] * shapes[k][m]).sum() };
                (0..MODES).map(|m| of(m) + 1e6 * number()).collect()
            })
            .collect();
        let rows = Rows::of(MODES, rows.into_iter());
        let periods: Vec<f32> = (0..MODES).map(|m| 1e-3 / (m + 1) as f32).collect();
        let coarse = Coarse::new(&frames, &rows, &periods).unwrap();
        let amplitudes: Vec<Lanes> = periods
            .iter()
            .map(|p| std::array::from_fn(|_| p * number()))
            .collect();
        let mut exact = vec![[0.0; BATCH]; rows.padded()];
        let mut found = exact.clone();
        rows.add(&amplitudes, &mut exact);
        let left_out = coarse.add(&amplitudes, &mut Vec::new(), &mut found);
        let (mut row, mut tightest) = (0, f32::INFINITY);
        for frame in &frames {
            for k in 0..BATCH {
                let apart = (0..frame.count()).map(|i| {
                    let apart = exact[row + i][k] - found[row + i][k];
                    frame.weight(i) * apart * apart
                });
                let apart = apart.sum::<f32>().sqrt();
                assert!(apart <= left_out[k], "{frame:?}: {apart} {}", left_out[k]);
                tightest = tightest.min(left_out[k] / apart);
            }
            row += frame.count();
        }
        assert!(tightest < 20.0, "{tightest}");
    }
}
