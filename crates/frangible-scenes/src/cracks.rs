//! Geometry for drawing partial cracks, which separate no piece.
//!
//! Such a crack is a surface without thickness inside a body: invisible from
//! outside, and seen edge-on in a pane. Besides its faces, a ridge is therefore
//! drawn along its border, wide enough to be seen as a line and slightly raised
//! above the surface. The part of the border inside the body has a ridge too, so
//! that a transparent body shows the extent of the crack.

use std::collections::BTreeMap;

use frangible::Asset;
use frangible::glam::Vec3;
use frangible::internals::BodyState;
use frangible_recording::{MeshPart, RecordedMesh};

use crate::meshes::BodySurfaces;

/// Half the width of the line, of the length of the box around the body.
const HALF_WIDTH: f32 = 0.0008;

/// Height of the line above the surface, in half widths: a surface as its author drew it lies less exactly where the crack ends.
const HEIGHT: f32 = 0.8;
const HEIGHT_ON_AUTHORED: f32 = 3.0;

/// Corners nearer than this are one, of the length of the box around the body.
const SAME: f32 = 1e-5;

/// A thing's mesh with the cracks that its body got since the mesh was made; `None` where there are none.
pub(crate) fn with_cracks(
    mesh: &RecordedMesh,
    asset: &Asset,
    state: &BodyState,
    surfaces: &BodySurfaces,
) -> Option<RecordedMesh> {
    if surfaces.light.is_some() {
        return None;
    }
    let centre = asset.mass().centre.as_vec3();
    let mut triangles = Vec::new();
    for (corners, count) in state.new_faces(asset.fracture()) {
        for k in 2..count {
            triangles.push([corners[0], corners[k - 1], corners[k]].map(|p| p - centre));
        }
    }
    if triangles.is_empty() {
        return None;
    }
    let mut mesh = mesh.clone();
    add_cracks(&mut mesh, &triangles, surfaces);
    Some(mesh)
}

/// Adds these triangles of cracks, in the frame of the mesh, m, and lines along their border.
pub(crate) fn add_cracks(
    mesh: &mut RecordedMesh,
    triangles: &[[Vec3; 3]],
    surfaces: &BodySurfaces,
) {
    let none = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    let points = mesh.positions.iter();
    let (low, high) = points.fold(none, |(low, high), &p| (low.min(p), high.max(p)));
    let size = (high - low).length();
    if triangles.is_empty() || !size.is_finite() || size <= 0.0 {
        return;
    }
    let mut faces = Part::new(surfaces.crack);
    for &[a, b, c] in triangles {
        let normal = (b - a).cross(c - a).normalize_or(Vec3::Y);
        if surfaces.clear {
            faces.triangle(mesh, [a, b, c], normal);
        } else {
            // In an opaque body each side has a face of its own.
            faces.triangle(mesh, [a, b, c], normal);
            faces.triangle(mesh, [a, c, b], -normal);
        }
    }
    let half = HALF_WIDTH * size;
    let height = half
        * if surfaces.authored.is_empty() {
            HEIGHT
        } else {
            HEIGHT_ON_AUTHORED
        };
    let mut lines = Part::new(surfaces.crack_line);
    for ([from, to], inside) in border(triangles, SAME * size) {
        ridge(mesh, &mut lines, [from, to], inside, half, height);
    }
    mesh.parts.extend([faces.part, lines.part]);
}

/// Sides of triangles that no other triangle has, each with the third corner of its own.
fn border(triangles: &[[Vec3; 3]], same: f32) -> Vec<([Vec3; 2], Vec3)> {
    let key = |p: Vec3| (p / same).round().to_array().map(|part| part as i64);
    let mut sides: BTreeMap<[[i64; 3]; 2], (usize, [Vec3; 2], Vec3)> = BTreeMap::new();
    for corners in triangles {
        for k in 0..3 {
            let [a, b, c] = [0, 1, 2].map(|i| corners[(k + i) % 3]);
            let mut ends = [key(a), key(b)];
            ends.sort_unstable();
            if ends[0] != ends[1] {
                sides.entry(ends).or_insert((0, [a, b], c)).0 += 1;
            }
        }
    }
    let alone = sides.into_values().filter(|(count, ..)| *count == 1);
    alone.map(|(_, ends, inside)| (ends, inside)).collect()
}

