//! A fragment's share of the render surface and its crack faces, as one mesh.

use glam::{DVec3, Vec3};

use super::{RenderIndex, Share};
use crate::asset::RenderSurface;
use crate::mesh::{RenderMesh, box_projection};

/// Corners of crack faces: positions (m, body frame) and normals.
pub(crate) type Vertices = Vec<[(DVec3, Vec3); 3]>;

impl RenderIndex {
    /// Mesh of a fragment in its frame, whose origin is `centre` in the body frame, m. `local` maps the surface's vertices
    /// to the mesh's and is `u32::MAX` throughout before and after.
    pub(crate) fn assemble(
        &self,
        surface: &RenderSurface,
        share: &Share,
        faces: &Vertices,
        centre: DVec3,
        local: &mut [u32],
    ) -> RenderMesh {
        let mut mesh = Builder {
            mesh: RenderMesh::default(),
            surface,
            normals: &self.normals,
            centre,
        };
        // Without normals or texture coordinates of the author's own, corners take those of their triangle.
        let shared = !surface.normals.is_empty() && !surface.uvs.is_empty();
        for &t in &share.whole {
            let corners = [0, 1, 2].map(|k| {
                let known = &mut local[surface.triangles[t as usize][k] as usize];
                if !shared {
                    *known = u32::MAX;
                }
                if *known == u32::MAX {
                    let mut weights = [0.0; 3];
                    weights[k] = 1.0;
                    *known = mesh.corner(t, weights);
                }
                *known
            });
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
            let corners: Vec<u32> = polygon
                .iter()
                .map(|p| mesh.corner(*t, [1.0 - p.x - p.y, p.x, p.y]))
                .collect();
            for k in 2..corners.len() {
                mesh.triangle(*t, [corners[0], corners[k - 1], corners[k]]);
            }
        }
        mesh.mesh.outer_triangles = mesh.mesh.triangles.len();
        for face in faces {
            mesh.crack_face(face);
        }
        mesh.mesh
    }
}

struct Builder<'a> {
    mesh: RenderMesh,
    surface: &'a RenderSurface,
    normals: &'a [[Vec3; 3]],
    centre: DVec3,
}

impl Builder<'_> {
    /// A vertex at a place of a render triangle.
    fn corner(&mut self, t: u32, weights: [f64; 3]) -> u32 {
        let surface = self.surface;
        let triangle = surface.triangles[t as usize].map(|v| v as usize);
        let corners = triangle.map(|v| surface.positions[v].as_dvec3());
        let mean = |x: [DVec3; 3]| x[0] * weights[0] + x[1] * weights[1] + x[2] * weights[2];
        let [a, b, c] = corners;
        let flat = (b - a).cross(c - a).as_vec3().normalize_or(Vec3::Y);
        let smooth = mean(self.normals[t as usize].map(Vec3::as_dvec3));
        let normal = smooth.as_vec3().normalize_or(flat);
        let position = mean(corners);
        let uv = if surface.uvs.is_empty() {
            box_projection(position.as_vec3(), flat)
        } else {
            let uv = triangle.map(|v| surface.uvs[v]);
            [0, 1].map(|k| {
                (0..3)
                    .map(|i| f64::from(uv[i][k]) * weights[i])
                    .sum::<f64>() as f32
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
        let corners = face.map(|(position, normal)| {
            self.vertex(position, normal, box_projection(position.as_vec3(), flat))
        });
        self.mesh.triangles.push(corners);
    }

    fn vertex(&mut self, position: DVec3, normal: Vec3, uv: [f32; 2]) -> u32 {
        self.mesh.positions.push((position - self.centre).as_vec3());
        self.mesh.normals.push(normal);
        self.mesh.uvs.push(uv);
        (self.mesh.positions.len() - 1) as u32
    }
}
