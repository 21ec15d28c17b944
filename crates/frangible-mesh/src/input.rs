//! A mesh as a file holds it.

use glam::{DVec3, Vec2, Vec3};

/// Triangles with whatever attributes the file gave them, untouched.
///
/// Vertices are as in the file: split along texture seams, perhaps loose, perhaps doubled. The repaired, solid
/// geometry is a [`Surface`](crate::Surface).
#[derive(Clone, Debug, Default)]
pub struct InputMesh {
    /// Vertex positions, in the file's unit.
    pub positions: Vec<DVec3>,
    /// One unit normal per vertex, or none at all.
    pub normals: Vec<Vec3>,
    /// One texture coordinate per vertex (as in glTF: origin at the top left of the picture, v down), or none at all.
    pub uvs: Vec<Vec2>,
    /// Vertex indices of each triangle.
    pub triangles: Vec<[u32; 3]>,
    /// Index into [`InputMesh::materials`] of each triangle, or empty when the file names no material.
    pub material_of_triangle: Vec<u32>,
    /// Materials for drawing.
    pub materials: Vec<InputMaterial>,
}

/// A material for drawing, as far as any viewer understands it.
#[derive(Clone, Debug, PartialEq)]
pub struct InputMaterial {
    /// Name in the file.
    pub name: String,
    /// Linear base colour and opacity, 0..=1.
    pub base_color: [f32; 4],
    /// 0 dielectric, 1 metal.
    pub metallic: f32,
    /// 0 mirror, 1 matt.
    pub roughness: f32,
}

impl Default for InputMaterial {
    fn default() -> Self {
        Self {
            name: String::new(),
            base_color: [0.8, 0.8, 0.8, 1.0],
            metallic: 0.0,
            roughness: 0.7,
        }
    }
}
