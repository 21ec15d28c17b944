//! The author's surface divided among the fragments.
//!
//! The fracture mesh only approximates that surface, so the two do not meet exactly: the surface is divided by
//! projecting the partition of the fracture mesh's boundary on it, and the rims of the crack faces are drawn to it.

mod assemble;
mod draw;
mod overlay;
mod parts;
mod polygon;
#[cfg(test)]
mod tests;

use glam::{DVec3, Vec3};

use crate::asset::RenderSurface;
use crate::mesh::TriangleTree;
pub(crate) use draw::{Undrawn, draw};
use overlay::Overlay;
pub(crate) use parts::{Part, Parts};
use polygon::Polygon;

/// What follows from a render surface and every break needs.
#[derive(Debug)]
pub(crate) struct RenderIndex {
    /// Over the triangles of the render surface.
    tree: TriangleTree,
    /// Boundary triangle of the fracture mesh closest to each render triangle's centroid.
    home: Vec<u32>,
    /// Normals at the corners of each render triangle.
    normals: Vec<[Vec3; 3]>,
}

/// What of the render surface belongs to a fragment.
#[derive(Clone, Debug, Default)]
pub(crate) struct Share {
    /// Triangles that are the fragment's alone.
    pub(super) whole: Vec<u32>,
    /// Parts of triangles, in barycentric coordinates.
    pub(super) pieces: Vec<(u32, Polygon)>,
}

impl RenderIndex {
    pub(crate) fn new(surface: &RenderSurface, boundary: &TriangleTree) -> Self {
        let home = |t: &[u32; 3]| {
            let centroid = t
                .iter()
                .map(|&v| surface.positions[v as usize])
                .sum::<Vec3>()
                / 3.0;
            boundary.closest(centroid).triangle
        };
        Self {
            tree: TriangleTree::new(&surface.positions, &surface.triangles),
            normals: surface.corner_normals(),
            home: surface.triangles.iter().map(home).collect(),
        }
    }

    /// Where the render surface is closest, if within `reach`, m.
    pub(crate) fn drawn_to(&self, point: DVec3, reach: f32) -> DVec3 {
        let near = self.tree.closest(point.as_vec3()).position.as_dvec3();
        if near.distance(point) <= f64::from(reach) {
            near
        } else {
            point
        }
    }

    /// Each fragment's share of the render surface.
    ///
    /// Only triangles near a divided boundary triangle are looked at closely: elsewhere the boundary under a triangle
    /// has one label.
    pub(crate) fn shares(
        &self,
        surface: &RenderSurface,
        boundary: &TriangleTree,
        parts: &Parts,
        fragments: usize,
        reach: f32,
    ) -> Vec<Share> {
        let mut near_crack = vec![false; surface.triangles.len()];
        for t in parts.divided() {
            let corners = || parts.of(t).iter().flat_map(|p| p.corners);
            let low = corners().fold(DVec3::INFINITY, DVec3::min).as_vec3() - reach;
            let high = corners().fold(DVec3::NEG_INFINITY, DVec3::max).as_vec3() + reach;
            self.tree
                .in_box(low, high, |t| near_crack[t as usize] = true);
        }
        let mut shares = vec![Share::default(); fragments];
        for (t, triangle) in surface.triangles.iter().enumerate() {
            let corners = triangle.map(|v| surface.positions[v as usize].as_dvec3());
            let [a, b, c] = corners;
            let normal = (b - a).cross(c - a);
            let home = self.home[t];
            if !near_crack[t] || normal == DVec3::ZERO {
                let label = parts.label_near(home, (a + b + c) / 3.0);
                shares[label as usize].whole.push(t as u32);
                continue;
            }
            let under: DVec3 = parts.of(home).iter().map(area_vector).sum();
            let overlay = Overlay {
                corners,
                facing: if under.dot(normal) < 0.0 { -1.0 } else { 1.0 },
                reach: f64::from(reach),
                parts,
                boundary,
            };
            let mut divided = overlay.divide();
            if divided.len() == 1 {
                shares[divided[0].1 as usize].whole.push(t as u32);
                continue;
            }
            for (polygon, label) in divided.drain(..) {
                shares[label as usize].pieces.push((t as u32, polygon));
            }
        }
        shares
    }
}

fn area_vector(part: &Part) -> DVec3 {
    let [a, b, c] = part.corners;
    (b - a).cross(c - a)
}
