//! Collision shapes: of the whole body from the asset's convex cells, of fragments from their meshes or shares.
//!
//! No convex decomposition happens at run time: the bake cut the body into convex cells, a crack only shares
//! them out. Shapes serve contact alone; masses always come from the exact pieces.

use frangible::internals::mesh::{bounds, box_of, merged_parts, thinned};
use frangible::{Asset, Fragment};
use rapier3d::geometry::{SharedShape, TypedShape};
use rapier3d::math::{Pose, Vector};

use crate::config::{ColliderDetail, WorldConfig};
use crate::fragments::replace::is_debris;

/// Smallest half extent of a stand-in box, m.
const MIN_HALF_EXTENT: f32 = 2e-4;

/// The collision shape that a world of this configuration gives a fragment, in the fragment frame.
#[must_use]
pub fn collision_shape(fragment: &Fragment, config: &WorldConfig) -> SharedShape {
    if is_debris(fragment, config) {
        debris_shape(fragment)
    } else {
        fragment_shape(fragment, config.hull_volume_ratio, config.fragment_collider)
    }
}

/// A box, or a compound of the asset's cells, in the body frame.
pub(crate) fn whole_shape(asset: &Asset, detail: ColliderDetail) -> SharedShape {
    // Boxes touch each other exactly, and quickly.
    if let Some(half) = box_of(&asset.fracture.positions, asset.mass.volume) {
        return SharedShape::cuboid(half.x, half.y, half.z);
    }
    let cells = asset.cells.iter().map(|cell| &*cell.points).collect();
    let parts = merged_parts(cells, detail.parts);
    let hulls = parts.iter().filter_map(|points| hull(points, detail));
    compound(hulls.map(|(shape, _)| shape))
        .unwrap_or_else(|| fitted_box(&asset.fracture.positions, asset.mass.volume))
}

/// One hull where the piece is nearly convex, else the hulls of its shares of the cells, else a box.
fn fragment_shape(
    fragment: &Fragment,
    hull_volume_ratio: f32,
    detail: ColliderDetail,
) -> SharedShape {
    let positions = &fragment.mesh.positions;
    let whole = hull(positions, detail);
    if let Some((shape, volume)) = &whole
        && *volume <= f64::from(hull_volume_ratio) * fragment.mass.volume
    {
        return shape.clone();
    }
    let shares = fragment.cell_shares.iter().map(|(_, points)| &**points);
    let parts = merged_parts(shares.collect(), detail.parts);
    let shares = parts.iter().filter_map(|points| hull(points, detail));
    compound(shares.map(|(shape, _)| shape))
        .or(whole.map(|(shape, _)| shape))
        .unwrap_or_else(|| debris_shape(fragment))
}

/// A box of the piece's volume in the proportions of its bounds.
fn debris_shape(fragment: &Fragment) -> SharedShape {
    fitted_box(&fragment.mesh.positions, fragment.mass.volume)
}

/// Convex hull and its volume, m³; `None` when the points have no volume.
fn hull(points: &[Vector], detail: ColliderDetail) -> Option<(SharedShape, f64)> {
    let points = thinned(points, detail.hull_points.max(4));
    if points.len() < 4 {
        return None;
    }
    let shape = SharedShape::convex_hull(&points)?;
    let TypedShape::ConvexPolyhedron(polyhedron) = shape.as_typed_shape() else {
        return None;
    };
    let corner = polyhedron.points();
    let index = polyhedron.vertices_adj_to_face();
    let mut volume = 0.0;
    for face in polyhedron.faces() {
        let first = face.first_vertex_or_edge as usize;
        let ring = index.get(first..first + face.num_vertices_or_edges as usize)?;
        let (&apex, rest) = ring.split_first()?;
        let at = |i: u32| corner[i as usize].as_dvec3();
        for pair in rest.windows(2) {
            volume += at(apex).dot(at(pair[0]).cross(at(pair[1]))) / 6.0;
        }
    }
    // Flat hulls make contacts with random normals; a hull without volume is no collider.
    (volume.is_finite() && volume > 1e-15).then_some((shape, volume))
}

fn compound(shapes: impl Iterator<Item = SharedShape>) -> Option<SharedShape> {
    let parts: Vec<(Pose, SharedShape)> = shapes.map(|shape| (Pose::IDENTITY, shape)).collect();
    match parts.len() {
        0 => None,
        1 => parts.into_iter().next().map(|(_, shape)| shape),
        _ => Some(SharedShape::compound(parts)),
    }
}

fn fitted_box(points: &[Vector], volume: f64) -> SharedShape {
    let (low, high) = bounds(points);
    let half = (0.5 * (high - low)).max(Vector::splat(MIN_HALF_EXTENT));
    let box_volume = 8.0 * f64::from(half.x) * f64::from(half.y) * f64::from(half.z);
    let scale = libm::cbrt(volume / box_volume).min(1.0) as f32;
    let half = if half.is_finite() && scale > 0.0 {
        half * scale
    } else {
        Vector::splat(MIN_HALF_EXTENT)
    };
    let half = half.max(Vector::splat(MIN_HALF_EXTENT));
    SharedShape::cuboid(half.x, half.y, half.z)
}
