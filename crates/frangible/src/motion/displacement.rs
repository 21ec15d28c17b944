//! Displacements u = Φ q of the coarse nodes for several time steps at once, and their gradients at any point from ten nodes.

use std::sync::Arc;

use glam::{Mat3, Vec3};

use super::Motion;
use crate::asset::{Asset, EmbeddedPoint};
use crate::stress::{BATCH, Lanes, STRIDE, Shape, Wide, lane};

/// Displacements of the coarse nodes at a few consecutive steps; each node is computed on first use.
#[derive(Clone, Debug)]
pub struct DisplacementBatch {
    /// Amplitudes of every mode at the batch's steps, m·√kg.
    amplitudes: Vec<Lanes>,
    /// Shapes of the static response, m/N, and their forces at the batch's steps, N.
    residuals: Vec<(Arc<Shape>, Lanes)>,
    /// `displacements[node][axis][step]`, m.
    displacements: Vec<[Lanes; 3]>,
    /// Number of the batch for which each node was last computed.
    computed: Vec<u32>,
    /// Index of the selected batch.
    batch: Option<usize>,
    sought: u32,
}

impl DisplacementBatch {
    /// Number of time steps in a batch.
    pub const LANES: usize = BATCH;
    /// Number of time steps from one batch to the next: the first step of a batch is the last of the batch before.
    pub const STRIDE: usize = STRIDE;

    /// Creates an empty batch for an asset.
    #[must_use]
    pub fn new(asset: &Asset) -> Self {
        let nodes = asset.analysis.nodes.len();
        Self {
            amplitudes: Vec::new(),
            residuals: Vec::new(),
            displacements: vec![[[0.0; BATCH]; 3]; nodes],
            computed: vec![0; nodes],
            batch: None,
            sought: 0,
        }
    }

    /// Discards the selected batch after a change of the motion.
    pub(crate) fn forget(&mut self) {
        self.batch = None;
    }

    /// Selects the batch that contains `step`.
    pub fn seek(&mut self, motion: &Motion, step: usize) {
        let batch = step / STRIDE;
        if self.batch == Some(batch) {
            return;
        }
        self.batch = Some(batch);
        self.sought += 1;
        let residuals = &motion.complement.residuals;
        self.amplitudes.clear();
        self.amplitudes.resize(motion.modes, [0.0; BATCH]);
        self.residuals.clear();
        let shapes = residuals
            .iter()
            .map(|r| (Arc::clone(&r.shape), [0.0; BATCH]));
        self.residuals.extend(shapes);
        // Transposed: the inner loops run over the batch, so that they vectorise. Before the first step all is at rest.
        for k in 0..BATCH {
            let step = (batch * STRIDE + k).checked_sub(1);
            if let Some(step) = step.filter(|&step| step < motion.steps()) {
                for (row, &q) in self.amplitudes.iter_mut().zip(motion.at(step)) {
                    row[k] = q;
                }
                for ((_, row), residual) in self.residuals.iter_mut().zip(residuals) {
                    row[k] = residual.force(step);
                }
            }
        }
    }

    /// Amplitudes of the modes that are followed at the batch's steps, m·√kg.
    pub(crate) fn amplitudes(&self) -> &[Lanes] {
        &self.amplitudes
    }

    /// Shapes of the static response, m/N, and their forces at the batch's steps, N.
    pub(crate) fn residuals(&self) -> &[(Arc<Shape>, Lanes)] {
        &self.residuals
    }

    /// Computes the batch at every node in advance.
    pub fn fill(&mut self, asset: &Asset) {
        // With the widest vectors that this processor has, as where they are asked for.
        fill(self, asset);
    }

    /// u = Φ q at a node, at all steps of the batch.
    #[inline(always)]
    fn at_node(&mut self, asset: &Asset, node: usize) -> &[Lanes; 3] {
        if self.computed[node] != self.sought {
            self.computed[node] = self.sought;
            self.displacements[node] = product(asset, node, &self.amplitudes, &self.residuals);
        }
        &self.displacements[node]
    }

