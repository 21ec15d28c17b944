//! Surfaces of bodies, pieces and balls as recorded meshes: one normal per vertex, a part per material.

use std::borrow::Cow;
use std::collections::HashMap;

use frangible::glam::{DVec3, Vec3};
use frangible::internals::asset::{RenderSurface, linear_color};
use frangible::internals::{FineFaces, RenderMesh, box_projection};
use frangible::{Asset, Fragment, TriMesh};
use frangible_recording::{MeshPart, RecordedMesh};

use crate::cracks::add_cracks;
use crate::light::lightened;
use crate::output::{Simplified, TOLERANCE, WANTED_OF_PIECE};

/// Indices of the surfaces (materials) of the outside and of the crack faces.
#[derive(Clone, Debug)]
pub(crate) struct BodySurfaces {
    /// Surface of an outside without materials of its own.
    pub(crate) outer: usize,
    pub(crate) inner: usize,
    /// Surface of cracks that part nothing.
    pub(crate) crack: usize,
    /// Surface of the lines where they end.
    pub(crate) crack_line: usize,
    /// True if one looks into the body.
    pub(crate) clear: bool,
    /// Surfaces of the materials that came with a mesh file.
    pub(crate) authored: Vec<usize>,
    /// True if the colours of vertices are sRGB.
    pub(crate) srgb_colors: bool,
    /// Largest distance of simplified crack faces from the computed ones, m; none: they are drawn as computed.
    pub(crate) light: Option<f32>,
    /// Detail of crack faces below the resolution of the mesh; none: they are drawn as computed.
    pub(crate) fine: Option<FineFaces>,
    /// Name of the body, and the name of its mesh in the file that it came from, which may be empty.
    pub(crate) names: [String; 2],
}

impl BodySurfaces {
    /// Name of the mesh of a node: the author's in place of the body's.
    fn mesh_name(&self, node: &str) -> String {
        let [body, authored] = &self.names;
        match node.strip_prefix(&body[..]) {
            Some(rest) if !authored.is_empty() => format!("{authored}{rest}"),
            _ => node.to_owned(),
        }
    }
}

/// Joins corners that agree in vertex, normal and texture coordinates.
#[derive(Default)]
struct Builder {
    mesh: RecordedMesh,
    /// Position of the mesh's origin in the body frame, m: texture coordinates are the whole body's.
    origin: Vec3,
    /// Looked up only, never iterated.
    known: HashMap<(u32, [u32; 5]), u32>,
}

impl Builder {
    /// A triangle of these vertices, its texture coordinates by box projection where it has none.
    fn triangle(
        &mut self,
        vertices: [u32; 3],
        corners: [Vec3; 3],
        normals: [Vec3; 3],
        uvs: Option<[[f32; 2]; 3]>,
    ) -> [u32; 3] {
        let [a, b, c] = corners;
        let flat = (b - a).cross(c - a).normalize_or(normals[0]);
        [0, 1, 2].map(|k| {
            let (position, normal) = (corners[k], normals[k]);
            let uv = uvs.map_or_else(|| box_projection(position + self.origin, flat), |uv| uv[k]);
            let [x, y, z] = normal.to_array();
            let key = [x, y, z, uv[0], uv[1]].map(f32::to_bits);
            let mesh = &mut self.mesh;
            *self.known.entry((vertices[k], key)).or_insert_with(|| {
                mesh.positions.push(position);
                mesh.normals.push(normal);
                mesh.uvs.push(uv);
                (mesh.positions.len() - 1) as u32
            })
        })
    }

    /// Gives new vertices the other attributes of those of a surface.
    fn paint(&mut self, sources: [u32; 3], vertices: &[u32; 3], surface: &RenderSurface) {
        let mesh = &mut self.mesh;
        for (source, &vertex) in sources.map(|v| v as usize).into_iter().zip(vertices) {
            if !surface.colors.is_empty() && mesh.colors.len() == vertex as usize {
                mesh.colors.push(surface.colors[source]);
            }
            for (uvs, all) in mesh.more_uvs.iter_mut().zip(&surface.more_uvs) {
                if uvs.len() == vertex as usize {
                    uvs.push(all[source]);
                }
            }
        }
    }

    /// The mesh with its triangles sorted by surface.
    fn finish(mut self, name: String, parts: Vec<(usize, Vec<u32>)>) -> RecordedMesh {
        self.mesh.name = name;
        for (surface, indices) in parts {
            if !indices.is_empty() {
                self.mesh.parts.push(MeshPart { surface, indices });
            }
        }
        self.mesh
    }
}

/// The whole body: only its outside, as its author drew it if it has one.
pub(crate) fn whole(node: &str, asset: &Asset, surfaces: &BodySurfaces) -> RecordedMesh {
    let name = surfaces.mesh_name(node);
    let mut builder = Builder::default();
    if let Some(render) = asset.render() {
        builder.mesh.more_uvs = vec![Vec::new(); render.more_uvs.len()];
        let mut triangles = Vec::with_capacity(render.triangles.len());
        for (triangle, normals) in render.triangles.iter().zip(render.corner_normals()) {
            let corners = triangle.map(|v| render.positions[v as usize]);
            let uvs = (!render.uvs.is_empty()).then(|| triangle.map(|v| render.uvs[v as usize]));
            triangles.push(builder.triangle(*triangle, corners, normals, uvs));
            builder.paint(*triangle, &triangles[triangles.len() - 1], render);
        }
        linear(&mut builder.mesh.colors, surfaces);
        let parts = by_material(&triangles, &render.material_of_triangle, surfaces);
        return builder.finish(name, parts);
    }
    let (positions, outside) = (&asset.fracture().positions, &asset.surface().triangles);
    let mut drawn = undrawn(positions, outside, &asset.surface().normals, Vec3::ZERO);
    if let Some(tolerance) = surfaces.light {
        drawn = lightened(&drawn, Vec3::ZERO, false, tolerance).0;
    }
    builder.mesh = vertices(&drawn);
    let indices = drawn.triangles.as_flattened().to_vec();
    builder.finish(name, vec![(surfaces.outer, indices)])
}

