//! Stress at a point at the steps of a batch, side by side.

use glam::{Mat3, Vec3};

use super::displacement::Lanes;
use super::strain::{Symmetric3, products};
use super::wide::Wide;

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
        Symmetric3::from_components(self.components.map(|lanes| lanes[k]))
    }

    /// Adds a tension along unit `t` at each step, Pa; the energy stays.
    #[inline(always)]
    pub(crate) fn add_uniaxial(&mut self, tension: &Lanes, t: Vec3) {
        for (lanes, product) in self.components.iter_mut().zip(products(t, t)) {
            for (sum, tension) in lanes.iter_mut().zip(tension) {
                *sum += tension * product;
            }
        }
    }

    /// Qᵀ σ Q, without the energy.
    #[inline(always)]
    pub(crate) fn projected(&self, q: &Mat3) -> Self {
        let [xx, yy, zz, xy, yz, zx] = self.components.map(Wide);
        let rows = [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]];
        let columns = q.to_cols_array_2d();
        let halves = columns.map(|c| rows.map(|r| r[0] * c[0] + r[1] * c[1] + r[2] * c[2]));
        let part = |i: usize, j: usize| {
            let (half, left) = (halves[j], columns[i]);
            (half[0] * left[0] + half[1] * left[1] + half[2] * left[2]).0
        };
        Self {
            components: [
                part(0, 0),
                part(1, 1),
                part(2, 2),
                part(0, 1),
                part(1, 2),
                part(2, 0),
            ],
            energy_density: Lanes::default(),
        }
    }

    /// Upper bounds of the largest principal tension, Pa: [`largest_eigenvalue_bound`](super::largest_eigenvalue_bound).
    #[inline(always)]
    pub(crate) fn tension_bounds(&self) -> Lanes {
        let [xx, yy, zz, xy, yz, zx] = self.components.map(Wide);
        let mean = (xx + yy + zz) * (1.0 / 3.0);
        let (a, b, c) = (xx - mean, yy - mean, zz - mean);
        let squares =
            (a * a + b * b + c * c) * (1.0 / 6.0) + (xy * xy + yz * yz + zx * zx) * (1.0 / 3.0);
        (mean + squares.sqrt() * 2.0).0
    }
}
