//! Lighter meshes of pieces: fewer triangles on crack faces, the outer surface as its author drew it.
//!
//! Corners of crack faces are moved onto a neighbour, those first that change the surface least (quadric error, Garland, Heckbert 1997, with
//! corners in place of best points, so that attributes stay exact). Corners between the outer surface and a crack face move only along their
//! border. Corners of the outer surface alone stay, unless it is the same without them, in place and in every attribute. The mesh stays closed
//! where it was. The distance from the full mesh is measured, not estimated, and a mesh that is too coarse is made anew.

mod collapse;
mod topology;

use std::collections::BTreeMap;

use frangible::glam::Vec3;
use frangible::internals::mesh::{TriangleTree, smooth_normals};
use frangible::internals::{RenderMesh, box_projection};

use collapse::collapse;
use topology::{INNER, Topology};

/// Distance that a collapse may cause, of the tolerance, at the first try.
const FIRST: f64 = 0.8;

/// Each further try allows this part of the one before.
const FINER: f64 = 0.7;

const TRIES: u32 = 4;

/// The mesh with simplified crack faces, and its largest distance from the given one, m: at most the tolerance.
///
/// `origin` is the origin of the mesh in the frame of the box projection, m.
pub(crate) fn lightened(mesh: &RenderMesh, origin: Vec3, tolerance: f32) -> (RenderMesh, f32) {
    let full = Topology::of(mesh);
    let mut share = FIRST;
    for _ in 0..TRIES {
        let mut topology = full.clone();
        collapse(mesh, &mut topology, share * f64::from(tolerance));
        let light = drawn(mesh, &topology, origin);
        let error = distance(mesh, &light);
        if error <= tolerance {
            return (light, error);
        }
        share *= FINER;
    }
    (mesh.clone(), 0.0)
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
    for face in left().filter(|face| face.wedges[0] != INNER) {
        let corners = face.wedges.map(|wedge| {
            let source = topology.wedges[wedge as usize].vertex as usize;
            if number[source] == u32::MAX {
                number[source] = light.positions.len() as u32;
                light.positions.push(mesh.positions[source]);
                light.normals.push(mesh.normals[source]);
                light.uvs.push(mesh.uvs[source]);
                for (uvs, all) in light.more_uvs.iter_mut().zip(&mesh.more_uvs) {
                    uvs.push(all[source]);
                }
                light.colors.extend(mesh.colors.get(source));
            }
            number[source]
        });
        light.triangles.push(corners);
        let material = mesh.material_of_triangle.get(face.source as usize);
        light.material_of_triangle.extend(material);
    }
    light.outer_triangles = light.triangles.len();
    let inner: Vec<[u32; 3]> = left()
        .filter(|face| face.wedges[0] == INNER)
        .map(|face| face.places)
        .collect();
    let mut known = BTreeMap::new();
    for (places, normals) in inner.iter().zip(smooth_normals(&topology.places, &inner)) {
        let [a, b, c] = places.map(|p| topology.places[p as usize]);
        let flat = (b - a).cross(c - a).normalize_or(normals[0]);
        let corner = |k: usize| {
            let (position, normal) = (topology.places[places[k] as usize], normals[k]);
            let uv = box_projection(position + origin, flat);
            let bits = |x: f32| (x + 0.0).to_bits();
            let key = (places[k], normal.to_array().map(bits), uv.map(bits));
            *known.entry(key).or_insert_with(|| {
                light.positions.push(position);
                light.normals.push(normal);
                light.uvs.push(uv);
                for uvs in &mut light.more_uvs {
                    uvs.push([0.0; 2]);
                }
                if !mesh.colors.is_empty() {
                    light.colors.push([1.0; 4]);
                }
                light.positions.len() as u32 - 1
            })
        };
        light.triangles.push([0, 1, 2].map(corner));
    }
    light
}

/// Largest distance between two meshes, at the corners and middles of the triangles of each, m.
fn distance(full: &RenderMesh, light: &RenderMesh) -> f32 {
    let one_way = |from: &RenderMesh, to: &RenderMesh| {
        let tree = TriangleTree::new(&to.positions, &to.triangles);
        let corners = from.positions.iter().copied();
        let middles = from.triangles.iter().map(|t| {
            let [a, b, c] = t.map(|v| from.positions[v as usize]);
            (a + b + c) / 3.0
        });
        corners
            .chain(middles)
            .map(|p| tree.closest(p).position.distance(p))
            .fold(0.0, f32::max)
    };
    if full.triangles.is_empty() || light.triangles.is_empty() {
        return f32::INFINITY;
    }
    one_way(full, light).max(one_way(light, full))
}

#[cfg(test)]
mod tests;
