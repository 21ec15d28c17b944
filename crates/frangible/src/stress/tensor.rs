//! Symmetric 3 × 3 tensors, of numbers or of one number for each step of a batch.

use std::ops::{Add, Mul, Sub};

use glam::{Mat3, Vec3};

use super::batch::BATCH;
use super::wide::Wide;

/// Symmetric 3 × 3 tensor.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Symmetric3 {
    /// xx, yy, zz.
    pub diagonal: [f32; 3],
    /// xy, yz, zx.
    pub off: [f32; 3],
}

impl Symmetric3 {
    /// xx, yy, zz, xy, yz, zx.
    #[inline(always)]
    pub(super) fn components(self) -> [f32; 6] {
        let ([xx, yy, zz], [xy, yz, zx]) = (self.diagonal, self.off);
        [xx, yy, zz, xy, yz, zx]
    }

    #[inline(always)]
    pub(super) fn from_components([xx, yy, zz, xy, yz, zx]: [f32; 6]) -> Self {
        Self {
            diagonal: [xx, yy, zz],
            off: [xy, yz, zx],
        }
    }

    /// The full matrix of the tensor.
    #[must_use]
    pub fn to_mat3(self) -> Mat3 {
        let ([xx, yy, zz], [xy, yz, zx]) = (self.diagonal, self.off);
        Mat3::from_cols(
            Vec3::new(xx, xy, zx),
            Vec3::new(xy, yy, yz),
            Vec3::new(zx, yz, zz),
        )
    }

    /// The symmetric part of a matrix.
    #[must_use]
    pub fn from_mat3(m: Mat3) -> Self {
        Self {
            diagonal: [m.x_axis.x, m.y_axis.y, m.z_axis.z],
            off: [
                0.5 * (m.x_axis.y + m.y_axis.x),
                0.5 * (m.y_axis.z + m.z_axis.y),
                0.5 * (m.z_axis.x + m.x_axis.z),
            ],
        }
    }

    /// Tension along unit `t`, Pa.
    #[must_use]
    pub fn uniaxial(tension: f32, t: Vec3) -> Self {
        Self::from_components(uniaxial(tension, t))
    }

    /// The tensor times a number.
    #[must_use]
    pub fn scaled(&self, factor: f32) -> Self {
        Self::from_components(self.components().map(|c| c * factor))
    }

    /// The sum of two tensors.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        let (a, b) = (self.components(), other.components());
        Self::from_components(std::array::from_fn(|i| a[i] + b[i]))
    }

    /// The tensor times a vector.
    #[must_use]
    pub fn times(self, v: Vec3) -> Vec3 {
        Vec3::from_array(times(&self.components(), v))
    }
}

/// a_x b_x, a_y b_y, a_z b_z, and the halves of a b + b a off the diagonal: xy, yz, zx.
#[inline(always)]
pub(super) fn products(a: Vec3, b: Vec3) -> [f32; 6] {
    [
        a.x * b.x,
        a.y * b.y,
        a.z * b.z,
        0.5 * (a.x * b.y + a.y * b.x),
        0.5 * (a.y * b.z + a.z * b.y),
        0.5 * (a.z * b.x + a.x * b.z),
    ]
}

/// a b + b a: twice what [`products`] gives.
#[inline(always)]
pub(super) fn mixed_products(a: Vec3, b: Vec3) -> [f32; 6] {
    let [xx, yy, zz, xy, yz, zx] = products(a, b);
    [2.0 * xx, 2.0 * yy, 2.0 * zz, 2.0 * xy, 2.0 * yz, 2.0 * zx]
}

/// E n.
#[inline(always)]
pub(super) fn times<T: Real>(e: &[T; 6], n: Vec3) -> [T; 3] {
    let [xx, yy, zz, xy, yz, zx] = *e;
    [
        xx * n.x + xy * n.y + zx * n.z,
        xy * n.x + yy * n.y + yz * n.z,
        zx * n.x + yz * n.y + zz * n.z,
    ]
}

/// t·E t.
#[inline(always)]
pub(super) fn stretch<T: Real>(e: &[T; 6], t: Vec3) -> T {
    let [x, y, z] = times(e, t);
    x * t.x + y * t.y + z * t.z
}

/// Tension along unit `t`.
#[inline(always)]
pub(super) fn uniaxial<T: Real>(tension: T, t: Vec3) -> [T; 6] {
    let [xx, yy, zz, xy, yz, zx] = products(t, t);
    [
        tension * xx,
        tension * yy,
        tension * zz,
        tension * xy,
        tension * yz,
        tension * zx,
    ]
}

/// P E P, P = I − n nᵀ: E − n mᵀ − m nᵀ + (n·m) n nᵀ with m = E n.
#[inline(always)]
pub(super) fn tangential<T: Real>(e: &[T; 6], n: Vec3) -> [T; 6] {
    let [x, y, z] = times(e, n);
    let across = x * n.x + y * n.y + z * n.z;
    let [xx, yy, zz, xy, yz, zx] = *e;
    [
        xx - (x * 2.0 - across * n.x) * n.x,
        yy - (y * 2.0 - across * n.y) * n.y,
        zz - (z * 2.0 - across * n.z) * n.z,
        xy - y * n.x - x * n.y + across * (n.x * n.y),
        yz - z * n.y - y * n.z + across * (n.y * n.z),
        zx - x * n.z - z * n.x + across * (n.z * n.x),
    ]
}

/// ½ σ : E.
#[inline(always)]
pub(super) fn half_product<T: Real>(s: &[T; 6], e: &[T; 6]) -> T {
    (s[0] * e[0] + s[1] * e[1] + s[2] * e[2]) * 0.5 + (s[3] * e[3] + s[4] * e[4] + s[5] * e[5])
}

/// ½ a · b.
#[inline(always)]
pub(super) fn half_dot<T: Real>(a: &[T; 3], b: &[T; 3]) -> T {
    (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) * 0.5
}

/// A number, or one for each step of a batch: the same operations in the same order.
pub(crate) trait Real:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Mul<f32, Output = Self>
{
    /// A function of two numbers, step by step.
    fn with(self, other: Self, f: impl Fn(f32, f32) -> f32) -> Self;
}

impl Real for f32 {
    #[inline(always)]
    fn with(self, other: Self, f: impl Fn(f32, f32) -> f32) -> Self {
        f(self, other)
    }
}

impl Real for Wide {
    #[inline(always)]
    fn with(self, other: Self, f: impl Fn(f32, f32) -> f32) -> Self {
        let mut out = [0.0; BATCH];
        // No iterators over arrays: compiled for the plain processor, they were calls.
        for k in 0..BATCH {
            out[k] = f(self.0[k], other.0[k]);
        }
        Self(out)
    }
}
