//! A shape of the body that follows a force.

use std::sync::OnceLock;

use super::wide::dot;
use crate::asset::Asset;

/// Displacements of the analysis nodes per newton, each computed when it is first asked for.
#[derive(Debug)]
pub(crate) struct Shape {
    /// What they are once they are known, m/N.
    pub(crate) nodes: Box<[OnceLock<[f32; 3]>]>,
    /// ξ_i/λ_i of the modes that it is made of, the last of the body, m·√kg/N.
    pub(crate) amplitudes: Vec<f32>,
}

impl Shape {
    /// Displacement of a node of the asset that it was made for, m/N.
    #[inline]
    pub(crate) fn at(&self, asset: &Asset, node: usize) -> [f32; 3] {
        *self.nodes[node].get_or_init(|| {
            let first = asset.modes.count() - self.amplitudes.len();
            let rows = [0, 1, 2].map(|axis| &asset.modes.row(3 * node + axis)[first..]);
            // With the widest vectors that this processor has; the same operations in the same order, so the same bits.
            pulp::Arch::new().dispatch(Dots {
                rows,
                amplitudes: &self.amplitudes,
            })
        })
    }
}

/// What a node's rows have of some amplitudes.
struct Dots<'a> {
    rows: [&'a [f32]; 3],
    amplitudes: &'a [f32],
}

impl pulp::NullaryFnOnce for Dots<'_> {
    type Output = [f32; 3];

    #[inline(always)]
    fn call(self) -> [f32; 3] {
        let [x, y, z] = self.rows;
        [
            dot(x, self.amplitudes),
            dot(y, self.amplitudes),
            dot(z, self.amplitudes),
        ]
    }
}
