//! Triangle surfaces of the pieces.

use glam::Vec3;

/// A closed, outward-oriented triangle surface of one piece, and the open cracks inside it.
///
/// Vertices are shared wherever the surface is connected, so that every edge has an opposite one;
/// normals belong to triangle corners, since they are discontinuous at sharp edges.
#[derive(Clone, Debug, Default)]
pub struct TriMesh {
    /// Vertex positions, m.
    pub positions: Vec<Vec3>,
    /// Vertices of each triangle, counter-clockwise seen from outside. The first
    /// [`TriMesh::outer_triangles`] lie on the body's original surface, the rest on cracks.
    pub triangles: Vec<[u32; 3]>,
    /// Unit normals at the corners of each triangle.
    pub normals: Vec<[Vec3; 3]>,
    /// Number of triangles on the body's original surface, which come first.
    pub outer_triangles: usize,
    /// Partial cracks inside the piece: separate two-sided triangles, m.
    pub cracks: Vec<[Vec3; 3]>,
}

impl TriMesh {
    /// Returns true if every directed edge has exactly one opposite edge.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        let mut edges: Vec<(u32, u32)> = self
            .triangles
            .iter()
            .flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)])
            .collect();
        edges.sort_unstable();
        let unique = edges.windows(2).all(|w| w[0] != w[1]);
        unique
            && edges
                .iter()
                .all(|&(a, b)| edges.binary_search(&(b, a)).is_ok())
    }

    /// Returns the volume enclosed by the surface, m³.
    #[must_use]
    pub fn volume(&self) -> f64 {
        let p = |i: u32| self.positions[i as usize].as_dvec3();
        self.triangles
            .iter()
            .map(|&[a, b, c]| p(a).dot(p(b).cross(p(c))) / 6.0)
            .sum()
    }
}
