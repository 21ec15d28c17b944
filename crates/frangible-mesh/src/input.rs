//! Unmodified meshes from files.

use std::collections::BTreeMap;
use std::ops::Range;

use frangible_geometry::{Image, RenderMaterial};
use glam::{DVec3, Vec2, Vec3};

/// A material for rendering.
pub type InputMaterial = RenderMaterial;

/// Triangles with the attributes from the file, unmodified.
///
/// Vertices may be split along texture seams, unused or duplicate, as in the file. The repaired geometry is a [`Surface`](crate::Surface).
#[derive(Clone, Debug, Default)]
pub struct InputMesh {
    /// Vertex positions, in the file's unit.
    pub positions: Vec<DVec3>,
    /// One unit normal per vertex, or empty.
    pub normals: Vec<Vec3>,
    /// One texture coordinate per vertex, or empty; as in glTF, with the origin at the top left and v down.
    pub uvs: Vec<Vec2>,
    /// Further sets of texture coordinates, each of all vertices; in glTF from `TEXCOORD_1` on.
    pub more_uvs: Vec<Vec<Vec2>>,
    /// One colour per vertex, or empty: red, green, blue and opacity, each 0..=1 and as in the file (linear in glTF, usually sRGB in other
    /// formats). Vertices on a seam have a colour on each side.
    pub colors: Vec<[f32; 4]>,
    /// True if the colours are sRGB, false if they are linear.
    pub srgb_colors: bool,
    /// Vertex indices of each triangle.
    pub triangles: Vec<[u32; 3]>,
    /// Index into [`InputMesh::materials`] of each triangle, or empty if the file has no materials.
    pub material_of_triangle: Vec<u32>,
    /// Materials for rendering.
    pub materials: Vec<InputMaterial>,
    /// Images of their textures.
    pub images: Vec<Image>,
    /// Other named parts: groups and objects of an OBJ, nodes and meshes of a glTF, solids of a text STL.
    pub groups: Vec<InputGroup>,
    /// Number of skipped faces with fewer than three vertices.
    pub skipped_faces: usize,
    /// Contents of the file that are not kept, in words, such as `tangents`; sorted, each once.
    pub left_out: Vec<String>,
}

/// A named range of triangles; a name may have several ranges, and a triangle several names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InputGroup {
    /// Name in the file.
    pub name: String,
    /// Indices of the triangles.
    pub triangles: Range<u32>,
}

impl InputMesh {
    /// Takes down what of the file is not kept.
    #[cfg(feature = "mesh-io")]
    pub(crate) fn leave_out(&mut self, what: impl Into<String>) {
        let what = what.into();
        if let Err(place) = self.left_out.binary_search(&what) {
            self.left_out.insert(place, what);
        }
    }

    /// Returns the triangles of each group and material, sorted by name. Groups and materials with the same name are one part; names without
    /// triangles are omitted.
    #[must_use]
    pub fn named_parts(&self) -> Vec<(String, Vec<u32>)> {
        let mut parts: BTreeMap<&str, Vec<u32>> = BTreeMap::new();
        let count = self.triangles.len() as u32;
        for group in self.groups.iter().filter(|g| !g.name.is_empty()) {
            let run = group.triangles.start..group.triangles.end.min(count);
            parts.entry(&group.name).or_default().extend(run);
        }
        for (t, &material) in (0..count).zip(&self.material_of_triangle) {
            if let Some(material) = self.materials.get(material as usize)
                && !material.name.is_empty()
            {
                parts.entry(&material.name).or_default().push(t);
            }
        }
        parts
            .into_iter()
            .filter(|(_, triangles)| !triangles.is_empty())
            .map(|(name, mut triangles)| {
                triangles.sort_unstable();
                triangles.dedup();
                (name.to_string(), triangles)
            })
            .collect()
    }
}
