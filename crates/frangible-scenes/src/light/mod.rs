//! Lighter meshes of pieces: fewer triangles on crack faces, the outer surface as its author drew it.
//!
//! Edges of crack faces are collapsed, those first that change the surface least (quadric error, Garland, Heckbert 1997), each to the place that
//! fits best. Corners between the outer surface and a crack face move only along their border, onto a neighbour. Corners of an outer surface that its
//! author drew stay, unless it is the same without them, in place and in every attribute; one that the mesher made is simplified like crack faces.
//! The mesh stays closed where it was.
//!
//! The distance between the two meshes is measured at the corners and middles of the triangles of each, for every collapse before it is made. So the
//! largest distance is always kept, and a collapse that keeps it is never left out because of an estimate.

mod collapse;
mod near;
mod quadric;
mod topology;

use std::collections::BTreeMap;

use frangible::glam::Vec3;
use frangible::internals::mesh::smooth_normals;
use frangible::internals::{RenderMesh, box_projection};

use collapse::collapse;
use near::Full;
use topology::{INNER, MADE, Topology};

/// The mesh with simplified crack faces, and its largest distance from the given one, m: at most the tolerance.
///
/// `origin` is the origin of the mesh in the frame of the box projection, m. `is_drawn`: its outer surface is its author's.
pub(crate) fn lightened(
    mesh: &RenderMesh,
    origin: Vec3,
    is_drawn: bool,
    tolerance: f32,
) -> (RenderMesh, f32) {
    let mut topology = Topology::of(mesh, is_drawn);
    let mut full = Full::new(&topology, f64::from(tolerance));
    collapse(mesh, &mut topology, &mut full, f64::from(tolerance));
    let light = drawn(mesh, &topology, origin);
    let error = full.distance(&light.positions, &light.triangles);
    if error <= tolerance {
        (light, error)
    } else {
        (mesh.clone(), 0.0)
    }
}

/// The triangles that are left, as a mesh.
fn drawn(mesh: &RenderMesh, topology: &Topology, origin: Vec3) -> RenderMesh {
    let mut light = RenderMesh {
        more_uvs: vec![Vec::new(); mesh.more_uvs.len()],
        ..RenderMesh::default()
    };
    // The vertex of the light mesh for each of the full one.
    let mut number = vec![u32::MAX; mesh.positions.len()];
    let left = || topology.faces.iter().filter(|face| face.is_left);
    for face in left().filter(|face| face.wedges[0] < MADE) {
        let corners = face.wedges.map(|wedge| {
            let source = topology.wedges[wedge as usize].vertex as usize;
            if number[source] == u32::MAX {
                number[source] = light.push_vertex_of(mesh, source);
            }
            number[source]
        });
        light.triangles.push(corners);
        let material = mesh.material_of_triangle.get(face.source as usize);
        light.material_of_triangle.extend(material);
    }
    let of = |kind: u32| -> Vec<[u32; 3]> {
        let faces = left().filter(|face| face.wedges[0] == kind);
        faces.map(|face| face.places).collect()
    };
    let has_colors = !mesh.colors.is_empty();
    add(&mut light, &topology.places, &of(MADE), has_colors, origin);
    light.outer_triangles = light.triangles.len();
    add(&mut light, &topology.places, &of(INNER), has_colors, origin);
    light
}

/// Adds triangles whose attributes are made anew: smooth normals, texture coordinates by box projection, white.
fn add(
    light: &mut RenderMesh,
    at: &[Vec3],
    triangles: &[[u32; 3]],
    has_colors: bool,
    origin: Vec3,
) {
    let mut known = BTreeMap::new();
    for (places, normals) in triangles.iter().zip(smooth_normals(at, triangles)) {
        let [a, b, c] = places.map(|p| at[p as usize]);
        let flat = (b - a).cross(c - a).normalize_or(normals[0]);
        let corner = |k: usize| {
            let (position, normal) = (at[places[k] as usize], normals[k]);
            let uv = box_projection(position + origin, flat);
            let bits = |x: f32| (x + 0.0).to_bits();
            let key = (places[k], normal.to_array().map(bits), uv.map(bits));
            *known
                .entry(key)
                .or_insert_with(|| light.push_inner_vertex(position, normal, uv, has_colors))
        };
        let corners = [0, 1, 2].map(corner);
        light.triangles.push(corners);
    }
}

#[cfg(test)]
mod measured;
#[cfg(test)]
mod tests;