/// Origin of the frame of a body in that of the unbroken body, m: zero except for pieces.
pub(crate) fn origin(asset: &Asset) -> DVec3 {
    asset.portion().map_or(DVec3::ZERO, |p| p.origin())
}

/// A piece as it is drawn.
pub(crate) struct DrawnPiece {
    pub(crate) mesh: RecordedMesh,
    /// Triangles before and after the simplification, and its error.
    pub(crate) simplified: Simplified,
}

/// A piece: outside, crack faces, and cracks that entered it without parting it; these are left out of a light drawing.
///
/// `parent`: the [`origin`] of what broke.
pub(crate) fn piece(
    node: &str,
    fragment: &Fragment,
    parent: DVec3,
    surfaces: &BodySurfaces,
) -> DrawnPiece {
    let origin = fragment.mass.centre.as_vec3();
    let mut drawn = match &fragment.render {
        Some(render) => Cow::Borrowed(render),
        None => Cow::Owned(undrawn_piece(&fragment.mesh, origin)),
    };
    let mut simplified = Simplified::default();
    if let Some(tolerance) = surfaces.light {
        let is_drawn = fragment.render.is_some();
        let (light, error) = lightened(&drawn, origin, is_drawn, tolerance);
        simplified = Simplified {
            full: drawn.triangles.len(),
            light: light.triangles.len(),
            wanted: WANTED_OF_PIECE,
            error,
            share: error / tolerance * TOLERANCE,
        };
        drawn = Cow::Owned(light);
    }
    if let Some(fine) = &surfaces.fine {
        let origin = (parent + fragment.mass.centre).as_vec3();
        drawn = Cow::Owned(fine.of(&drawn, origin));
    }
    let mut builder = Builder {
        mesh: vertices(&drawn),
        ..Builder::default()
    };
    linear(&mut builder.mesh.colors, surfaces);
    let (outside, faces) = drawn.triangles.split_at(drawn.outer_triangles);
    let mut parts = by_material(outside, &drawn.material_of_triangle, surfaces);
    parts.push((surfaces.inner, faces.as_flattened().to_vec()));
    let mut mesh = builder.finish(surfaces.mesh_name(node), parts);
    if surfaces.light.is_none() {
        add_cracks(&mut mesh, &fragment.mesh.cracks, surfaces);
    }
    DrawnPiece { mesh, simplified }
}

/// A piece of a body that no one drew. `origin`: its centre of mass in the body frame, m.
pub(crate) fn undrawn_piece(mesh: &TriMesh, origin: Vec3) -> RenderMesh {
    RenderMesh {
        outer_triangles: mesh.outer_triangles,
        ..undrawn(&mesh.positions, &mesh.triangles, &mesh.normals, origin)
    }
}

/// A surface that no one drew. `origin`: that of its positions in the body frame, m.
fn undrawn(
    positions: &[Vec3],
    triangles: &[[u32; 3]],
    normals: &[[Vec3; 3]],
    origin: Vec3,
) -> RenderMesh {
    let mut builder = Builder {
        origin,
        ..Builder::default()
    };
    let corners = triangles.iter().zip(normals);
    let triangles: Vec<_> = corners
        .map(|(triangle, &normals)| {
            let corners = triangle.map(|v| positions[v as usize]);
            builder.triangle(*triangle, corners, normals, None)
        })
        .collect();
    RenderMesh {
        positions: builder.mesh.positions,
        normals: builder.mesh.normals,
        uvs: builder.mesh.uvs,
        outer_triangles: triangles.len(),
        triangles,
        ..RenderMesh::default()
    }
}

fn vertices(render: &RenderMesh) -> RecordedMesh {
    RecordedMesh {
        positions: render.positions.clone(),
        normals: render.normals.clone(),
        uvs: render.uvs.clone(),
        more_uvs: render.more_uvs.clone(),
        colors: render.colors.clone(),
        ..RecordedMesh::default()
    }
}

/// Makes the colours of vertices linear.
fn linear(colors: &mut [[f32; 4]], surfaces: &BodySurfaces) {
    if surfaces.srgb_colors {
        colors
            .iter_mut()
            .for_each(|color| *color = linear_color(*color));
    }
}

/// Indices of the triangles of each material; without materials all are of the outer surface.
fn by_material(
    triangles: &[[u32; 3]],
    material_of_triangle: &[u32],
    surfaces: &BodySurfaces,
) -> Vec<(usize, Vec<u32>)> {
    let mut parts: Vec<(usize, Vec<u32>)> =
        surfaces.authored.iter().map(|&s| (s, Vec::new())).collect();
    if material_of_triangle.is_empty() || parts.is_empty() {
        let all = triangles.iter().flatten().copied().collect();
        return vec![(surfaces.outer, all)];
    }
    for (triangle, &material) in triangles.iter().zip(material_of_triangle) {
        parts[material as usize].1.extend(triangle);
    }
    parts
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
