//! Displacements u = Φ q of the coarse nodes at one time step, for growing cracks, which need few points at few steps each.

use glam::{Mat3, Vec3};

use super::Motion;
use crate::asset::{Asset, EmbeddedPoint};
use crate::stress::dot;

/// Displacements of the coarse nodes at one time step, each node computed when it is first asked for.
#[derive(Clone, Debug, Default)]
pub(crate) struct Moment {
    /// Displacement of each node, m, and its time step, counted from 1; empty before the first use.
    nodes: Vec<(Vec3, u32)>,
}

impl Moment {
    /// ∇u at an embedded point at a time step, column j = ∂u/∂x_j.
    pub(crate) fn gradient(
        &mut self,
        asset: &Asset,
        motion: &Motion,
        point: &EmbeddedPoint,
        step: usize,
    ) -> Mat3 {
        self.begin(asset);
        let element = point.element as usize;
        let gradients = point.shape_gradients(&asset.analysis.barycentric_gradients[element]);
        let nodes = &asset.analysis.elements[element];
        compute(self, asset, motion, nodes, step);
        // The gradients of the shape functions add up to nothing: what all nodes share only costs digits.
        let shared = self.nodes[nodes[0] as usize].0;
        let mut sum = Mat3::ZERO;
        for (&node, g) in nodes.iter().zip(gradients).skip(1) {
            let u = self.nodes[node as usize].0 - shared;
            sum.x_axis += u * g.x;
            sum.y_axis += u * g.y;
            sum.z_axis += u * g.z;
        }
        sum
    }

    fn begin(&mut self, asset: &Asset) {
        if self.nodes.is_empty() {
            self.nodes
                .resize(asset.analysis.nodes.len(), (Vec3::ZERO, 0));
        }
    }

    #[inline(always)]
    fn compute(&mut self, asset: &Asset, motion: &Motion, node: usize, step: usize) {
        let known = &mut self.nodes[node];
        if known.1 == step as u32 + 1 {
            return;
        }
        let amplitudes = motion.at(step);
        let mut u = [0.0; 3];
        for (axis, u) in u.iter_mut().enumerate() {
            let dof = 3 * node + axis;
            let residuals = motion.complement.residuals.iter();
            let following = residuals.map(|r| r.shape.at(asset, node)[axis] * r.force(step));
            *u = following.sum();
            *u += dot(&asset.modes.row(dof)[..motion.modes], amplitudes);
        }
        *known = (Vec3::from_array(u), step as u32 + 1);
    }
}

widest! {
    /// Displacements of an element's nodes.
    fn compute(moment: &mut Moment, asset: &Asset, motion: &Motion, nodes: &[u32; 10], step: usize) {
        for &node in nodes {
            moment.compute(asset, motion, node as usize, step);
        }
    }
}
