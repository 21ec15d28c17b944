//! The surface that an author drew, divided among the pieces of a body.
//!
//! The fracture mesh only approximates that surface, so the two do not meet exactly: the surface is divided by
//! projecting the partition of the fracture mesh's boundary on it (`overlay.rs`), and the rims of the crack faces are drawn to it. Then
//! the two are sewn together: corners on common borders become one (`conform.rs`), and what is open between the crack faces and the
//! fragment's share of the surface is closed (`seam.rs`). Of a closed surface all fragments are closed.

mod assemble;
mod conform;
mod edges;
mod overlay;
mod parts;
mod polygon;
mod seam;
mod surface;

use std::collections::HashMap;

use glam::{DVec3, Vec3};

use crate::{RenderMesh, TriangleTree};
use assemble::Vertices;
use conform::{Corner, Corners};
use edges::Edges;
use overlay::Overlay;
pub use parts::{Part, Parts};
use polygon::Polygon;
use seam::{Seam, close};
pub use surface::{RenderMaterial, RenderSurface};

/// What follows from a render surface and every break needs.
#[derive(Debug)]
pub struct RenderIndex {
    /// Over the triangles of the render surface.
    tree: TriangleTree,
    /// Boundary triangle of the fracture mesh closest to each render triangle's centroid.
    home: Vec<u32>,
    /// Normals at the corners of each render triangle.
    normals: Vec<[Vec3; 3]>,
    /// How its triangles hang together, if they face outwards.
    edges: Option<Edges>,
}

/// How a partition of the fracture mesh divides its boundary, and the faces between its pieces.
#[derive(Clone, Debug, Default)]
pub struct Division {
    /// The boundary divided among the labels.
    pub parts: Parts,
    /// Nodes of the fracture mesh: points of the partition are numbered from here on.
    pub nodes: usize,
    /// Crack faces of each label, in numbers of the points.
    pub faces: Vec<Vec<[u32; 3]>>,
    /// Where the points are, m, body frame.
    pub points: Vec<DVec3>,
}

/// A piece to be drawn.
#[derive(Clone, Copy, Debug)]
pub struct Piece<'a> {
    /// Its label.
    pub label: u32,
    /// Normals at the corners of its crack faces, face after face.
    pub normals: &'a [[Vec3; 3]],
    /// Its centre of mass, m, body frame: the origin of what is drawn.
    pub centre: DVec3,
}

/// What of the render surface belongs to a fragment.
#[derive(Clone, Debug, Default)]
struct Share {
    /// Triangles that are the fragment's alone.
    whole: Vec<u32>,
    /// Parts of triangles, in barycentric coordinates.
    pieces: Vec<(u32, Polygon)>,
    /// Triangles and parts of them whose corners are numbered.
    numbered: Vec<(u32, Vec<Corner>)>,
}

