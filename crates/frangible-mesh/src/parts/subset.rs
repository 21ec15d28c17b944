//! The mesh of some parts.

use super::Parts;
use crate::{InputGroup, InputMesh};

impl Parts {
    /// The mesh of these parts, with all their attributes; faces that two of them share are left out. All parts of a mesh without shared
    /// faces are the mesh itself.
    #[must_use]
    pub fn mesh(&self, mesh: &InputMesh, parts: &[usize]) -> InputMesh {
        let is_all = (0..self.list.len()).all(|part| parts.contains(&part));
        if is_all && self.shared_faces == 0 && self.loose_sheets == 0 {
            return mesh.clone();
        }
        let mut triangles: Vec<(u32, bool)> = parts
            .iter()
            .filter_map(|&part| self.list.get(part))
            .flat_map(|part| part.triangles.iter().copied())
            .collect();
        triangles.sort_unstable();
        triangles.dedup();
        // A face that is there both ways round has a part on either side.
        let both = |pair: &[(u32, bool)]| pair[0].0 == pair[1].0;
        let inner: Vec<u32> = triangles
            .windows(2)
            .filter(|pair| both(pair))
            .map(|pair| pair[0].0)
            .collect();
        triangles.retain(|t| inner.binary_search(&t.0).is_err());
        subset(mesh, &triangles)
    }
}

/// These triangles of a mesh, some of them turned, in the order given.
fn subset(mesh: &InputMesh, triangles: &[(u32, bool)]) -> InputMesh {
    let mut vertices: Vec<(u32, bool)> = triangles
        .iter()
        .flat_map(|&(t, turned)| mesh.triangles[t as usize].map(|v| (v, turned)))
        .collect();
    vertices.sort_unstable();
    vertices.dedup();
    let number = |v: u32, turned: bool| {
        // Present by construction, so the fallback never shows.
        vertices.binary_search(&(v, turned)).unwrap_or(0) as u32
    };
    fn of<T: Copy>(list: &[T], vertices: &[(u32, bool)]) -> Vec<T> {
        match list.is_empty() {
            true => Vec::new(),
            false => vertices.iter().map(|&(v, _)| list[v as usize]).collect(),
        }
    }
    let mut normals = of(&mesh.normals, &vertices);
    for (normal, (_, turned)) in normals.iter_mut().zip(&vertices) {
        if *turned {
            *normal = -*normal;
        }
    }
    let materials = &mesh.material_of_triangle;
    InputMesh {
        positions: of(&mesh.positions, &vertices),
        normals,
        uvs: of(&mesh.uvs, &vertices),
        more_uvs: mesh.more_uvs.iter().map(|uvs| of(uvs, &vertices)).collect(),
        colors: of(&mesh.colors, &vertices),
        srgb_colors: mesh.srgb_colors,
        triangles: triangles
            .iter()
            .map(|&(t, turned)| {
                let [a, b, c] = mesh.triangles[t as usize].map(|v| number(v, turned));
                if turned { [a, c, b] } else { [a, b, c] }
            })
            .collect(),
        material_of_triangle: match materials.is_empty() {
            true => Vec::new(),
            false => triangles
                .iter()
                .map(|&(t, _)| materials[t as usize])
                .collect(),
        },
        materials: mesh.materials.clone(),
        images: mesh.images.clone(),
        groups: groups(mesh, triangles),
        skipped_faces: mesh.skipped_faces,
        left_out: mesh.left_out.clone(),
    }
}

/// The groups of these triangles, which are sorted by their numbers in the mesh.
fn groups(mesh: &InputMesh, triangles: &[(u32, bool)]) -> Vec<InputGroup> {
    let before = |t: u32| triangles.partition_point(|&(own, _)| own < t) as u32;
    let groups = mesh.groups.iter().map(|group| InputGroup {
        name: group.name.clone(),
        triangles: before(group.triangles.start)..before(group.triangles.end),
    });
    groups.filter(|group| !group.triangles.is_empty()).collect()
}
