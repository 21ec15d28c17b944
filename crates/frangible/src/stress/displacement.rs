//! u = Φ q on the coarse nodes, several time steps at a time; gradients anywhere from ten nodes.

use glam::{Mat3, Vec3};

use crate::asset::{Asset, EmbeddedPoint};
use crate::modal::Motion;

/// Steps multiplied at once: Φ is read from memory once for all of them.
pub(super) const BATCH: usize = 8;

/// Values and gradients of the ten quadratic shape functions at a point of the body.
#[derive(Clone, Copy, Debug)]
pub struct ShapeWeights;

/// Corner pairs of the six mid-edge nodes.
const MID_EDGES: [[usize; 2]; 6] = [[0, 1], [1, 2], [0, 2], [0, 3], [1, 3], [2, 3]];

impl ShapeWeights {
    /// N_a at the embedded point's closest point of the element.
    #[must_use]
    pub fn values(point: &EmbeddedPoint) -> [f32; 10] {
        let l = point.barycentric;
        std::array::from_fn(|a| {
            if a < 4 {
                l[a] * (2.0 * l[a] - 1.0)
            } else {
                let [i, j] = MID_EDGES[a - 4];
                4.0 * l[i] * l[j]
            }
        })
    }

    /// ∇N_a there, 1/m.
    #[must_use]
    pub fn gradients(point: &EmbeddedPoint, barycentric_gradients: &[Vec3; 4]) -> [Vec3; 10] {
        let (l, g) = (point.barycentric, barycentric_gradients);
        std::array::from_fn(|a| {
            if a < 4 {
                g[a] * (4.0 * l[a] - 1.0)
            } else {
                let [i, j] = MID_EDGES[a - 4];
                (g[j] * l[i] + g[i] * l[j]) * 4.0
            }
        })
    }
}

/// Displacements of the coarse nodes at a few consecutive steps.
#[derive(Clone, Debug)]
pub struct DisplacementBatch {
    first: usize,
    steps: usize,
    /// `displacements[node * BATCH + step]`, m.
    displacements: Vec<Vec3>,
}

impl DisplacementBatch {
    /// Empty, for an asset.
    #[must_use]
    pub fn new(asset: &Asset) -> Self {
        Self {
            first: 0,
            steps: 0,
            displacements: vec![Vec3::ZERO; asset.analysis.nodes.len() * BATCH],
        }
    }

    /// Makes sure that `step` is held, computing a batch from it when it is not.
    pub fn seek(&mut self, asset: &Asset, motion: &Motion, step: usize) {
        if (self.first..self.first + self.steps).contains(&step) {
            return;
        }
        self.first = step;
        self.steps = BATCH.min(motion.steps() - step);
        // Transposed amplitudes: the inner loop runs over the batch, so that it vectorises.
        let modes = motion.modes;
        let mut amplitudes = vec![[0.0_f32; BATCH]; modes];
        for k in 0..self.steps {
            for (i, row) in amplitudes.iter_mut().enumerate() {
                row[k] = motion.amplitudes[(step + k) * modes + i];
            }
        }
        for (node, out) in self.displacements.chunks_exact_mut(BATCH).enumerate() {
            let mut sums = [[0.0_f32; BATCH]; 3];
            for (axis, sum) in sums.iter_mut().enumerate() {
                // High modes first: they move little, so that the sum is large, and rounds, only at the end.
                let row = asset.modes.row(3 * node + axis).iter();
                for (&phi, q) in row.zip(&amplitudes).rev() {
                    for k in 0..BATCH {
                        sum[k] += phi * q[k];
                    }
                }
            }
            for k in 0..BATCH {
                out[k] = Vec3::new(sums[0][k], sums[1][k], sums[2][k]);
            }
        }
    }

    /// ∇u at an embedded point, column j = ∂u/∂x_j; the step must be held.
    #[must_use]
    pub fn gradient(&self, asset: &Asset, point: &EmbeddedPoint, step: usize) -> Mat3 {
        let k = step - self.first;
        let element = point.element as usize;
        let gradients =
            ShapeWeights::gradients(point, &asset.analysis.barycentric_gradients[element]);
        let mut sum = Mat3::ZERO;
        for (&node, g) in asset.analysis.elements[element].iter().zip(gradients) {
            let u = self.displacements[node as usize * BATCH + k];
            sum.x_axis += u * g.x;
            sum.y_axis += u * g.y;
            sum.z_axis += u * g.z;
        }
        sum
    }
}
