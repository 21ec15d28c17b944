//! The surface that an author drew, divided among the pieces of a body.
//!
//! The fracture mesh only approximates that surface, so the two do not meet exactly. Which triangles of the mesh's boundary lie under each of
//! the surface's is found once per body (`under.rs`). A break divides the surface along the cracks in these triangles, projected on it
//! (`overlay.rs`), and draws the rims of the crack faces to it. Then the two are sewn together: corners on common borders become one
//! (`conform.rs`), and the crack faces are laid on the border of the fragment's share of the surface (`seam.rs`). All fragments of a closed
//! surface that faces outwards are closed.

mod assemble;
mod conform;
mod edges;
mod lines;
mod look;
mod overlay;
#[cfg(test)]
mod overlay_tests;
mod parts;
mod polygon;
mod rings;
mod seam;
mod surface;
mod under;
mod vertices;

use glam::{DVec3, Vec3};

use crate::{RenderMesh, Threads, TriangleTree};
use conform::{Corner, Corners, Room};
use edges::{Edges, NO_TRIANGLE};
pub use look::{
    Blending, Image, ImageKind, Placement, RenderMaterial, Texture, TextureSlot, Wrap, linear_color,
};
use overlay::{Ground, Overlay};
use parts::MIXED;
pub use parts::{Part, Parts};
use polygon::Polygon;
use seam::{CrackFaces, close};
pub use surface::RenderSurface;
pub use under::Boundary;
use under::{Lie, Under};
use vertices::Vertices;

/// Index of a render surface, computed once and used by every break.
#[derive(Debug)]
pub struct RenderIndex {
    /// Over the triangles of the render surface.
    tree: TriangleTree,
    /// Triangles of the fracture mesh's boundary under each triangle of the render surface.
    under: Under,
    /// Largest distance of the surface from the boundary, m.
    reach: f32,
    /// Vertices with which the whole render surface is drawn.
    vertices: Vertices,
    /// Normal of each render triangle.
    flat: Vec<Vec3>,
    /// Its edges and neighbouring triangles, if the surface faces outwards.
    edges: Option<Edges>,
}

/// Division of the fracture mesh's boundary by a partition, and the faces between its pieces.
#[derive(Clone, Debug, Default)]
pub struct Division {
    /// The boundary divided among the labels.
    pub parts: Parts,
    /// Nodes of the fracture mesh: points of the partition are numbered from here on.
    pub nodes: usize,
    /// Crack faces of each label, in numbers of the points.
    pub faces: Vec<Vec<[u32; 3]>>,
    /// Positions of the points, m, body frame.
    pub points: Vec<DVec3>,
}

/// A piece whose render mesh is requested.
#[derive(Clone, Copy, Debug)]
pub struct Piece<'a> {
    /// Label of the piece in the partition.
    pub label: u32,
    /// Normals at the corners of its crack faces, face after face.
    pub normals: &'a [[Vec3; 3]],
    /// Its centre of mass, m, body frame: the origin of its mesh.
    pub centre: DVec3,
}

/// A triangle, a label, and the polygon that is this label's part of the triangle. Lists of them are in the order of the triangles.
type Cut = (u32, u32, Polygon);

/// Parts of the surface per thread: the longest of them ends soon after the others.
const PARTS: usize = 8;

/// Share of the render surface that belongs to a fragment.
#[derive(Clone, Debug, Default)]
struct Share {
    /// Triangles that are the fragment's alone.
    whole: Vec<u32>,
    /// Parts of triangles, in barycentric coordinates, where corners have no numbers.
    pieces: Vec<(u32, Polygon)>,
    /// Triangles and parts of them whose corners are numbered: the triangle, and where its corners end.
    numbered: Vec<(u32, u32)>,
    corners: Vec<Corner>,
}

impl Share {
    /// Adds a triangle, or a part of it, whose corners are numbered.
    fn push(&mut self, triangle: u32, corners: impl IntoIterator<Item = Corner>) {
        self.corners.extend(corners);
        self.numbered.push((triangle, self.corners.len() as u32));
    }

    /// The numbered triangles and parts, each with its corners.
    fn numbered(&self) -> impl Iterator<Item = (u32, &[Corner])> {
        let mut first = 0;
        self.numbered.iter().map(move |&(t, end)| {
            let corners = &self.corners[first..end as usize];
            first = end as usize;
            (t, corners)
        })
    }
}

