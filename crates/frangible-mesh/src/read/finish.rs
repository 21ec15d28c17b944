//! Last checks and completions, the same for the mesh of every format.

use glam::{Vec2, Vec3};

use super::{ReadError, check_triangles, check_vertices};
use crate::{InputMaterial, InputMesh};

/// Stands for “no material” until the mesh is finished.
pub(crate) const NO_MATERIAL: u32 = u32::MAX;

/// Colour of vertices that have none where others have one.
pub(crate) const WHITE: [f32; 4] = [1.0; 4];

/// Checks coordinates and sizes, makes normals unit and completes missing ones, gives material-less triangles the
/// default material if others have one. Indices have been checked by the reader.
pub(crate) fn finish(mut mesh: InputMesh) -> Result<InputMesh, ReadError> {
    if mesh.triangles.is_empty() {
        return Err(ReadError::NoTriangles);
    }
    check_triangles(mesh.triangles.len() as u64)?;
    check_vertices(mesh.positions.len() as u64)?;
    if let Some(at) = mesh.positions.iter().position(|p| !p.is_finite()) {
        return Err(ReadError::NotFinite { vertex: at + 1 });
    }
    complete_normals(&mut mesh);
    complete_uvs(&mut mesh);
    complete_colors(&mut mesh);
    complete_materials(&mut mesh);
    Ok(mesh)
}

fn complete_normals(mesh: &mut InputMesh) {
    for normal in &mut mesh.normals {
        *normal = normal.as_dvec3().normalize_or_zero().as_vec3();
    }
    if mesh.normals.iter().all(|n| *n == Vec3::ZERO) {
        mesh.normals.clear();
        return;
    }
    let lacks: Vec<bool> = mesh.normals.iter().map(|n| *n == Vec3::ZERO).collect();
    if !lacks.contains(&true) {
        return;
    }
    let mut sums = vec![glam::DVec3::ZERO; lacks.len()];
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|v| mesh.positions[v as usize]);
        let across = (b - a).cross(c - a);
        for &v in triangle {
            sums[v as usize] += across;
        }
    }
    for (v, sum) in sums.iter().enumerate().filter(|&(v, _)| lacks[v]) {
        mesh.normals[v] = sum.normalize_or(glam::DVec3::Y).as_vec3();
    }
}

fn complete_uvs(mesh: &mut InputMesh) {
    let count = mesh.positions.len();
    for uvs in &mut mesh.more_uvs {
        uvs.resize(count, Vec2::ZERO);
    }
    for uv in mesh
        .uvs
        .iter_mut()
        .chain(mesh.more_uvs.iter_mut().flatten())
    {
        if !uv.is_finite() {
            *uv = Vec2::ZERO;
        }
    }
}

/// A colour that cannot be used costs paint, not the shape: it is logged.
fn complete_colors(mesh: &mut InputMesh) {
    mesh.srgb_colors &= !mesh.colors.is_empty();
    let (mut not_numbers, mut outside) = (0, 0);
    for color in &mut mesh.colors {
        if !color.iter().all(|x| x.is_finite()) {
            *color = WHITE;
            not_numbers += 1;
        } else if !color.iter().all(|x| (0.0..=1.0).contains(x)) {
            *color = color.map(|x| x.clamp(0.0, 1.0));
            outside += 1;
        }
    }
    if not_numbers > 0 {
        log::warn!(
            "{not_numbers} vertices have a colour that is not a finite number; they are read as white"
        );
    }
    if outside > 0 {
        log::warn!("{outside} vertices have a colour outside 0 to 1; it is clamped to that range");
    }
}

fn complete_materials(mesh: &mut InputMesh) {
    if mesh.material_of_triangle.iter().all(|&m| m == NO_MATERIAL) {
        mesh.material_of_triangle.clear();
        mesh.materials.clear();
        mesh.images.clear();
        return;
    }
    let default = mesh.materials.len() as u32;
    let mut needs_default = false;
    for material in &mut mesh.material_of_triangle {
        if *material == NO_MATERIAL {
            *material = default;
            needs_default = true;
        }
    }
    if needs_default {
        mesh.materials.push(InputMaterial::default());
    }
}
