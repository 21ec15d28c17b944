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

    /// Returns how much of the surface faces one way: the length of its mean normal, 1 for a flat sheet, 1/2 for half a sphere, 0 for a closed
    /// surface.
    #[must_use]
    pub fn facing(&self) -> f64 {
        let (mut sum, mut area) = (DVec3::ZERO, 0.0);
        for t in 0..self.triangles.len() {
            let [a, b, c] = self.corners(t);
            let normal = (b - a).cross(c - a);
            sum += normal;
            area += normal.length();
        }
        if area > 0.0 { sum.length() / area } else { 0.0 }
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
