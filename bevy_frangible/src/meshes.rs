//! Bodies and fragments as Bevy's meshes. Bevy's vectors are of another version of glam than ours: numbers pass as arrays.

use bevy::asset::RenderAssetUsages;
use bevy::mesh::PrimitiveTopology;
use bevy::prelude::*;
use frangible::glam;
use frangible::{Asset as Baked, TriMesh};

/// Converts to Bevy's vector.
pub(crate) fn out(v: glam::Vec3) -> Vec3 {
    Vec3::from_array(v.to_array())
}

/// Converts from Bevy's vector.
pub(crate) fn into(v: Vec3) -> glam::Vec3 {
    glam::Vec3::from_array(v.to_array())
}

/// The outer surface of a whole body.
pub(crate) fn whole(baked: &Baked) -> Mesh {
    let positions = baked.surface_positions();
    let corners = baked
        .surface()
        .triangles
        .iter()
        .zip(&baked.surface().normals);
    mesh(corners.map(|(t, n)| (t.map(|v| positions[v as usize]), *n)))
}

/// The outer and the crack faces of a fragment; none where there are no such faces.
pub(crate) fn faces(fragment: &TriMesh) -> [Option<Mesh>; 2] {
    let corner =
        |(t, n): (&[u32; 3], &[glam::Vec3; 3])| (t.map(|v| fragment.positions[v as usize]), *n);
    let all = || fragment.triangles.iter().zip(&fragment.normals);
    let (outer, count) = (fragment.outer_triangles, fragment.triangles.len());
    // Cracks that did not part the piece are drawn from both sides.
    let open = fragment.cracks.iter().flat_map(|&[a, b, c]| {
        let normal = (b - a).cross(c - a).normalize_or_zero();
        [([a, b, c], [normal; 3]), ([a, c, b], [-normal; 3])]
    });
    [
        (outer > 0).then(|| mesh(all().take(outer).map(corner))),
        (count > outer || !fragment.cracks.is_empty())
            .then(|| mesh(all().skip(outer).map(corner).chain(open))),
    ]
}

fn mesh(triangles: impl Iterator<Item = ([glam::Vec3; 3], [glam::Vec3; 3])>) -> Mesh {
    let (mut positions, mut normals) = (Vec::new(), Vec::new());
    for (corners, of_corners) in triangles {
        positions.extend(corners.map(|p| p.to_array()));
        normals.extend(of_corners.map(|n| n.to_array()));
    }
    Mesh::new(
        PrimitiveTopology::TriangleList,
        RenderAssetUsages::default(),
    )
    .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, positions)
    .with_inserted_attribute(Mesh::ATTRIBUTE_NORMAL, normals)
}
