//! One number for each time step of a batch, side by side: loops that a compiler turns into vector instructions.

use std::ops::{Add, Mul, Sub};

use glam::Vec3;

use super::batch::{BATCH, Lanes};
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

/// The length of a vector. (Where another crate has `glam` take `libm`, as Rapier does, its own is an instruction of the plain processor,
/// which waits for all vectors about it: on some processors that takes longer than all else that is done for a crack.)
#[inline(always)]
pub(crate) fn length(v: Vec3) -> f32 {
    v.length_squared().sqrt()
}

/// A value at each of a batch's steps.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Wide(pub(crate) Lanes);

/// The components of a tensor at each of a batch's steps. (`array::map` is no way to write this where time counts: of arrays that large it
/// becomes a call, made for the plain processor, with copies to and fro.)
#[inline(always)]
pub(crate) fn wide([a, b, c, d, e, f]: &[Lanes; 6]) -> [Wide; 6] {
    [Wide(*a), Wide(*b), Wide(*c), Wide(*d), Wide(*e), Wide(*f)]
}

/// The inverse of [`wide`].
#[inline(always)]
pub(crate) fn narrow([a, b, c, d, e, f]: [Wide; 6]) -> [Lanes; 6] {
    [a.0, b.0, c.0, d.0, e.0, f.0]
}

impl Wide {
    #[inline(always)]
    pub(crate) fn sqrt(self) -> Self {
        self.with(self, |a, _| a.sqrt())
    }

    /// The largest of its numbers, none of which is NaN.
    #[inline(always)]
    pub(crate) fn largest(self) -> f32 {
        let mut lanes = self.0;
        let mut half = BATCH / 2;
        while half > 0 {
            for k in 0..half {
                let other = lanes[k + half];
                lanes[k] = if other > lanes[k] { other } else { lanes[k] };
            }
            half /= 2;
        }
        lanes[0]
    }

    /// self + factor × other. Sums that are kept in variables of their own, rather than in an array that is indexed, stay in vector
    /// registers whatever their width: that is several times as fast.
    #[inline(always)]
    pub(crate) fn plus(self, factor: f32, other: &Lanes) -> Self {
        let mut sum = self.0;
        for k in 0..BATCH {
            sum[k] += factor * other[k];
        }
        Self(sum)
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
