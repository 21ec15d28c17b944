//! Quadratic tetrahedra with straight edges: nodes and shape functions.

use frangible::glam::DVec3;
use frangible::internals::asset::AnalysisMesh;

use crate::mesh::{BodyMesh, barycentric_gradients};

/// Corners of the six mid-edge nodes, in the order of the nodes 4..10.
pub const MID_EDGES: [[usize; 2]; 6] = [[0, 1], [1, 2], [0, 2], [0, 3], [1, 3], [2, 3]];

/// A mesh of ten-node tetrahedra.
#[derive(Clone, Debug, Default)]
pub struct QuadraticMesh {
    /// Node positions, m: first the corners, then the mid-edges.
    pub positions: Vec<DVec3>,
    /// Four corners, then mid-edges in the order of [`MID_EDGES`].
    pub elements: Vec<[u32; 10]>,
}

impl QuadraticMesh {
    /// Creates a quadratic mesh by adding a node at the middle of every edge.
    #[must_use]
    pub fn new(mesh: &BodyMesh) -> Self {
        let edge = |tet: &[u32; 4], [i, j]: [usize; 2]| (tet[i].min(tet[j]), tet[i].max(tet[j]));
        let mut edges: Vec<(u32, u32)> = mesh
            .tets
            .iter()
            .flat_map(|tet| MID_EDGES.map(|ends| edge(tet, ends)))
            .collect();
        edges.sort_unstable();
        edges.dedup();
        let corners = mesh.positions.len() as u32;
        let mut positions = mesh.positions.clone();
        positions.extend(
            edges
                .iter()
                .map(|&(i, j)| 0.5 * (mesh.positions[i as usize] + mesh.positions[j as usize])),
        );
        let elements = mesh.tets.iter().map(|tet| {
            let mut nodes = [0; 10];
            nodes[..4].copy_from_slice(tet);
            for (k, &ends) in MID_EDGES.iter().enumerate() {
                // Present by construction: partition_point lands on it.
                nodes[4 + k] = corners + edges.partition_point(|&e| e < edge(tet, ends)) as u32;
            }
            nodes
        });
        Self {
            elements: elements.collect(),
            positions,
        }
    }

    /// Returns the mesh in the format of the asset.
    #[must_use]
    pub fn stored(&self) -> AnalysisMesh {
        let gradients = |e: usize| barycentric_gradients(self.corners(e)).map(|g| g.as_vec3());
        AnalysisMesh {
            nodes: self.positions.iter().map(|p| p.as_vec3()).collect(),
            barycentric_gradients: (0..self.elements.len()).map(gradients).collect(),
            elements: self.elements.clone(),
        }
    }

    /// Returns the corner positions of element `e`, m.
    #[must_use]
    pub fn corners(&self, e: usize) -> [DVec3; 4] {
        std::array::from_fn(|k| self.positions[self.elements[e][k] as usize])
    }
}

/// Returns the values of the ten shape functions at barycentric coordinates `l`: L(2L−1) for corners, 4 L_i L_j for mid-edges.
#[must_use]
pub fn shape_values(l: [f64; 4]) -> [f64; 10] {
    let mut values = [0.0; 10];
    for i in 0..4 {
        values[i] = l[i] * (2.0 * l[i] - 1.0);
    }
    for (k, &[i, j]) in MID_EDGES.iter().enumerate() {
        values[4 + k] = 4.0 * l[i] * l[j];
    }
    values
}

/// Returns the gradients (1/m) of the ten shape functions at barycentric coordinates `l`, from ∇L (1/m).
#[must_use]
pub fn shape_gradients(l: [f64; 4], gradients: &[DVec3; 4]) -> [DVec3; 10] {
    let mut out = [DVec3::ZERO; 10];
    for i in 0..4 {
        out[i] = (4.0 * l[i] - 1.0) * gradients[i];
    }
    for (k, &[i, j]) in MID_EDGES.iter().enumerate() {
        out[4 + k] = 4.0 * (l[i] * gradients[j] + l[j] * gradients[i]);
    }
    out
}
