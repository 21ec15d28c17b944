//! Stored stress bounds of an asset; the module `bounds` of this crate computes them.

/// Largest stress and gradient of each mode over clusters of neighbouring fracture tetrahedra.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StressBounds {
    /// Cluster of each fracture tetrahedron, indexed by [`Asset::place`](crate::Asset::place).
    pub cluster_of_tet: Vec<u32>,
    /// Largest linear stress, Pa per m·√kg: one row per cluster, one column per mode.
    pub stress: Vec<f32>,
    /// Largest displacement gradient, 1 per m·√kg: one row per cluster, one column per mode.
    pub gradient: Vec<f32>,
}

impl StressBounds {
    /// Returns true if there are no bounds; they are then computed when a body is created.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.cluster_of_tet.is_empty()
    }

    /// Rows of stress and gradient of a cluster, with so many modes each.
    #[inline(always)]
    pub(crate) fn rows(&self, cluster: usize, modes: usize) -> (&[f32], &[f32]) {
        let row = cluster * modes..(cluster + 1) * modes;
        (&self.stress[row.clone()], &self.gradient[row])
    }

    /// Returns the maximum over all clusters: rows of stress and gradient for the whole body.
    #[must_use]
    pub fn root(&self, modes: usize) -> (Vec<f32>, Vec<f32>) {
        let largest = |rows: &[f32]| {
            let mut root = vec![0.0_f32; modes];
            for row in rows.chunks_exact(modes.max(1)) {
                for (a, &b) in root.iter_mut().zip(row) {
                    *a = a.max(b);
                }
            }
            root
        };
        (largest(&self.stress), largest(&self.gradient))
    }
}
