//! A fragment's share of the render surface and its crack faces, as one mesh.

use glam::{DVec2, DVec3, Vec3};

use super::conform::Corners;
use super::polygon::centre as centre_of;
use super::vertices::Vertex;
use super::{RenderIndex, RenderSurface, Share};
use crate::{RenderMesh, box_projection};

/// A triangle of less area than this, in squares of its longer side at the first corner, is thin.
const THIN: f64 = 1e-6;

/// Corners of a crack face: positions (m, body frame) and normals.
pub(super) type Face = [(DVec3, Vec3); 3];

impl RenderIndex {
    /// A fragment's share as a mesh in the fragment's frame, whose origin is `centre` in the body frame, m. `faces`: how many crack faces are
    /// about to follow. `local` maps the vertices of the whole surface to the mesh's and is `u32::MAX` throughout before and after.
    pub(super) fn assemble<'a>(
        &'a self,
        surface: &'a RenderSurface,
        share: &Share,
        numbered: Option<&Corners>,
        faces: usize,
        centre: DVec3,
        local: &mut [u32],
    ) -> Builder<'a> {
        let mut mesh = Builder {
            mesh: RenderMesh {
                more_uvs: vec![Vec::new(); surface.more_uvs.len()],
                ..RenderMesh::default()
            },
            surface,
            index: self,
            centre,
        };
        // Most surfaces have half as many vertices as triangles, flat shaded ones more; a few polygons have a vertex in their middle.
        let cut = share.corners.len() + 5 * share.pieces.len();
        mesh.reserve(
            share.whole.len() / 2 + cut + share.numbered.len() / 2 + 3 * faces,
            share.whole.len() + cut + faces,
        );
        for &t in &share.whole {
            let mut corners = self.vertices.of(t);
            for corner in &mut corners {
                let known = &mut local[*corner as usize];
                if *known == u32::MAX {
                    let Vertex {
                        source,
                        position,
                        normal,
                        uv,
                    } = *self.vertices.get(*corner);
                    *known = mesh.vertex(position.as_dvec3(), normal, uv, &[(source, 1.0)]);
                }
                *corner = *known;
            }
            mesh.triangle(t, corners);
        }
        for v in share.whole.iter().flat_map(|&t| self.vertices.of(t)) {
            local[v as usize] = u32::MAX;
        }
        for (t, polygon) in &share.pieces {
            let corners: Vec<u32> = polygon.iter().map(|p| mesh.corner(*t, *p, None)).collect();
            mesh.fan(*t, &corners);
        }
        let (mut corners, mut places) = (Vec::new(), Vec::new());
        for (t, polygon) in share.numbered() {
            let place = |number| numbered.map(|corners| corners.place(number));
            corners.clear();
            places.clear();
            for &(number, p) in polygon {
                corners.push(mesh.corner(t, p, place(number)));
                places.push(p);
            }
            if has_thin_fan(&places) {
                let middle = mesh.corner(t, centre_of(&places), None);
                for (k, &from) in corners.iter().enumerate() {
                    mesh.triangle(t, [middle, from, corners[(k + 1) % corners.len()]]);
                }
            } else {
                mesh.fan(t, &corners);
            }
        }
        mesh.mesh.outer_triangles = mesh.mesh.triangles.len();
        mesh
    }
}

/// Returns true if the fan from the first corner of a convex polygon has a thin triangle, as where corners lie on its sides.
fn has_thin_fan(polygon: &[DVec2]) -> bool {
    let [from, others @ ..] = polygon else {
        return false;
    };
    let mut fan = others.windows(2);
    fan.any(|w| {
        let (a, b) = (w[0] - from, w[1] - from);
        a.perp_dot(b) < THIN * a.length_squared().max(b.length_squared())
    })
}

/// A mesh to which crack faces are added.
pub(super) struct Builder<'a> {
    pub(super) mesh: RenderMesh,
    surface: &'a RenderSurface,
    index: &'a RenderIndex,
    centre: DVec3,
}

