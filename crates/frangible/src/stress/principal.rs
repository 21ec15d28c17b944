//! Principal values and axes of a symmetric 3 × 3 tensor.

use glam::{DVec3, Vec3};

use super::Symmetric3;
use crate::mesh::symmetric_eigen;

/// Bounds are compared with the strength less this share: the rounding of the bound itself.
pub(crate) const MARGIN: f32 = 1e-4;

/// Stress bound below which no point reaches its strength if the smallest strength is this one, Pa.
pub(crate) fn limit(strength: f32) -> f32 {
    strength * (1.0 - MARGIN)
}

/// Largest eigenvalue in closed form (the trigonometric solution of the cubic), to about 1e-6 of the tensor's norm.
#[must_use]
pub fn largest_eigenvalue(s: &Symmetric3) -> f32 {
    let ([xx, yy, zz], [xy, yz, zx]) = (s.diagonal, s.off);
    let mean = (xx + yy + zz) / 3.0;
    let (a, b, c) = (xx - mean, yy - mean, zz - mean);
    let p2 = (a * a + b * b + c * c) / 6.0 + (xy * xy + yz * yz + zx * zx) / 3.0;
    let p = p2.sqrt();
    if p <= f32::MIN_POSITIVE {
        return mean;
    }
    let determinant = a * (b * c - yz * yz) - xy * (xy * c - yz * zx) + zx * (xy * yz - b * zx);
    let half = (determinant / (2.0 * p * p2)).clamp(-1.0, 1.0);
    mean + 2.0 * p * libm::cosf(libm::acosf(half) / 3.0)
}

/// An upper bound of the largest eigenvalue without trigonometry: mean + 2 p, reached where the two smaller are equal.
#[inline(always)]
#[must_use]
pub fn largest_eigenvalue_bound(s: &Symmetric3) -> f32 {
    let ([xx, yy, zz], [xy, yz, zx]) = (s.diagonal, s.off);
    let mean = (xx + yy + zz) / 3.0;
    let (a, b, c) = (xx - mean, yy - mean, zz - mean);
    mean + 2.0 * ((a * a + b * b + c * c) / 6.0 + (xy * xy + yz * yz + zx * zx) / 3.0).sqrt()
}

/// Principal values, falling, and their unit axes, in f64.
#[must_use]
pub fn principal_axes(s: &Symmetric3) -> ([f64; 3], [DVec3; 3]) {
    let (values, axes) = symmetric_eigen(s.to_mat3().as_dmat3());
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| values[j].total_cmp(&values[i]).then(i.cmp(&j)));
    (
        order.map(|i| values[i]),
        order.map(|i| oriented(axes.col(i).normalize())),
    )
}

/// The sign with the largest component positive: an axis has none of its own.
fn oriented(v: DVec3) -> DVec3 {
    let a = v.abs();
    let largest = if a.x >= a.y && a.x >= a.z {
        v.x
    } else if a.y >= a.z {
        v.y
    } else {
        v.z
    };
    if largest < 0.0 { -v } else { v }
}

/// Two unit vectors perpendicular to unit `n` and to each other, by a fixed rule.
#[must_use]
pub(crate) fn perpendicular_axes(n: Vec3) -> (Vec3, Vec3) {
    let a = n.abs();
    let helper = if a.x <= a.y && a.x <= a.z {
        Vec3::X
    } else if a.y <= a.z {
        Vec3::Y
    } else {
        Vec3::Z
    };
    let first = n.cross(helper).normalize();
    (first, first.cross(n))
}
