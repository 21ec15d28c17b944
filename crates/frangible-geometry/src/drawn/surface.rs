//! The authored surface, kept for rendering.

use std::collections::HashMap;

use glam::Vec3;

use super::{Image, RenderMaterial};
use crate::smooth_normals;

/// The authored surface, used for rendering and clipping only, never for physics.
///
/// It need not be closed or touch the fracture mesh; only its indices and values are checked.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RenderSurface {
    /// Name that the author gave it; may be empty.
    pub name: String,
    /// Vertex positions, m, body frame.
    pub positions: Vec<Vec3>,
    /// Vertex normals; may be empty.
    pub normals: Vec<Vec3>,
    /// Texture coordinates of the vertices; may be empty.
    pub uvs: Vec<[f32; 2]>,
    /// Further sets of texture coordinates, each of all vertices.
    pub more_uvs: Vec<Vec<[f32; 2]>>,
    /// Vertex colours (red, green, blue and opacity, each 0..=1); may be empty. They can define local weakness, see the module
    /// `weakness` of `frangible-bake`.
    pub colors: Vec<[f32; 4]>,
    /// True if the colours are sRGB, false if they are linear.
    pub srgb_colors: bool,
    /// Vertices of each triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Index of each triangle into [`RenderSurface::materials`]; may be empty.
    pub material_of_triangle: Vec<u32>,
    /// Materials of the triangles.
    pub materials: Vec<RenderMaterial>,
    /// Images of the textures of the materials.
    pub images: Vec<Image>,
}

impl RenderSurface {
    /// Returns unit normals at the corners of each triangle: the authored ones, or averages over the triangles at the corner's
    /// position, except across sharp edges.
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
