//! A repaired triangle surface.

use glam::DVec3;

/// Welded, non-degenerate triangles; possibly open, in several shells, or intersecting itself.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    /// Vertex positions, m.
    pub positions: Vec<DVec3>,
    /// Vertex indices of each triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

impl Surface {
    /// Corner positions of triangle `t`, m.
    #[must_use]
    pub fn corners(&self, t: usize) -> [DVec3; 3] {
        self.triangles[t].map(|v| self.positions[v as usize])
    }

    /// Lowest and highest corner of the bounding box of all vertices, m.
    #[must_use]
    pub fn bounds(&self) -> [DVec3; 2] {
        let everything = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        self.positions
            .iter()
            .fold(everything, |[l, h], &p| [l.min(p), h.max(p)])
    }
}
