//! Where points of the body lie in the analysis mesh, and its quadratic shape functions there.

use glam::Vec3;

use crate::mesh::EDGES;

/// A point of the body as seen by the analysis mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmbeddedPoint {
    /// Analysis element that holds the point (the nearest one, for a point just outside).
    pub element: u32,
    /// Barycentric coordinates in it of the point, or of the closest point of the element. They sum to one, and
    /// may be slightly negative: the element's polynomials hold a little beyond its faces.
    pub barycentric: [f32; 4],
    /// From that closest point to the point, m; zero for a point that the coordinates give exactly.
    pub offset: Vec3,
}

/// Where the fracture mesh lies in the analysis mesh.
#[derive(Clone, Debug, Default)]
pub struct Embedding {
    /// One per fracture tetrahedron: its centroid.
    pub tets: Vec<EmbeddedPoint>,
    /// One per fracture node.
    pub nodes: Vec<EmbeddedPoint>,
}

impl EmbeddedPoint {
    /// N_a of the element's ten quadratic shape functions at its point closest to this one.
    #[must_use]
    pub fn shape_values(&self) -> [f32; 10] {
        let l = self.barycentric;
        std::array::from_fn(|a| {
            if a < 4 {
                l[a] * (2.0 * l[a] - 1.0)
            } else {
                let [i, j] = EDGES[a - 4];
                4.0 * l[i] * l[j]
            }
        })
    }

    /// ∇N_a there, 1/m, from the gradients of the element's barycentric coordinates, 1/m.
    #[must_use]
    pub fn shape_gradients(&self, barycentric_gradients: &[Vec3; 4]) -> [Vec3; 10] {
        let (l, g) = (self.barycentric, barycentric_gradients);
        std::array::from_fn(|a| {
            if a < 4 {
                g[a] * (4.0 * l[a] - 1.0)
            } else {
                let [i, j] = EDGES[a - 4];
                (g[j] * l[i] + g[i] * l[j]) * 4.0
            }
        })
    }
}
