//! Collision shapes: of the whole body from the asset's convex cells, of fragments from their meshes or shares.
//!
//! No convex decomposition happens at run time: the bake cut the body into convex cells, a crack only shares
//! them out. Shapes serve contact alone; masses always come from the exact pieces.

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

/// Compound of the asset's cells, in the body frame.
pub(crate) fn whole_shape(asset: &Asset, detail: ColliderDetail) -> SharedShape {
    let cells = asset.cells.iter().map(|cell| &*cell.points).collect();
    let parts = merged(cells, detail.parts);
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
    let parts = merged(shares.collect(), detail.parts);
    let shares = parts.iter().filter_map(|points| hull(points, detail));
    compound(shares.map(|(shape, _)| shape))
        .or(whole.map(|(shape, _)| shape))
        .unwrap_or_else(|| debris_shape(fragment))
}

/// A box of the piece's volume in the proportions of its bounds.
fn debris_shape(fragment: &Fragment) -> SharedShape {
    fitted_box(&fragment.mesh.positions, fragment.mass.volume)
}

/// Convex parts, neighbours put together until at most `most` are left: halved again and again at the median across the
/// longest side of the box of their middles.
fn merged(parts: Vec<&[Vector]>, most: usize) -> Vec<Vec<Vector>> {
    if parts.len() <= most.max(1) {
        return parts.into_iter().map(<[_]>::to_vec).collect();
    }
    if most <= 1 {
        return vec![parts.concat()];
    }
    let middle = |points: &[Vector]| points.iter().sum::<Vector>() / points.len().max(1) as f32;
    let mut parts: Vec<(Vector, &[Vector])> = parts.into_iter().map(|p| (middle(p), p)).collect();
    let middles: Vec<Vector> = parts.iter().map(|(m, _)| *m).collect();
    let (low, high) = bounds(&middles);
    let axis = (high - low).max_position();
    parts.sort_by(|(a, _), (b, _)| a[axis].total_cmp(&b[axis]));
    let far = parts.split_off(parts.len() / 2);
    let half = |parts: Vec<(Vector, &[Vector])>, most| {
        merged(parts.into_iter().map(|(_, p)| p).collect(), most)
    };
    let mut all = half(parts, most / 2);
    all.extend(half(far, most - most / 2));
    all
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
    // Flat hulls make contacts with random normals; what has no volume is no collider.
    (volume.is_finite() && volume > 1e-15).then_some((shape, volume))
}

/// Points welded on a grid of 1e-5 of their extent, then at most the extreme ones along evenly spread directions:
/// nearly coincident points are what breaks hull algorithms.
fn thinned(points: &[Vector], most: usize) -> Vec<Vector> {
    let (low, high) = bounds(points);
    let grid = (high - low).max_element() * 1e-5;
    if !(grid.is_finite() && grid > 0.0) {
        return Vec::new();
    }
    let mut cells: Vec<([i32; 3], usize)> = points
        .iter()
        .enumerate()
        .map(|(i, &p)| (((p - low) / grid).round().as_ivec3().to_array(), i))
        .collect();
    cells.sort_unstable();
    cells.dedup_by_key(|(cell, _)| *cell);
    let mut kept: Vec<usize> = cells.into_iter().map(|(_, i)| i).collect();
    if kept.len() > most {
        let candidates = std::mem::take(&mut kept);
        for k in 0..most {
            let direction = spread_direction(k, most);
            let farthest = candidates.iter().copied().max_by(|&a, &b| {
                points[a]
                    .dot(direction)
                    .total_cmp(&points[b].dot(direction))
                    .then(b.cmp(&a))
            });
            kept.extend(farthest);
        }
    }
    kept.sort_unstable();
    kept.dedup();
    kept.into_iter().map(|i| points[i]).collect()
}

/// The k-th of n directions spread evenly over the sphere (golden spiral).
fn spread_direction(k: usize, n: usize) -> Vector {
    let z = 1.0 - (2 * k + 1) as f32 / n as f32;
    let (sin, cos) = (k as f32 * 2.399_963_2).sin_cos();
    let r = (1.0 - z * z).max(0.0).sqrt();
    Vector::new(r * cos, r * sin, z)
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
    let scale = (volume / box_volume).cbrt().min(1.0) as f32;
    let half = if half.is_finite() && scale > 0.0 {
        half * scale
    } else {
        Vector::splat(MIN_HALF_EXTENT)
    };
    let half = half.max(Vector::splat(MIN_HALF_EXTENT));
    SharedShape::cuboid(half.x, half.y, half.z)
}

fn bounds(points: &[Vector]) -> (Vector, Vector) {
    points.iter().fold(
        (
            Vector::splat(f32::INFINITY),
            Vector::splat(f32::NEG_INFINITY),
        ),
        |(low, high), &p| (low.min(p), high.max(p)),
    )
}
