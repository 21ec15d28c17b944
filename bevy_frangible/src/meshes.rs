//! Bodies and fragments as Bevy's meshes. Bevy's vectors are of another version of glam than ours: numbers pass as arrays.

use bevy::asset::RenderAssetUsages;
use bevy::mesh::{Indices, PrimitiveTopology};
use bevy::prelude::*;
use frangible::glam;
use frangible::internals::RenderMesh;
use frangible::internals::asset::{RenderSurface, linear_color};
use frangible::{Asset as Baked, Fragment, TriMesh};

use crate::MaterialOfFile;

/// Converts to Bevy's vector.
pub(crate) fn out(v: glam::Vec3) -> Vec3 {
    Vec3::from_array(v.to_array())
}

/// Converts from Bevy's vector.
pub(crate) fn into(v: Vec3) -> glam::Vec3 {
    glam::Vec3::from_array(v.to_array())
}

/// Triangles of one material of the body's file, if it has several.
pub(crate) type Part = (Mesh, Option<MaterialOfFile>);

/// Meshes of a fragment.
#[derive(Clone, Default)]
pub(crate) struct Faces {
    /// The outer faces.
    pub(crate) outer: Vec<Part>,
    /// The crack faces, if there are any.
    pub(crate) crack: Option<Mesh>,
}

/// The surface that the author of a body drew, if there is one.
pub(crate) fn authored(baked: &Baked) -> Option<&RenderSurface> {
    baked.root().render()
}

/// The outer surface of a whole body, as its author drew it if it has one.
pub(crate) fn whole(baked: &Baked) -> Mesh {
    match baked.render() {
        Some(surface) => drawn(&as_drawn(surface), 0..surface.triangles.len(), surface),
        None => {
            let positions = baked.surface_positions();
            let corners = baked
                .surface()
                .triangles
                .iter()
                .zip(&baked.surface().normals);
            mesh(corners.map(|(t, n)| (t.map(|v| positions[v as usize]), *n)))
        }
    }
}

/// The outer surface of a whole body, a mesh for each material of its file; empty if the file has fewer than two.
pub(crate) fn whole_by_material(baked: &Baked) -> Vec<Part> {
    let several = |surface: &&RenderSurface| surface.materials.len() > 1;
    let surface = baked.render().filter(several);
    surface.map_or_else(Vec::new, |surface| outer(&as_drawn(surface), surface))
}

/// The outer and the crack faces of a fragment. `surface`: that of its body's author.
pub(crate) fn faces(fragment: &Fragment, surface: Option<&RenderSurface>) -> Faces {
    let own = &fragment.mesh;
    let (Some(render), Some(surface)) = (&fragment.render, surface) else {
        return undrawn(own);
    };
    let count = render.outer_triangles..render.triangles.len();
    let crack = (!count.is_empty()).then(|| drawn(render, count, surface));
    let ends = (!own.cracks.is_empty()).then(|| mesh(ending(own)));
    Faces {
        outer: outer(render, surface),
        crack: match (crack, ends) {
            (Some(mut crack), Some(ends)) => {
                // The faces of cracks that end inside have no colours and no texture coordinates.
                let ends = padded(ends, &crack);
                let _ = crack.merge(&ends);
                Some(crack)
            }
            (crack, ends) => crack.or(ends),
        },
    }
}

/// Faces of a fragment of a body that no one drew.
fn undrawn(own: &TriMesh) -> Faces {
    let corner = |(t, n): (&[u32; 3], &[glam::Vec3; 3])| (t.map(|v| own.positions[v as usize]), *n);
    let all = || own.triangles.iter().zip(&own.normals);
    let (count, total) = (own.outer_triangles, own.triangles.len());
    let whole = || (mesh(all().take(count).map(corner)), None);
    Faces {
        outer: (count > 0).then(whole).into_iter().collect(),
        crack: (total > count || !own.cracks.is_empty())
            .then(|| mesh(all().skip(count).map(corner).chain(ending(own)))),
    }
}

/// A triangle with the normals at its corners.
type Corners = ([glam::Vec3; 3], [glam::Vec3; 3]);

/// Cracks that did not part the piece, which are drawn from both sides.
fn ending(own: &TriMesh) -> impl Iterator<Item = Corners> {
    own.cracks.iter().flat_map(|&[a, b, c]| {
        let normal = (b - a).cross(c - a).normalize_or_zero();
        [([a, b, c], [normal; 3]), ([a, c, b], [-normal; 3])]
    })
}

fn mesh(triangles: impl Iterator<Item = Corners>) -> Mesh {
    let (mut positions, mut normals) = (Vec::new(), Vec::new());
    for (corners, of_corners) in triangles {
        positions.extend(corners.map(|p| p.to_array()));
        normals.extend(of_corners.map(|n| n.to_array()));
    }
    empty()
        .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, positions)
        .with_inserted_attribute(Mesh::ATTRIBUTE_NORMAL, normals)
}

