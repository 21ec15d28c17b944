//! Convex parts of bodies and fragments, for colliders.
//!
//! They follow what is drawn: a tip that a collider misses sinks into the floor.

use frangible::glam::Vec3;
use frangible::internals::mesh::{ConvexHull, bounds, hulls_of_parts, merged_parts};
use frangible::{Asset, Fragment};

/// Convex parts of a collider at most, and points of each.
const PARTS: [usize; 2] = [8, 32];

/// Distance by which a part may miss a point of its solid, over the longest side of the solid.
const TOLERANCE: f32 = 3e-3;

/// Convex parts of a whole body, points in its body frame, m.
#[must_use]
pub fn hulls_of_body(asset: &Asset) -> Vec<Vec<f32>> {
    let cells = asset.cells().iter().map(|cell| &cell.points[..]);
    hulls(cells.collect(), asset.surface_positions(), &[])
}

/// Convex parts of a fragment, points in its own frame, m.
#[must_use]
pub fn hulls_of_fragment(fragment: &Fragment) -> Vec<Vec<f32>> {
    let shares = fragment.cell_shares.iter();
    let parts = shares.map(|(_, points)| &points[..]).collect();
    let drawn = (fragment.render.as_ref()).map_or(&[][..], |drawn| &drawn.positions);
    hulls(parts, &fragment.mesh.positions, drawn)
}

fn hulls(parts: Vec<&[Vec3]>, solid: &[Vec3], drawn: &[Vec3]) -> Vec<Vec<f32>> {
    let (low, high) = bounds(solid);
    let within = TOLERANCE * (high - low).max_element();
    let [parts_at_most, points] = PARTS;
    let mut hulls = hulls_of_parts(merged_parts(parts, parts_at_most), drawn, points, within);
    if hulls.is_empty() {
        hulls.extend(ConvexHull::new(solid, points, within));
    }
    let numbers = |hull: ConvexHull| hull.corners.iter().flat_map(|p| p.to_array()).collect();
    hulls.into_iter().map(numbers).collect()
}