impl RenderIndex {
    /// Indexes a surface. `reach` is its largest distance from the boundary of the fracture mesh, m.
    #[must_use]
    pub fn new(surface: &RenderSurface, boundary: &Boundary<'_>, reach: f32) -> Self {
        let normals = surface.corner_normals();
        let flat = surface.flat_normals(&normals);
        Self {
            tree: TriangleTree::new(&surface.positions, &surface.triangles),
            vertices: Vertices::new(surface, &normals, &flat),
            flat,
            under: Under::new(surface, boundary, reach),
            reach,
            edges: Edges::new(surface),
        }
    }

    /// Computes the render mesh of each piece: its share of the surface and its crack faces, sewn to that share if the surface faces
    /// outwards.
    ///
    /// `boundary` is the tree of the boundary triangles of the fracture mesh.
    #[must_use]
    pub fn divide(
        &self,
        surface: &RenderSurface,
        boundary: &TriangleTree,
        division: Division,
        pieces: &[Piece<'_>],
        threads: &Threads,
    ) -> Vec<RenderMesh> {
        let Division {
            parts,
            nodes,
            faces,
            mut points,
        } = division;
        // One more for what belongs to the neighbours of a piece.
        let (mut shares, cuts) = self.shares(surface, boundary, &parts, faces.len() + 1, threads);
        let mut rim = parts.rim;
        rim.sort_unstable();
        rim.dedup();
        let mut is_on_rim = vec![false; points.len()];
        for v in rim {
            is_on_rim[v as usize - nodes] = true;
            let place = &mut points[v as usize - nodes];
            *place = self.drawn_to(*place);
        }
        let sewn = match &self.edges {
            None => {
                for (t, label, polygon) in cuts {
                    shares[label as usize].pieces.push((t, polygon));
                }
                None
            }
            Some(edges) => {
                let corners = number(surface, edges, &cuts, &mut shares);
                Some((corners, owners(&shares, surface.triangles.len())))
            }
        };
        // Places of points, vertices, and normals of the piece at hand at the points of its crack faces.
        let room = || {
            let local = vec![u32::MAX; self.vertices.count()];
            (points.clone(), local, vec![Vec3::ZERO; points.len()])
        };
        type Local = (Vec<DVec3>, Vec<u32>, Vec<Vec3>);
        let draw = |(laid, local, normals): &mut Local, piece: &Piece<'_>| {
            let (share, faces) = (&shares[piece.label as usize], &faces[piece.label as usize]);
            for (face, own) in faces.iter().zip(piece.normals) {
                for (&v, &normal) in face.iter().zip(own) {
                    normals[v as usize - nodes] = normal;
                }
            }
            let cracks = CrackFaces {
                faces,
                first: nodes,
                places: &points,
                normals,
                is_on_rim: &is_on_rim,
            };
            let seam = sewn.as_ref().map(|(corners, owners)| {
                let is_own = |t: u32| owners[t as usize] == piece.label;
                let sides = sides(surface, corners, share, is_own);
                let sheet_at = |number| corners.place(number);
                close(
                    sides,
                    sheet_at,
                    cracks,
                    f64::from(self.reach),
                    corners.edges().are_closed,
                )
            });
            let seam = seam.unwrap_or_default();
            let corners = sewn.as_ref().map(|(corners, _)| corners);
            let inner = seam.count(cracks);
            let mut drawn = self.assemble(surface, share, corners, inner, piece.centre, local);
            seam.faces(cracks, piece.normals, laid, |face| {
                drawn.crack_face(face);
            });
            drawn.mesh
        };
        threads.map(pieces.iter().collect(), room, draw)
    }

    /// Moves a point to the closest point of the render surface, if that is within reach.
    fn drawn_to(&self, point: DVec3) -> DVec3 {
        let near = self.tree.closest(point.as_vec3()).position.as_dvec3();
        if near.distance(point) <= f64::from(self.reach) {
            near
        } else {
            point
        }
    }