    /// Finds u = Φ q at all nodes of an element, two of them side by side: the sum of one node is a chain that waits for itself.
    #[inline(always)]
    fn at_nodes(&mut self, asset: &Asset, nodes: &[u32; 10]) {
        let mut waiting = [0; 10];
        let mut count = 0;
        for &node in nodes {
            if self.computed[node as usize] != self.sought {
                self.computed[node as usize] = self.sought;
                waiting[count] = node as usize;
                count += 1;
            }
        }
        let (some, rest) = waiting[..count].as_chunks::<2>();
        for &some in some {
            let products = products(asset, some, &self.amplitudes, &self.residuals);
            for (node, product) in some.into_iter().zip(products) {
                self.displacements[node] = product;
            }
        }
        for &node in rest {
            self.displacements[node] = product(asset, node, &self.amplitudes, &self.residuals);
        }
    }

    /// ∇u at an embedded point at all steps of the batch: `[column j][row i]` = ∂u_i/∂x_j.
    #[inline(always)]
    pub(crate) fn gradients(&mut self, asset: &Asset, point: &EmbeddedPoint) -> [[Wide; 3]; 3] {
        let element = point.element as usize;
        let weights = point.shape_gradients(&asset.analysis.barycentric_gradients[element]);
        let nodes = &asset.analysis.elements[element];
        self.at_nodes(asset, nodes);
        // The gradients of the shape functions add up to nothing: what all nodes share only costs digits.
        let shared = &self.displacements[nodes[0] as usize];
        let mut sum = [[Wide::default(); 3]; 3];
        // Row by row, so that the sums stay in registers, and without iterators that are compiled for the plain processor.
        for row in 0..3 {
            let zero = Wide::default();
            let (mut x, mut y, mut z) = (zero, zero, zero);
            for n in 1..nodes.len() {
                let u = Wide(self.displacements[nodes[n] as usize][row]) - Wide(shared[row]);
                let weight = weights[n];
                x = x.plus(weight.x, &u.0);
                y = y.plus(weight.y, &u.0);
                z = z.plus(weight.z, &u.0);
            }
            (sum[0][row], sum[1][row], sum[2][row]) = (x, y, z);
        }
        sum
    }

    /// Returns ∇u at an embedded point, with columns ∂u/∂x_j; `step` must be in the selected batch.
    #[must_use]
    pub fn gradient(&mut self, asset: &Asset, point: &EmbeddedPoint, step: usize) -> Mat3 {
        let k = lane(step);
        let element = point.element as usize;
        let gradients = point.shape_gradients(&asset.analysis.barycentric_gradients[element]);
        let nodes = &asset.analysis.elements[element];
        let at = |u: &[Lanes; 3]| Vec3::new(u[0][k], u[1][k], u[2][k]);
        let shared = at(self.at_node(asset, nodes[0] as usize));
        let mut sum = Mat3::ZERO;
        for (&node, g) in nodes.iter().zip(gradients).skip(1) {
            let u = at(self.at_node(asset, node as usize)) - shared;
            sum.x_axis += u * g.x;
            sum.y_axis += u * g.y;
            sum.z_axis += u * g.z;
        }
        sum
    }
}

widest! {
    /// The displacements of all nodes.
    fn fill(batch: &mut DisplacementBatch, asset: &Asset) {
        for node in 0..batch.displacements.len() {
            batch.at_node(asset, node);
        }
    }
}

/// Displacement of a node by the shapes that follow the force: those of the highest modes, so first in the sum.
#[inline(always)]
fn following(asset: &Asset, node: usize, residuals: &[(Arc<Shape>, Lanes)]) -> [Wide; 3] {
    let mut sums = [Wide::default(); 3];
    for (shape, force) in residuals {
        for (u, sum) in shape.at(asset, node).into_iter().zip(&mut sums) {
            *sum = sum.plus(u, force);
        }
    }
    sums
}

