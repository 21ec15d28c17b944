//! Surfaces of bodies, pieces and balls as recorded meshes: one normal per vertex, a part per material.

use std::collections::HashMap;

use frangible::glam::Vec3;
use frangible::{Asset, TriMesh};
use frangible_export::{MeshPart, RecordedMesh};

/// Indices of the surfaces (materials) of the outside and of the crack faces.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BodySurfaces {
    pub(crate) outer: usize,
    pub(crate) inner: usize,
}

/// Joins corners that agree in vertex and normal.
#[derive(Default)]
struct Builder {
    mesh: RecordedMesh,
    /// Looked up only, never iterated.
    known: HashMap<(u32, [u32; 3]), u32>,
}

impl Builder {
    fn corner(&mut self, vertex: u32, position: Vec3, normal: Vec3) -> u32 {
        let mesh = &mut self.mesh;
        *self
            .known
            .entry((vertex, normal.to_array().map(f32::to_bits)))
            .or_insert_with(|| {
                mesh.positions.push(position);
                mesh.normals.push(normal);
                (mesh.positions.len() - 1) as u32
            })
    }
}

/// The whole body: only its outside.
pub(crate) fn whole(name: &str, asset: &Asset, surfaces: BodySurfaces) -> RecordedMesh {
    let mut builder = Builder::default();
    let mut indices = Vec::new();
    for (triangle, normals) in asset.surface.triangles.iter().zip(&asset.surface.normals) {
        for (&v, &n) in triangle.iter().zip(normals) {
            indices.push(builder.corner(v, asset.fracture.positions[v as usize], n));
        }
    }
    builder.mesh.name = name.into();
    builder.mesh.parts.push(MeshPart {
        surface: surfaces.outer,
        indices,
    });
    builder.mesh
}

/// A piece: outside, crack faces, and cracks that entered it without parting it.
pub(crate) fn piece(name: String, mesh: &TriMesh, surfaces: BodySurfaces) -> RecordedMesh {
    let mut builder = Builder::default();
    let (mut outer, mut inner) = (Vec::new(), Vec::new());
    for (i, (triangle, normals)) in mesh.triangles.iter().zip(&mesh.normals).enumerate() {
        let part = if i < mesh.outer_triangles {
            &mut outer
        } else {
            &mut inner
        };
        for (&v, &n) in triangle.iter().zip(normals) {
            part.push(builder.corner(v, mesh.positions[v as usize], n));
        }
    }
    let mut loose = mesh.positions.len() as u32;
    for &[a, b, c] in &mesh.cracks {
        let normal = (b - a).cross(c - a).normalize_or(Vec3::Y);
        // Two-sided: each side its own triangle with its own normal.
        for (corners, n) in [([a, b, c], normal), ([a, c, b], -normal)] {
            for p in corners {
                inner.push(builder.corner(loose, p, n));
                loose += 1;
            }
        }
    }
    builder.mesh.name = name;
    for (surface, indices) in [(surfaces.outer, outer), (surfaces.inner, inner)] {
        if !indices.is_empty() {
            builder.mesh.parts.push(MeshPart { surface, indices });
        }
    }
    builder.mesh
}

/// A ball of this radius, m.
pub(crate) fn ball(radius: f32, surface: usize) -> RecordedMesh {
    const RINGS: u32 = 24;
    const SECTORS: u32 = 48;
    let mut mesh = RecordedMesh {
        name: "ball".into(),
        ..RecordedMesh::default()
    };
    for i in 0..=RINGS {
        for j in 0..=SECTORS {
            let (polar, turn) = (
                std::f32::consts::PI * i as f32 / RINGS as f32,
                std::f32::consts::TAU * j as f32 / SECTORS as f32,
            );
            let n = Vec3::new(
                polar.sin() * turn.cos(),
                polar.cos(),
                -polar.sin() * turn.sin(),
            );
            mesh.positions.push(n * radius);
            mesh.normals.push(n);
        }
    }
    let at = |i: u32, j: u32| i * (SECTORS + 1) + j;
    let mut indices = Vec::new();
    for i in 0..RINGS {
        for j in 0..SECTORS {
            if i > 0 {
                indices.extend([at(i, j), at(i + 1, j), at(i, j + 1)]);
            }
            if i + 1 < RINGS {
                indices.extend([at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)]);
            }
        }
    }
    mesh.parts.push(MeshPart { surface, indices });
    mesh
}
