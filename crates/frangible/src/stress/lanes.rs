//! Stress at a point at the steps of a batch, side by side.

use glam::Vec3;

use super::batch::Lanes;
use super::tensor::{Symmetric3, products};
use super::wide::wide;

/// Stress and strain energy at a point at the steps of a batch.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct StressLanes {
    /// σ, Pa: xx, yy, zz, xy, yz, zx.
    pub(super) components: [Lanes; 6],
    /// η, J/m³.
    pub(crate) energy_density: Lanes,
}

impl StressLanes {
    /// σ at step k of the batch, Pa.
    #[inline(always)]
    pub(crate) fn stress(&self, k: usize) -> Symmetric3 {
        let [xx, yy, zz, xy, yz, zx] = &self.components;
        Symmetric3::from_components([xx[k], yy[k], zz[k], xy[k], yz[k], zx[k]])
    }

    /// Adds a tension along unit `t` at each step, Pa; the energy stays.
    #[inline(always)]
    pub(crate) fn add_uniaxial(&mut self, tension: &Lanes, t: Vec3) {
        self.add(tension, products(t, t));
    }

    /// Adds another stress; the energy stays.
    pub(crate) fn add_all(&mut self, other: &Self) {
        for (lanes, others) in self.components.iter_mut().zip(&other.components) {
            for (sum, other) in lanes.iter_mut().zip(others) {
                *sum += other;
            }
        }
    }

    /// Adds so much of a tensor's components at each step, Pa; the energy stays.
    #[inline(always)]
    pub(super) fn add(&mut self, size: &Lanes, components: [f32; 6]) {
        for (lanes, component) in self.components.iter_mut().zip(components) {
            for (sum, size) in lanes.iter_mut().zip(size) {
                *sum += size * component;
            }
        }
    }

    /// Upper bounds of the largest principal tension, Pa: [`largest_eigenvalue_bound`](super::largest_eigenvalue_bound).
    #[inline(always)]
    pub(crate) fn tension_bounds(&self) -> Lanes {
        let [xx, yy, zz, xy, yz, zx] = wide(&self.components);
        let mean = (xx + yy + zz) * (1.0 / 3.0);
        let (a, b, c) = (xx - mean, yy - mean, zz - mean);
        let squares =
            (a * a + b * b + c * c) * (1.0 / 6.0) + (xy * xy + yz * yz + zx * zx) * (1.0 / 3.0);
        (mean + squares.sqrt() * 2.0).0
    }
}
