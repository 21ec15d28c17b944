//! A fragment's share of the render surface and its crack faces, as one mesh.

use glam::{DVec2, DVec3, Vec3};

use super::conform::Corners;
use super::polygon::centre as centre_of;
use super::{RenderIndex, RenderSurface, Share};
use crate::{RenderMesh, box_projection};

/// A triangle of less area than this, in squares of its longer side at the first corner, is thin.
const THIN: f64 = 1e-6;

/// Corners of crack faces: positions (m, body frame) and normals.
pub(crate) type Vertices = Vec<[(DVec3, Vec3); 3]>;

impl RenderIndex {
    /// Mesh of a fragment in its frame, whose origin is `centre` in the body frame, m. `local` maps the surface's vertices
    /// to the mesh's and is `u32::MAX` throughout before and after.
    pub(super) fn assemble(
        &self,
        surface: &RenderSurface,
        share: &Share,
        numbered: Option<&Corners>,
        faces: &Vertices,
        centre: DVec3,
        local: &mut [u32],
    ) -> RenderMesh {
        let mut mesh = Builder {
            mesh: RenderMesh::default(),
            surface,
            index: self,
            centre,
        };
        // Most surfaces have half as many vertices as triangles, flat shaded ones more; a numbered polygon is some two triangles.
        let cut = 2 * (share.numbered.len() + share.pieces.len());
        mesh.reserve(
            share.whole.len() / 2 + 2 * cut + 3 * faces.len(),
            share.whole.len() + cut + faces.len(),
        );
        for &t in &share.whole {
            let vertices = surface.triangles[t as usize];
            let mut corners = [0; 3];
            for (k, corner) in corners.iter_mut().enumerate() {
                *corner = mesh.own_corner(t, k, &mut local[vertices[k] as usize]);
            }
            mesh.triangle(t, corners);
        }
        for v in share
            .whole
            .iter()
            .flat_map(|&t| surface.triangles[t as usize])
        {
            local[v as usize] = u32::MAX;
        }
        for (t, polygon) in &share.pieces {
            let corners: Vec<u32> = polygon.iter().map(|p| mesh.corner(*t, *p, None)).collect();
            mesh.fan(*t, &corners);
        }
        let (mut corners, mut places) = (Vec::new(), Vec::new());
        for (t, polygon) in &share.numbered {
            let place = |number| numbered.map(|corners| corners.place(number));
            corners.clear();
            places.clear();
            for &(number, p) in polygon {
                corners.push(mesh.corner(*t, p, place(number)));
                places.push(p);
            }
            if has_thin_fan(&places) {
                let middle = mesh.corner(*t, centre_of(&places), None);
                for (k, &from) in corners.iter().enumerate() {
                    mesh.triangle(*t, [middle, from, corners[(k + 1) % corners.len()]]);
                }
            } else {
                mesh.fan(*t, &corners);
            }
        }
        mesh.mesh.outer_triangles = mesh.mesh.triangles.len();
        for face in faces {
            mesh.crack_face(face);
        }
        mesh.mesh
    }
}

/// Whether a triangle of the fan from the first corner of a convex polygon is thin: where corners lie on its sides.
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

struct Builder<'a> {
    mesh: RenderMesh,
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
        mesh.triangles.reserve(triangles);
    }

    /// A corner of a render triangle: the one `known` of that vertex if normal and texture coordinates agree.
    fn own_corner(&mut self, t: u32, k: usize, known: &mut u32) -> u32 {
        let surface = self.surface;
        let v = surface.triangles[t as usize][k] as usize;
        let position = surface.positions[v];
        let normal = self.index.normals[t as usize][k];
        let uv = match surface.uvs.get(v) {
            Some(&uv) => uv,
            None => box_projection(position, self.index.flat[t as usize]),
        };
        let same = |&w: &usize| self.mesh.normals[w] == normal && self.mesh.uvs[w] == uv;
        let drawn = Some(*known as usize).filter(|&w| w < self.mesh.positions.len());
        if drawn.filter(same).is_none() {
            *known = self.vertex(position.as_dvec3(), normal, uv);
        }
        *known
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
        let triangle = surface.triangles[t as usize].map(|v| v as usize);
        let mean = |x: [DVec3; 3]| x[0] * weights[0] + x[1] * weights[1] + x[2] * weights[2];
        let own = || mean(triangle.map(|v| surface.positions[v].as_dvec3()));
        let position = place.unwrap_or_else(own);
        let flat = self.index.flat[t as usize];
        let smooth = mean(self.index.normals[t as usize].map(Vec3::as_dvec3));
        let normal = smooth.as_vec3().normalize_or(flat);
        let uv = if surface.uvs.is_empty() {
            box_projection(position.as_vec3(), flat)
        } else {
            let uv = triangle.map(|v| surface.uvs[v]);
            [0, 1].map(|c| {
                let parts = (0..3).map(|i| f64::from(uv[i][c]) * weights[i]);
                parts.sum::<f64>() as f32
            })
        };
        self.vertex(position, normal, uv)
    }

    fn triangle(&mut self, t: u32, corners: [u32; 3]) {
        self.mesh.triangles.push(corners);
        if let Some(&material) = self.surface.material_of_triangle.get(t as usize) {
            self.mesh.material_of_triangle.push(material);
        }
    }

    fn crack_face(&mut self, face: &[(DVec3, Vec3); 3]) {
        let [a, b, c] = face.map(|corner| corner.0);
        let flat = (b - a).cross(c - a).as_vec3().normalize_or(face[0].1);
        let mut corners = [0; 3];
        for (corner, &(position, normal)) in corners.iter_mut().zip(face) {
            *corner = self.vertex(position, normal, box_projection(position.as_vec3(), flat));
        }
        self.mesh.triangles.push(corners);
    }

    fn vertex(&mut self, position: DVec3, normal: Vec3, uv: [f32; 2]) -> u32 {
        self.mesh.positions.push((position - self.centre).as_vec3());
        self.mesh.normals.push(normal);
        self.mesh.uvs.push(uv);
        (self.mesh.positions.len() - 1) as u32
    }
}
