//! One number for each time step of a batch, side by side: loops that a compiler turns into vector instructions.

use std::ops::{Add, Mul, Sub};

use super::displacement::{BATCH, Lanes};
use super::tensor::Real;

/// Numbers that [`dot`] multiplies side by side.
const WIDTH: usize = 16;

/// Σ a_i b_i, in lanes that a compiler turns into vector instructions: call it from a place that `pulp` dispatches.
#[inline(always)]
pub(crate) fn dot(a: &[f32], b: &[f32]) -> f32 {
    let ((a, a_tail), (b, b_tail)) = (a.as_chunks::<WIDTH>(), b.as_chunks::<WIDTH>());
    let mut sums = [0.0_f32; WIDTH];
    for (a, b) in a.iter().zip(b) {
        for k in 0..WIDTH {
            sums[k] += a[k] * b[k];
        }
    }
    let mut sum = 0.0;
    for (a, b) in a_tail.iter().zip(b_tail) {
        sum += a * b;
    }
    for lane in sums {
        sum += lane;
    }
    sum
}

/// A value at each of a batch's steps.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Wide(pub(crate) Lanes);

impl Wide {
    #[inline(always)]
    pub(crate) fn sqrt(self) -> Self {
        self.with(self, |a, _| a.sqrt())
    }
}

impl Add for Wide {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.with(other, |a, b| a + b)
    }
}

impl Sub for Wide {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.with(other, |a, b| a - b)
    }
}

impl Mul for Wide {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.with(other, |a, b| a * b)
    }
}

impl Mul<f32> for Wide {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: f32) -> Self {
        self.with(Self([factor; BATCH]), |a, b| a * b)
    }
}