/// Modes of a block. The highest block comes first in a sum: high modes move little, so that the sum is large, and rounds, only at the
/// end. Within a block they come in the order of memory: backwards it takes several times as long.
const BLOCK: usize = 16;

/// Adds the products of three rows of Φ and the amplitudes of their modes, which are no more than a block, to the sums.
#[inline(always)]
fn add_block(
    rows: [&[f32]; 3],
    amplitudes: &[Lanes],
    [mut a, mut b, mut c]: [Wide; 3],
) -> [Wide; 3] {
    let [x, y, z] = rows;
    for (((q, x), y), z) in amplitudes.iter().zip(x).zip(y).zip(z) {
        (a, b, c) = (a.plus(*x, q), b.plus(*y, q), c.plus(*z, q));
    }
    [a, b, c]
}

/// One node's rows of Φ times the amplitudes.
#[inline(always)]
fn product(
    asset: &Asset,
    node: usize,
    amplitudes: &[Lanes],
    residuals: &[(Arc<Shape>, Lanes)],
) -> [Lanes; 3] {
    let mut sums = following(asset, node, residuals);
    let rows = asset.modes.rows(node);
    let starts = (0..amplitudes.len()).step_by(BLOCK).rev();
    for block in starts.map(|start| start..(start + BLOCK).min(amplitudes.len())) {
        let rows = [
            &rows[0][block.clone()],
            &rows[1][block.clone()],
            &rows[2][block.clone()],
        ];
        sums = add_block(rows, &amplitudes[block], sums);
    }
    let [a, b, c] = sums;
    [a.0, b.0, c.0]
}

/// The displacements of two nodes.
#[inline(always)]
fn products(
    asset: &Asset,
    nodes: [usize; 2],
    amplitudes: &[Lanes],
    residuals: &[(Arc<Shape>, Lanes)],
) -> [[Lanes; 3]; 2] {
    let modes = amplitudes.len();
    let (blocks, highest) = amplitudes.as_chunks::<BLOCK>();
    let first = blocks.len() * BLOCK;
    let [[x, y, z], [u, v, w]] = [asset.modes.rows(nodes[0]), asset.modes.rows(nodes[1])];
    // `array::map` would be a call of its own.
    let sums = [
        following(asset, nodes[0], residuals),
        following(asset, nodes[1], residuals),
    ];
    let ends = first..modes;
    let [a, b, c] = add_block(
        [&x[ends.clone()], &y[ends.clone()], &z[ends.clone()]],
        highest,
        sums[0],
    );
    let [d, e, f] = add_block(
        [&u[ends.clone()], &v[ends.clone()], &w[ends]],
        highest,
        sums[1],
    );
    let (mut a, mut b, mut c, mut d, mut e, mut f) = (a, b, c, d, e, f);
    let (x, y, z) = (
        x.as_chunks::<BLOCK>().0,
        y.as_chunks::<BLOCK>().0,
        z.as_chunks::<BLOCK>().0,
    );
    let (u, v, w) = (
        u.as_chunks::<BLOCK>().0,
        v.as_chunks::<BLOCK>().0,
        w.as_chunks::<BLOCK>().0,
    );
    for (block, q) in blocks.iter().enumerate().rev() {
        // Arrays of known length: no index is checked in the loop.
        let (x, y, z) = (&x[block], &y[block], &z[block]);
        let (u, v, w) = (&u[block], &v[block], &w[block]);
        for i in 0..BLOCK {
            let q = &q[i];
            (a, b, c) = (a.plus(x[i], q), b.plus(y[i], q), c.plus(z[i], q));
            (d, e, f) = (d.plus(u[i], q), e.plus(v[i], q), f.plus(w[i], q));
        }
    }
    [[a.0, b.0, c.0], [d.0, e.0, f.0]]
}
