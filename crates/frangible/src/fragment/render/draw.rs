//! What there is to draw of the fragments, made from what building them left.

use std::collections::HashMap;

use glam::{DVec3, Vec3};

use super::assemble::Vertices;
use super::seam::{Seam, close};
use super::{Parts, number, sides};
use crate::asset::RenderSurface;
use crate::body::Prepared;
use crate::fragment::Fragment;
use crate::mesh::TetMesh;

/// What drawing fragments needs and building them knows.
pub(crate) struct Undrawn {
    /// The boundary divided among the labels.
    pub(crate) parts: Parts,
    /// Label of each fragment.
    pub(crate) labels: Vec<u32>,
    /// Crack faces of each label, in numbers of the points: mesh nodes, then the others.
    pub(crate) faces: Vec<Vec<[u32; 3]>>,
    /// Where the others are, m, body frame.
    pub(crate) points: Vec<DVec3>,
}

/// Gives each fragment its share of the render surface and its crack faces, sewn to that share where the surface faces outwards.
pub(crate) fn draw(
    surface: &RenderSurface,
    mesh: &TetMesh,
    prepared: &Prepared,
    fragments: &mut [Fragment],
    undrawn: Undrawn,
) {
    let Some(index) = &prepared.render else {
        return;
    };
    let reach = prepared.edge;
    let Undrawn {
        parts,
        labels,
        faces,
        mut points,
    } = undrawn;
    let mut shares = {
        // One more for what belongs to the neighbours of a piece.
        let count = faces.len() + 1;
        index.shares(surface, &prepared.surface, &parts, count, reach)
    };
    let nodes = mesh.positions.len();
    let mut rim = parts.rim;
    rim.sort_unstable();
    rim.dedup();
    for v in rim {
        let place = &mut points[v as usize - nodes];
        *place = index.drawn_to(*place, reach);
    }
    let corners = index.edges.as_ref().map(|edges| {
        let corners = number(surface, edges, &mut shares);
        (edges, corners)
    });
    let place = |v: u32| points[v as usize - nodes];
    let mut local = vec![u32::MAX; surface.positions.len()];
    for (fragment, &label) in fragments.iter_mut().zip(&labels) {
        let (share, faces) = (&shares[label as usize], &faces[label as usize]);
        let normals = &fragment.mesh.normals[fragment.mesh.outer_triangles..];
        let seam = match &corners {
            None => Seam::default(),
            Some((edges, corners)) => {
                // Looked up only, never iterated.
                let flat = |face: &[u32; 3], n: &[Vec3; 3]| [0, 1, 2].map(|k| (face[k], n[k]));
                let normal: HashMap<u32, Vec3> = faces
                    .iter()
                    .zip(normals)
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
        let mut inner: Vertices = faces
            .iter()
            .zip(normals)
            .map(|(face, n)| [0, 1, 2].map(|k| (place(face[k]), n[k])))
            .collect();
        inner.extend(&seam.triangles);
        let centre = fragment.mass.centre;
        let corners = corners.as_ref().map(|(_, corners)| corners);
        let drawn = index.assemble(surface, share, corners, &inner, centre, &mut local);
        fragment.render = Some(drawn);
    }
}