impl Builder<'_> {
    fn reserve(&mut self, vertices: usize, triangles: usize) {
        let mesh = &mut self.mesh;
        mesh.positions.reserve(vertices);
        mesh.normals.reserve(vertices);
        mesh.uvs.reserve(vertices);
        for uvs in &mut mesh.more_uvs {
            uvs.reserve(vertices);
        }
        if !self.surface.colors.is_empty() {
            mesh.colors.reserve(vertices);
        }
        mesh.triangles.reserve(triangles);
    }

    /// Triangles between the first corner of a convex polygon and its other sides.
    fn fan(&mut self, t: u32, corners: &[u32]) {
        for k in 2..corners.len() {
            self.triangle(t, [corners[0], corners[k - 1], corners[k]]);
        }
    }

    /// A vertex within a render triangle, at its weights of the second and third vertex; `place`: where it is, if that is known exactly.
    fn corner(&mut self, t: u32, p: DVec2, place: Option<DVec3>) -> u32 {
        let weights = [1.0 - p.x - p.y, p.x, p.y];
        let surface = self.surface;
        let sources = surface.triangles[t as usize];
        let of = [0, 1, 2].map(|i| (sources[i], weights[i]));
        let triangle = sources.map(|v| v as usize);
        let blend = |x: [DVec3; 3]| x[0] * weights[0] + x[1] * weights[1] + x[2] * weights[2];
        let own = || blend(triangle.map(|v| surface.positions[v].as_dvec3()));
        let position = place.unwrap_or_else(own);
        let flat = self.index.flat[t as usize];
        let normals = (self.index.vertices.of(t)).map(|v| self.index.vertices.get(v).normal);
        let smooth = blend(normals.map(Vec3::as_dvec3));
        let normal = smooth.as_vec3().normalize_or(flat);
        let uv = if surface.uvs.is_empty() {
            box_projection(position.as_vec3(), flat)
        } else {
            mean(&surface.uvs, &of)
        };
        self.vertex(position, normal, uv, &of)
    }

    fn triangle(&mut self, t: u32, corners: [u32; 3]) {
        self.mesh.triangles.push(corners);
        if let Some(&material) = self.surface.material_of_triangle.get(t as usize) {
            self.mesh.material_of_triangle.push(material);
        }
    }

    pub(super) fn crack_face(&mut self, face: &Face) {
        let [a, b, c] = face.map(|corner| corner.0);
        let flat = (b - a).cross(c - a).as_vec3().normalize_or(face[0].1);
        let mut corners = [0; 3];
        for (corner, &(position, normal)) in corners.iter_mut().zip(face) {
            let uv = box_projection(position.as_vec3(), flat);
            *corner = self.vertex(position, normal, uv, &[]);
        }
        self.mesh.triangles.push(corners);
    }

    /// `of`: vertices of the surface whose weighted mean gives the other attributes; none: white, and zero.
    fn vertex(&mut self, position: DVec3, normal: Vec3, uv: [f32; 2], of: &[(u32, f64)]) -> u32 {
        let (mesh, surface) = (&mut self.mesh, self.surface);
        mesh.positions.push((position - self.centre).as_vec3());
        mesh.normals.push(normal);
        mesh.uvs.push(uv);
        for (uvs, all) in mesh.more_uvs.iter_mut().zip(&surface.more_uvs) {
            uvs.push(mean(all, of));
        }
        if !surface.colors.is_empty() {
            let color = match of {
                [] => [1.0; 4],
                _ => mean(&surface.colors, of).map(|x: f32| x.clamp(0.0, 1.0)),
            };
            mesh.colors.push(color);
        }
        (mesh.positions.len() - 1) as u32
    }
}

/// Weighted sum of rows.
fn mean<const N: usize>(rows: &[[f32; N]], of: &[(u32, f64)]) -> [f32; N] {
    std::array::from_fn(|k| {
        let parts = of
            .iter()
            .map(|&(v, weight)| f64::from(rows[v as usize][k]) * weight);
        parts.sum::<f64>() as f32
    })
}