fn empty() -> Mesh {
    Mesh::new(
        PrimitiveTopology::TriangleList,
        RenderAssetUsages::default(),
    )
}

/// A mesh with indices, and with white colours and texture coordinates of zero where another one has such attributes.
fn padded(mesh: Mesh, like: &Mesh) -> Mesh {
    let count = mesh.count_vertices();
    let mut mesh = mesh.with_inserted_indices(Indices::U32((0..count as u32).collect()));
    for uvs in [Mesh::ATTRIBUTE_UV_0, Mesh::ATTRIBUTE_UV_1] {
        if like.contains_attribute(uvs) {
            mesh.insert_attribute(uvs, vec![[0.0_f32; 2]; count]);
        }
    }
    if like.contains_attribute(Mesh::ATTRIBUTE_COLOR) {
        mesh.insert_attribute(Mesh::ATTRIBUTE_COLOR, vec![[1.0_f32; 4]; count]);
    }
    mesh
}

/// An author's surface with a normal at each corner.
fn as_drawn(surface: &RenderSurface) -> RenderMesh {
    let mut render = RenderMesh {
        more_uvs: vec![Vec::new(); surface.more_uvs.len()],
        outer_triangles: surface.triangles.len(),
        material_of_triangle: surface.material_of_triangle.clone(),
        ..RenderMesh::default()
    };
    let corners = surface.triangles.iter().zip(surface.corner_normals());
    for (triangle, normals) in corners {
        let first = render.positions.len() as u32;
        render.triangles.push([first, first + 1, first + 2]);
        for (&v, normal) in triangle.iter().zip(normals) {
            let v = v as usize;
            render.positions.push(surface.positions[v]);
            render.normals.push(normal);
            render.uvs.extend(surface.uvs.get(v));
            render.colors.extend(surface.colors.get(v));
            for (uvs, all) in render.more_uvs.iter_mut().zip(&surface.more_uvs) {
                uvs.push(all[v]);
            }
        }
    }
    render
}

/// The outer triangles, a mesh for each material if the file has several.
fn outer(render: &RenderMesh, surface: &RenderSurface) -> Vec<Part> {
    let all = 0..render.outer_triangles;
    if all.is_empty() {
        return Vec::new();
    }
    if surface.materials.len() < 2 || render.material_of_triangle.is_empty() {
        return vec![(drawn(render, all, surface), None)];
    }
    let part = |(index, look): (usize, &frangible::internals::asset::RenderMaterial)| {
        let of = |&t: &usize| render.material_of_triangle[t] as usize == index;
        let triangles: Vec<usize> = all.clone().filter(of).collect();
        let name = look.name.clone();
        (!triangles.is_empty()).then(|| {
            let mesh = drawn(render, triangles.into_iter(), surface);
            (mesh, Some(MaterialOfFile { index, name }))
        })
    };
    surface
        .materials
        .iter()
        .enumerate()
        .filter_map(part)
        .collect()
}

/// Some triangles of a drawn mesh, with the vertices that they use.
fn drawn(
    render: &RenderMesh,
    triangles: impl Iterator<Item = usize>,
    surface: &RenderSurface,
) -> Mesh {
    let mut number = vec![u32::MAX; render.positions.len()];
    let (mut used, mut indices) = (Vec::new(), Vec::new());
    for v in triangles.flat_map(|t| render.triangles[t]) {
        let own = &mut number[v as usize];
        if *own == u32::MAX {
            *own = used.len() as u32;
            used.push(v as usize);
        }
        indices.push(*own);
    }
    let vectors =
        |of: &[glam::Vec3]| -> Vec<[f32; 3]> { used.iter().map(|&v| of[v].to_array()).collect() };
    let coordinates = |of: &[[f32; 2]]| -> Vec<[f32; 2]> { used.iter().map(|&v| of[v]).collect() };
    let mut mesh = empty()
        .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, vectors(&render.positions))
        .with_inserted_attribute(Mesh::ATTRIBUTE_NORMAL, vectors(&render.normals))
        .with_inserted_indices(Indices::U32(indices));
    // Fragments of a surface without texture coordinates have a box projection.
    if !surface.uvs.is_empty() {
        mesh.insert_attribute(Mesh::ATTRIBUTE_UV_0, coordinates(&render.uvs));
    }
    if let Some(second) = render.more_uvs.first() {
        mesh.insert_attribute(Mesh::ATTRIBUTE_UV_1, coordinates(second));
    }
    if !render.colors.is_empty() {
        let color = |&v: &usize| match surface.srgb_colors {
            true => linear_color(render.colors[v]),
            false => render.colors[v],
        };
        let colors: Vec<[f32; 4]> = used.iter().map(color).collect();
        mesh.insert_attribute(Mesh::ATTRIBUTE_COLOR, colors);
    }
    mesh
}
