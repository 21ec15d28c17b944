//! The surface an author drew, carried along for those who draw.

use std::collections::HashMap;

use glam::Vec3;

use crate::smooth_normals;

/// The surface as its author drew it, kept for drawing and for clipping; physics never reads it.
///
/// It need not be closed, nor touch the fracture mesh: only its indices and numbers are checked.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RenderSurface {
    /// Vertex positions, m, body frame.
    pub positions: Vec<Vec3>,
    /// Normals: none, or one per vertex.
    pub normals: Vec<Vec3>,
    /// Texture coordinates: none, or one pair per vertex.
    pub uvs: Vec<[f32; 2]>,
    /// Red, green, blue and opacity, each 0..=1: none, or one per vertex. Weakness may be painted with them, see
    /// the module `weakness` of `frangible-bake`.
    pub colors: Vec<[f32; 4]>,
    /// Vertices of each triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Index into [`RenderSurface::materials`]: none, or one per triangle.
    pub material_of_triangle: Vec<u32>,
    /// Materials of the triangles.
    pub materials: Vec<RenderMaterial>,
}

impl RenderSurface {
    /// Unit normals at the corners of each triangle: the author's, or means over the triangles that share the corner's
    /// place, flat where the surface turns sharply.
    #[must_use]
    pub fn corner_normals(&self) -> Vec<[Vec3; 3]> {
        let corners = |t: &[u32; 3]| t.map(|v| v as usize);
        if !self.normals.is_empty() {
            let own = |t| corners(t).map(|v| self.normals[v].normalize_or(Vec3::Y));
            return self.triangles.iter().map(own).collect();
        }
        let welded = self.welded();
        let triangles: Vec<[u32; 3]> = self
            .triangles
            .iter()
            .map(|t| corners(t).map(|v| welded[v]))
            .collect();
        smooth_normals(&self.positions, &triangles)
    }

    /// Unit normal of each triangle, about; of one without area that of its first corner. `corners`: those at the corners.
    pub(super) fn flat_normals(&self, corners: &[[Vec3; 3]]) -> Vec<Vec3> {
        let flat = |(t, normals): (&[u32; 3], &[Vec3; 3])| {
            let [a, b, c] = t.map(|v| self.positions[v as usize].as_dvec3());
            let normal = (b - a).cross(c - a).normalize_or(normals[0].as_dvec3());
            normal.as_vec3()
        };
        self.triangles.iter().zip(corners).map(flat).collect()
    }

    /// The first vertex at the place of each: vertices that only texture coordinates or normals part are one.
    pub(super) fn welded(&self) -> Vec<u32> {
        // Looked up only, never iterated.
        let mut first = HashMap::new();
        let place = |p: &Vec3| p.to_array().map(|x| (x + 0.0).to_bits());
        (0..)
            .zip(&self.positions)
            .map(|(v, p)| *first.entry(place(p)).or_insert(v))
            .collect()
    }
}

/// Look of some triangles of a [`RenderSurface`], in the metallic-roughness model of glTF 2.0.
#[derive(Clone, Debug, PartialEq)]
pub struct RenderMaterial {
    /// Name its author gave it; may be empty.
    pub name: String,
    /// Linear red, green, blue and opacity, each 0..=1.
    pub base_color: [f32; 4],
    /// 0 (dielectric) to 1 (metal).
    pub metallic: f32,
    /// 0 (mirror) to 1 (matt).
    pub roughness: f32,
}