    /// Each fragment's share of the render surface, and the parts of those triangles that several fragments share.
    ///
    /// Only triangles with several labels under them are looked at closely.
    fn shares(
        &self,
        surface: &RenderSurface,
        boundary: &TriangleTree,
        parts: &Parts,
        fragments: usize,
        threads: &Threads,
    ) -> (Vec<Share>, Vec<Cut>) {
        let (labels, cracks) = (parts.labels(), parts.cracks());
        // The label of a triangle under which there is one, and the parts of one that several share.
        let look = |t: usize| {
            let triangle = &surface.triangles[t];
            let under = self.under.of(t);
            let label = labels[under[0] as usize];
            if label != MIXED && under.iter().all(|&b| labels[b as usize] == label) {
                return (label, Vec::new());
            }
            let lie = self.under.lie(t);
            let corners = triangle.map(|v| surface.positions[v as usize].as_dvec3());
            let Some(ground) = Ground::new(corners, lie == Lie::Turned) else {
                return (parts.label_near(under[0], corners[0]), Vec::new());
            };
            let overlay = Overlay {
                ground,
                reach: f64::from(self.reach),
                parts,
                labels: &labels,
                cracks: &cracks,
                boundary,
            };
            if lie != Lie::Beside
                && let Some(label) = overlay.only_label(under)
            {
                return (label, Vec::new());
            }
            let divided = match lie {
                Lie::Beside => overlay.beside(under),
                Lie::Over | Lie::Turned => overlay.divide(under),
            };
            match divided[..] {
                [(_, label)] => (label, Vec::new()),
                _ => (MIXED, divided),
            }
        };
        let triangles = surface.triangles.len();
        let step = triangles.div_ceil(PARTS * threads.count()).max(1);
        let ranges = (0..triangles).step_by(step);
        let ranges = ranges.map(|first| first..triangles.min(first + step));
        let looked = threads.map(
            ranges.collect(),
            || (),
            |(), range| range.map(look).collect::<Vec<_>>(),
        );
        let (mut shares, mut cuts) = (vec![Share::default(); fragments], Vec::new());
        for (t, (label, divided)) in (0..).zip(looked.into_iter().flatten()) {
            match label {
                MIXED => cuts.extend(divided.into_iter().map(|(polygon, l)| (t, l, polygon))),
                label => shares[label as usize].whole.push(t),
            }
        }
        (shares, cuts)
    }
}

/// Numbers the corners of a surface's parts, and gives all triangles and parts the same ones along common borders.
fn number<'a>(
    surface: &'a RenderSurface,
    edges: &'a Edges,
    cuts: &[Cut],
    shares: &mut [Share],
) -> Corners<'a> {
    let mut corners = Corners::new(surface, edges, cuts);
    let mut room = Room::default();
    for parts in cuts.chunk_by(|a, b| a.0 == b.0) {
        corners.conform(parts, &mut room, |&(t, label, _), corners| {
            shares[label as usize].push(t, corners.iter().copied());
        });
    }
    let mut is_bordering = vec![false; surface.triangles.len()];
    for t in corners.bordering() {
        is_bordering[t as usize] = true;
    }
    for share in shares {
        let mut whole = std::mem::take(&mut share.whole);
        whole.retain(|&t| {
            let is_bordering = is_bordering[t as usize];
            if is_bordering {
                share.push(t, (0..3).flat_map(|k| corners.along(t, k)));
            }
            !is_bordering
        });
        share.whole = whole;
    }
    corners
}

/// The label of each triangle that is one fragment's alone, [`MIXED`] elsewhere.
fn owners(shares: &[Share], triangles: usize) -> Vec<u32> {
    let mut owners = vec![MIXED; triangles];
    for (label, share) in (0..).zip(shares) {
        for &t in &share.whole {
            owners[t as usize] = label;
        }
    }
    owners
}

/// Sides of the parts of a share, between numbered corners, each the way its part has it: all but some that run both ways. Those on the
/// border of a hole are all there, and marked. `is_own`: whether a triangle is the share's alone.
fn sides(
    surface: &RenderSurface,
    corners: &Corners,
    share: &Share,
    is_own: impl Fn(u32) -> bool,
) -> Vec<([u32; 2], bool)> {
    let edges = corners.edges();
    let mut sides = Vec::new();
    for &t in &share.whole {
        if edges
            .across(t)
            .iter()
            .all(|&other| other != NO_TRIANGLE && is_own(other))
        {
            continue;
        }
        for k in 0..3 {
            let Some((edge, forward)) = edges.of_side(surface, 3 * t + k) else {
                continue;
            };
            let mut around = edges.triangles_at(edge);
            let is_open = edges.is_open(edge);
            if is_open || around.any(|t| !is_own(t)) {
                let [low, high] = edges.ends(edge);
                sides.push((if forward { [low, high] } else { [high, low] }, is_open));
            }
        }
    }
    for (t, polygon) in share.numbered() {
        let touches_hole = edges.across(t).contains(&NO_TRIANGLE);
        for (i, (from, _)) in polygon.iter().enumerate() {
            let ends = [*from, polygon[(i + 1) % polygon.len()].0];
            sides.push((ends, touches_hole && corners.is_on_hole(t, ends)));
        }
    }
    sides
}