/// A ridge along a side: two flanks and a top.
fn ridge(
    mesh: &mut RecordedMesh,
    part: &mut Part,
    [from, to]: [Vec3; 2],
    inside: Vec3,
    half: f32,
    height: f32,
) {
    let along = (to - from).normalize_or_zero();
    let outward = from - inside;
    let outward = (outward - along * outward.dot(along)).normalize_or_zero();
    let across = along.cross(outward);
    if across == Vec3::ZERO {
        return;
    }
    let (aside, up) = (across * half, outward * height);
    let corner = |end: Vec3, side: f32, top: f32| end + aside * side + up * top;
    for (side, normal) in [(1.0, across), (-1.0, -across)] {
        let quad = [
            corner(from, side, -1.0),
            corner(to, side, -1.0),
            corner(to, side, 1.0),
            corner(from, side, 1.0),
        ];
        part.quad(mesh, quad, normal);
    }
    let top = [
        corner(from, -1.0, 1.0),
        corner(from, 1.0, 1.0),
        corner(to, 1.0, 1.0),
        corner(to, -1.0, 1.0),
    ];
    part.quad(mesh, top, outward);
}

/// Triangles of one surface that are being added.
struct Part {
    part: MeshPart,
}

impl Part {
    fn new(surface: usize) -> Self {
        Self {
            part: MeshPart {
                surface,
                indices: Vec::new(),
            },
        }
    }

    fn triangle(&mut self, mesh: &mut RecordedMesh, corners: [Vec3; 3], normal: Vec3) {
        let first = mesh.positions.len() as u32;
        // Lines and faces of cracks are of one colour.
        if mesh.uvs.len() == mesh.positions.len() {
            mesh.uvs.extend([[0.0; 2]; 3]);
        }
        for uvs in &mut mesh.more_uvs {
            uvs.extend([[0.0; 2]; 3]);
        }
        if !mesh.colors.is_empty() {
            mesh.colors.extend([[1.0; 4]; 3]);
        }
        mesh.positions.extend(corners);
        mesh.normals.extend([normal; 3]);
        self.part.indices.extend([first, first + 1, first + 2]);
    }

    /// A quadrilateral whose corners go round either way; its front is where the normal points.
    fn quad(&mut self, mesh: &mut RecordedMesh, [a, b, c, d]: [Vec3; 4], normal: Vec3) {
        for [p, q, r] in [[a, b, c], [a, c, d]] {
            let front = (q - p).cross(r - p).dot(normal) >= 0.0;
            let corners = if front { [p, q, r] } else { [p, r, q] };
            self.triangle(mesh, corners, normal);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_crack_has_a_line_around_it_and_none_across() {
        let [a, b, c, d] =
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| Vec3::new(x, y, 0.0));
        let sides = border(&[[a, b, c], [a, c, d]], 1e-5);
        assert_eq!(sides.len(), 4);
        let across = |&([p, q], _): &([Vec3; 2], Vec3)| (p - q).length() > 1.1;
        assert!(!sides.iter().any(across));
    }

    #[test]
    fn lines_stand_out_of_the_body_on_all_sides_of_a_crack_through_it() {
        let mut mesh = RecordedMesh {
            positions: vec![Vec3::ZERO, Vec3::ONE],
            normals: vec![Vec3::Y; 2],
            uvs: vec![[0.0; 2]; 2],
            ..RecordedMesh::default()
        };
        let [a, b, c, d] =
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| Vec3::new(x, y, 0.5));
        let surfaces = BodySurfaces {
            outer: 0,
            inner: 1,
            crack: 2,
            crack_line: 3,
            clear: true,
            authored: Vec::new(),
            srgb_colors: false,
            light: None,
            fine: None,
            names: [String::new(), String::new()],
        };
        add_cracks(&mut mesh, &[[a, b, c], [a, c, d]], &surfaces);
        assert_eq!(mesh.parts.len(), 2);
        assert_eq!(mesh.positions.len(), mesh.normals.len());
        assert_eq!(mesh.positions.len(), mesh.uvs.len());
        let line = &mesh.parts[1];
        assert_eq!((line.surface, line.indices.len()), (3, 4 * 3 * 2 * 3));
        let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        for face in line.indices.chunks_exact(3) {
            let [p, q, r] = [0, 1, 2].map(|k| mesh.positions[face[k] as usize]);
            let normal = mesh.normals[face[0] as usize];
            assert!((q - p).cross(r - p).dot(normal) > 0.0);
            (low, high) = (low.min(p).min(q).min(r), high.max(p).max(q).max(r));
        }
        let out = HALF_WIDTH * HEIGHT * 3.0_f32.sqrt();
        for (found, meant) in [
            (-low.x, out),
            (high.x - 1.0, out),
            (-low.y, out),
            (high.y - 1.0, out),
        ] {
            assert!((found - meant).abs() < 1e-5, "{found} instead of {meant}");
        }
    }
}
