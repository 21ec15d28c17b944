//! A shape of the body that follows a force.

use std::sync::OnceLock;

use super::wide::dot;
use crate::asset::Asset;

/// Nodes that are computed together: their rows lie one behind another, and nodes nearby are asked for soon.
const BLOCK: usize = 16;

/// Displacements of the analysis nodes per newton, computed block by block when one of its nodes is first asked for.
#[derive(Debug)]
pub(crate) struct Shape {
    /// Displacements of each block once they are known, m/N.
    blocks: Box<[OnceLock<[[f32; 3]; BLOCK]>]>,
    /// ξ_i/λ_i of the modes that it is made of, the last of the body, m·√kg/N.
    pub(crate) amplitudes: Vec<f32>,
}

impl Shape {
    /// The shape of these amplitudes of the last modes of an asset, m·√kg/N.
    pub(crate) fn new(asset: &Asset, amplitudes: Vec<f32>) -> Self {
        let blocks = asset.analysis.nodes.len().div_ceil(BLOCK);
        Self {
            blocks: (0..blocks).map(|_| OnceLock::new()).collect(),
            amplitudes,
        }
    }

    /// Displacement of a node of the asset that it was made for, m/N.
    #[inline]
    pub(crate) fn at(&self, asset: &Asset, node: usize) -> [f32; 3] {
        let block = self.blocks[node / BLOCK]
            .get_or_init(|| dots(asset, node / BLOCK * BLOCK, &self.amplitudes));
        block[node % BLOCK]
    }
}

widest! {
    /// Products of the rows of a block of nodes with some amplitudes.
    fn dots(asset: &Asset, first: usize, amplitudes: &[f32]) -> [[f32; 3]; BLOCK] {
        let modes = &asset.modes;
        let skipped = modes.count() - amplitudes.len();
        let nodes = asset.analysis.nodes.len();
        let mut block = [[0.0; 3]; BLOCK];
        for (node, to) in (first..nodes).zip(&mut block) {
            for (axis, to) in to.iter_mut().enumerate() {
                *to = dot(&modes.row(3 * node + axis)[skipped..], amplitudes);
            }
        }
        block
    }
}