impl RenderIndex {
    /// What follows from a surface. `boundary`: over the boundary triangles of the fracture mesh.
    #[must_use]
    pub fn new(surface: &RenderSurface, boundary: &TriangleTree) -> Self {
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
            edges: Edges::new(surface),
        }
    }

    /// What to draw of each piece: its share of the surface and its crack faces, sewn to that share where the surface faces outwards.
    ///
    /// `boundary`: as for [`RenderIndex::new`]. `reach`: how far the surface may be from the boundary, m.
    #[must_use]
    pub fn divide(
        &self,
        surface: &RenderSurface,
        boundary: &TriangleTree,
        reach: f32,
        division: Division,
        pieces: &[Piece<'_>],
    ) -> Vec<RenderMesh> {
        let Division {
            parts,
            nodes,
            faces,
            mut points,
        } = division;
        // One more for what belongs to the neighbours of a piece.
        let mut shares = self.shares(surface, boundary, &parts, faces.len() + 1, reach);
        let mut rim = parts.rim;
        rim.sort_unstable();
        rim.dedup();
        for v in rim {
            let place = &mut points[v as usize - nodes];
            *place = self.drawn_to(*place, reach);
        }
        let corners = self.edges.as_ref().map(|edges| {
            let corners = number(surface, edges, &mut shares);
            (edges, corners)
        });
        let place = |v: u32| points[v as usize - nodes];
        let mut local = vec![u32::MAX; surface.positions.len()];
        let draw = |piece: &Piece<'_>| {
            let label = piece.label as usize;
            let (share, faces, normals) = (&shares[label], &faces[label], piece.normals);
            let seam = match &corners {
                None => Seam::default(),
                Some((edges, corners)) => {
                    // Looked up only, never iterated.
                    let flat = |face: &[u32; 3], n: &[Vec3; 3]| [0, 1, 2].map(|k| (face[k], n[k]));
                    let normal: HashMap<u32, Vec3> = (faces.iter().zip(normals))
                        .flat_map(|(face, n)| flat(face, n))
                        .collect();
                    close(
                        sides(surface, edges, corners, share),
                        |number| corners.place(number),
                        faces,
                        place,
                        |point| normal[&point],
                        f64::from(reach),
                        edges.are_closed,
                    )
                }
            };
            let place = |v: u32| seam.moved.get(&v).copied().unwrap_or_else(|| place(v));
            let mut inner: Vertices = (faces.iter().zip(normals))
                .map(|(face, n)| [0, 1, 2].map(|k| (place(face[k]), n[k])))
                .collect();
            inner.extend(&seam.triangles);
            let corners = corners.as_ref().map(|(_, corners)| corners);
            self.assemble(surface, share, corners, &inner, piece.centre, &mut local)
        };
        pieces.iter().map(draw).collect()
    }

    /// Where the render surface is closest, if within `reach`, m.
    fn drawn_to(&self, point: DVec3, reach: f32) -> DVec3 {
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
    fn shares(
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

/// Numbers the corners of a surface's parts, and gives all triangles and parts the same ones along common borders.
fn number<'a>(surface: &'a RenderSurface, edges: &'a Edges, shares: &mut [Share]) -> Corners<'a> {
    let mut corners = Corners::new(surface, edges, shares);
    let mut parts: Vec<(u32, usize, Polygon)> = Vec::new();
    for (label, share) in shares.iter_mut().enumerate() {
        let pieces = std::mem::take(&mut share.pieces);
        parts.extend(pieces.into_iter().map(|(t, polygon)| (t, label, polygon)));
    }
    // Stable: the parts of a triangle stay in their order.
    parts.sort_by_key(|part| part.0);
    for parts in parts.chunk_by(|a, b| a.0 == b.0) {
        let t = parts[0].0;
        let polygons: Vec<_> = parts.iter().map(|part| &part.2[..]).collect();
        for (part, corners) in parts.iter().zip(corners.conform(t, &polygons)) {
            if !corners.is_empty() {
                shares[part.1].numbered.push((t, corners));
            }
        }
    }
    let mut is_bordering = vec![false; surface.triangles.len()];
    for t in corners.bordering() {
        is_bordering[t as usize] = true;
    }
    for share in shares {
        let Share {
            whole, numbered, ..
        } = share;
        for &t in whole.iter().filter(|&&t| is_bordering[t as usize]) {
            let polygon = (0..3).flat_map(|k| corners.along(t, k)).collect();
            numbered.push((t, polygon));
        }
        whole.retain(|&t| !is_bordering[t as usize]);
    }
    corners
}

/// Sides of the parts of a share, between numbered corners, each the way its part has it: all but some that run both ways. Those on the
/// border of a hole are all there, and marked.
fn sides(
    surface: &RenderSurface,
    edges: &Edges,
    corners: &Corners,
    share: &Share,
) -> Vec<([u32; 2], bool)> {
    let mut is_whole = vec![false; surface.triangles.len()];
    for &t in &share.whole {
        is_whole[t as usize] = true;
    }
    let mut sides = Vec::new();
    for &t in &share.whole {
        for k in 0..3 {
            let Some((edge, forward)) = edges.of_side(surface, 3 * t + k) else {
                continue;
            };
            let mut around = edges.triangles_at(edge);
            let is_open = edges.is_open(edge);
            if is_open || around.any(|t| !is_whole[t as usize]) {
                let [low, high] = edges.ends(edge);
                sides.push((if forward { [low, high] } else { [high, low] }, is_open));
            }
        }
    }
    for (t, polygon) in &share.numbered {
        for (i, (from, _)) in polygon.iter().enumerate() {
            let ends = [*from, polygon[(i + 1) % polygon.len()].0];
            sides.push((ends, corners.is_on_hole(*t, ends)));
        }
    }
    sides
}

fn area_vector(part: &Part) -> DVec3 {
    let [a, b, c] = part.corners;
    (b - a).cross(c - a)
}
