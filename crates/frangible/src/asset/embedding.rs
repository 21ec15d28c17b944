//! Points of the body located in the analysis mesh, and the quadratic shape functions at them.

use glam::Vec3;

use super::Asset;
use crate::mesh::{EDGES, SurfacePoint};

/// A point of the body, located in the analysis mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmbeddedPoint {
    /// Analysis element that contains the point, or the nearest one for a point just outside the mesh.
    pub element: u32,
    /// Barycentric coordinates of the point in that element, or of the closest point of the element. They sum to one and may be
    /// slightly negative, since the element's polynomials can be extrapolated slightly beyond its faces.
    pub barycentric: [f32; 4],
    /// Offset from that closest point to the point, m; zero if the coordinates represent the point exactly.
    pub offset: Vec3,
}

/// Points of the fracture mesh, located in the analysis mesh.
#[derive(Clone, Debug, Default)]
pub struct Embedding {
    /// One per fracture tetrahedron: its centroid.
    pub tets: Vec<EmbeddedPoint>,
    /// One per fracture node.
    pub nodes: Vec<EmbeddedPoint>,
}

impl EmbeddedPoint {
    /// The point moved by a little, m, seen by the same element; `barycentric_gradients`: of that element, 1/m.
    #[inline(always)]
    pub(crate) fn moved(&self, barycentric_gradients: &[Vec3; 4], by: Vec3) -> Self {
        let own = self.barycentric.iter().zip(barycentric_gradients);
        let mut moved = *self;
        for (to, (l, g)) in moved.barycentric.iter_mut().zip(own) {
            *to = l + g.dot(by);
        }
        moved
    }

    /// Returns the values N_a of the element's ten quadratic shape functions at the closest point.
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

    /// Returns the gradients ∇N_a of the shape functions at the closest point, 1/m, from the gradients of the element's barycentric
    /// coordinates, 1/m.
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

/// Visits each analysis node that supports a point of the surface once, with its weight: ten nodes for each corner of the
/// point's triangle; the corners mostly share an element.
pub fn each_row(asset: &Asset, at: &SurfacePoint, mut visit: impl FnMut(usize, f32)) {
    let (carriers, count) = carriers(asset, at);
    for &(carrier, weight) in &carriers[..count] {
        visit(carrier as usize, weight);
    }
}

/// [`each_row`] as a list, and its length.
pub(crate) fn carriers(asset: &Asset, at: &SurfacePoint) -> ([(u32, f32); 30], usize) {
    let triangle = asset.surface.triangles[at.triangle as usize];
    let mut carriers = [(0_u32, 0.0_f32); 30];
    let mut count = 0;
    for (&node, corner) in triangle.iter().zip(at.weights) {
        let point = &asset.embedding.nodes[node as usize];
        let element = asset.analysis.elements[point.element as usize];
        for (&carrier, weight) in element.iter().zip(point.shape_values()) {
            let known = carriers[..count].iter_mut().find(|c| c.0 == carrier);
            match known {
                Some(known) => known.1 += corner * weight,
                None => {
                    carriers[count] = (carrier, corner * weight);
                    count += 1;
                }
            }
        }
    }
    (carriers, count)
}
