//! Tetrahedral mesh of a shape, in f64.

use frangible::glam::DVec3;
use frangible_mesh::quality::dihedral_range;
pub(crate) use frangible_mesh::quality::volume as tet_volume;

use crate::error::BakeError;

/// Right-handed tetrahedra of a body, with its convex cells.
#[derive(Clone, Debug, Default)]
pub struct BodyMesh {
    /// Node positions, m, in the frame of the shape.
    pub positions: Vec<DVec3>,
    /// Node indices of each tetrahedron: det(x1−x0, x2−x0, x3−x0) > 0.
    pub tets: Vec<[u32; 4]>,
    /// Nearly convex cell of each tetrahedron, 0..`cells`.
    pub cell_of_tet: Vec<u32>,
    /// Number of cells; none is empty.
    pub cells: usize,
}

impl BodyMesh {
    /// Returns the corners of tetrahedron `e`, m.
    #[must_use]
    pub fn corners(&self, e: usize) -> [DVec3; 4] {
        self.tets[e].map(|v| self.positions[v as usize])
    }

    /// Returns the volume of the body, m³.
    #[must_use]
    pub fn volume(&self) -> f64 {
        (0..self.tets.len())
            .map(|e| tet_volume(self.corners(e)))
            .sum()
    }

    /// Returns the smallest dihedral angle, degrees (70.5 in a regular tetrahedron).
    #[must_use]
    pub fn min_dihedral(&self) -> f64 {
        (0..self.tets.len())
            .map(|e| dihedral_range(self.corners(e)).0)
            .fold(f64::INFINITY, f64::min)
    }

    /// Moves all nodes by `shift`, m.
    pub fn translate(&mut self, shift: DVec3) {
        for p in &mut self.positions {
            *p += shift;
        }
    }

    /// Turns left-handed tetrahedra round, renumbers the cells without gaps, and checks the volumes.
    pub(crate) fn finish(mut self) -> Result<Self, BakeError> {
        for e in 0..self.tets.len() {
            if tet_volume(self.corners(e)) < 0.0 {
                self.tets[e].swap(2, 3);
            }
            let x = self.corners(e);
            let (volume, edge) = (tet_volume(x), x[0].distance(x[1]));
            if volume.is_nan() || volume <= 1e-6 * edge * edge * edge {
                return Err(BakeError::Inverted { tet: e, volume });
            }
        }
        let mut used: Vec<u32> = self.cell_of_tet.clone();
        used.sort_unstable();
        used.dedup();
        for cell in &mut self.cell_of_tet {
            // Present by construction, so the fallback never shows.
            *cell = used.binary_search(cell).unwrap_or(0) as u32;
        }
        self.cells = used.len();
        Ok(self)
    }
}

/// Gradients of the four barycentric coordinates, 1/m: constant in the element.
#[must_use]
pub(crate) fn barycentric_gradients([a, b, c, d]: [DVec3; 4]) -> [DVec3; 4] {
    let (u, v, w) = (b - a, c - a, d - a);
    let inverse = 1.0 / u.cross(v).dot(w);
    let (g1, g2, g3) = (
        v.cross(w) * inverse,
        w.cross(u) * inverse,
        u.cross(v) * inverse,
    );
    [-(g1 + g2 + g3), g1, g2, g3]
}
