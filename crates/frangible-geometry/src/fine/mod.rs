//! Crack faces finer than the mesh that cracks ran through, for pictures.
//!
//! Fracture surfaces are self-affine: the height difference of two points grows with their distance to the power 0.8, for brittle and ductile
//! materials alike (Bouchaud, Lapasset, Planès, Europhys. Lett. 13, 1990). A crack has the roughness of its material at the nodes of the mesh; this
//! module goes on below the mesh's edge, by midpoint displacement. The rim, where a crack face meets the outer surface, is displaced within the outer
//! surface.
//!
//! The displacement is a function of the place in the unbroken body, so the two pieces beside a crack keep fitting, except along single edges whose
//! length is the longest allowed one within rounding. A closed mesh stays closed. Only what is drawn changes: pieces have the mass and the colliders of the computed faces.

mod split;
#[cfg(test)]
mod tests;

use glam::Vec3;

use crate::render::{RenderMesh, box_projection};
use crate::smooth::smooth_normals;
use split::{Face, Faces};

/// Detail of crack faces below the resolution of the mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FineFaces {
    /// Longest edge within a crack face, m; longer ones are halved until none is left. Above zero.
    pub edge: f32,
    /// Mean edge of the mesh that the cracks ran through, m. Above zero.
    pub mesh_edge: f32,
    /// Amplitude of the roughness, m; zero leaves the faces as they are.
    pub amplitude: f32,
    /// Wavelength of the roughness, m. Above zero.
    pub wavelength: f32,
}

impl FineFaces {
    /// A quarter of the edge of the mesh, with the roughness of a material: amplitude and wavelength, m.
    #[must_use]
    pub fn new(mesh_edge: f32, [amplitude, wavelength]: [f64; 2]) -> Self {
        Self {
            edge: 0.25 * mesh_edge,
            mesh_edge,
            amplitude: amplitude as f32,
            wavelength: wavelength as f32,
        }
    }

    /// The mesh with finer crack faces. `origin`: its origin in the frame of the unbroken body, m.
    ///
    /// Crack faces get smooth normals, texture coordinates by [`box_projection`], and white where vertices have colours. Triangles of the outer
    /// surface are divided beside a rim, their attributes interpolated.
    #[must_use]
    pub fn of(&self, mesh: &RenderMesh, origin: Vec3) -> RenderMesh {
        let ranges = [self.edge, self.mesh_edge, self.wavelength];
        let in_range = self.amplitude > 0.0 && ranges.iter().all(|&x| x > 0.0);
        if mesh.outer_triangles == mesh.triangles.len() || !in_range {
            return mesh.clone();
        }
        let (places, place_of) = welded(&mesh.positions);
        let flat = mesh.triangles.iter().map(|corners| {
            let [a, b, c] = corners.map(|v| mesh.positions[v as usize]);
            (b - a).cross(c - a).normalize_or(Vec3::Y)
        });
        let flat: Vec<Vec3> = flat.collect();
        let mut faces = Faces::new(mesh, places, &place_of);
        while faces.halve(self, origin) {}
        let mut fine = RenderMesh {
            more_uvs: vec![Vec::new(); mesh.more_uvs.len()],
            ..RenderMesh::default()
        };
        let (outer, inner) = faces.split();
        add_outer(&mut fine, outer, &faces.vertices, mesh);
        add_inner(&mut fine, inner, &faces.places, &flat, origin);
        fine
    }
}

/// The places of these vertices, each once, and the place of each vertex.
fn welded(positions: &[Vec3]) -> (Vec<Vec3>, Vec<u32>) {
    // Zero has two signs.
    let bits = |v: u32| {
        (positions[v as usize] + Vec3::ZERO)
            .to_array()
            .map(f32::to_bits)
    };
    let mut order: Vec<u32> = (0..positions.len() as u32).collect();
    order.sort_unstable_by_key(|&v| (bits(v), v));
    let mut places = Vec::new();
    let mut place_of = vec![0; positions.len()];
    let mut last = None;
    for v in order {
        if last != Some(bits(v)) {
            last = Some(bits(v));
            places.push(positions[v as usize]);
        }
        place_of[v as usize] = places.len() as u32 - 1;
    }
    (places, place_of)
}

/// Adds the outer surface. `all`: the vertices of the undivided mesh, and after them those on rims; `mesh` is the undivided one.
fn add_outer(fine: &mut RenderMesh, faces: &[Face], all: &RenderMesh, mesh: &RenderMesh) {
    let mut number = vec![u32::MAX; all.positions.len()];
    for face in faces {
        let corners = face.vertices.map(|v| {
            let v = v as usize;
            if number[v] == u32::MAX {
                number[v] = fine.push_vertex_of(all, v);
            }
            number[v]
        });
        fine.triangles.push(corners);
        let material = mesh.material_of_triangle.get(face.source as usize);
        fine.material_of_triangle.extend(material);
    }
    fine.outer_triangles = faces.len();
}

/// Adds crack faces. `flat`: normals of the undivided triangles, for the box projection.
fn add_inner(fine: &mut RenderMesh, faces: &[Face], places: &[Vec3], flat: &[Vec3], origin: Vec3) {
    let triangles: Vec<[u32; 3]> = faces.iter().map(|face| face.corners).collect();
    let has_colors = !fine.colors.is_empty();
    // The latest vertex of a place in each of the six projections.
    let mut known = vec![[u32::MAX; 6]; places.len()];
    for (face, normals) in faces.iter().zip(smooth_normals(places, &triangles)) {
        let along = flat[face.source as usize];
        let axis = along.abs().max_position();
        let projection = 2 * axis + usize::from(along[axis] < 0.0);
        let corners = [0, 1, 2].map(|k| {
            let (position, normal) = (places[face.corners[k] as usize], normals[k]);
            let known = &mut known[face.corners[k] as usize][projection];
            if *known == u32::MAX || fine.normals[*known as usize] != normal {
                let uv = box_projection(position + origin, along);
                *known = fine.push_inner_vertex(position, normal, uv, has_colors);
            }
            *known
        });
        fine.triangles.push(corners);
    }
}
