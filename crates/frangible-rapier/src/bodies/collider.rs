//! Collision shapes: of the whole body from the asset's convex cells, of fragments from their meshes or shares.
//!
//! No convex decomposition happens at run time: the bake cut the body into convex cells, a crack only shares
//! them out. Shapes serve contact alone; masses always come from the exact pieces.
//!
//! The hulls of a fragment follow what is drawn, also those of debris: a tip that a collider misses sinks into the floor. What is drawn is the author's
//! surface where the asset has one, and that lies outside of the fracture mesh here and there.

use frangible::internals::mesh::{
    ConvexHull, bounds, box_of, hulls_of_parts, merged_parts, thinned,
};
use frangible::{Asset, Fragment};
use rapier3d::geometry::SharedShape;
use rapier3d::math::{Pose, Vector};

use crate::config::{ColliderDetail, WorldConfig};
use crate::fragments::replace::is_debris;

/// Distance by which a collider may miss a point of its body, over the body's longest side or the length unit, if that is longer.
const TOLERANCE: f32 = 3e-3;

/// Corners of a hull that tells whether a single one is enough.
const COARSE: usize = 16;

/// Volume of a hull that is no collider, m³: contacts of flat hulls have random normals.
const LEAST_VOLUME: f32 = 1e-15;

/// Smallest half extent of a stand-in box, m.
const MIN_HALF_EXTENT: f32 = 2e-4;

/// The collision shape that a world of this configuration gives a fragment, in the fragment frame: one hull where the fragment is debris, small or
/// nearly convex, else the hulls of its shares of the cells, else a box.
#[must_use]
pub fn collision_shape(fragment: &Fragment, config: &WorldConfig) -> SharedShape {
    let positions = &fragment.mesh.positions;
    let (low, high) = bounds(positions);
    let within = TOLERANCE * (high - low).max_element().max(config.length_unit);
    let small = fragment.mass.mass < f64::from(config.small_pieces.mass);
    let most = match small {
        true => config.small_pieces.hull_points.max(4),
        false => config.fragment_collider.hull_points.max(4),
    };
    let alone = small || is_debris(fragment, config);
    let fills = |hull: &ConvexHull| {
        let ratio = f64::from(config.hull_volume_ratio);
        alone || hull.volume() <= ratio * fragment.mass.volume
    };
    let drawn = (fragment.render.as_ref()).map_or(&[][..], |drawn| &drawn.positions);
    // A few corners tell most hollow pieces.
    let coarse = ConvexHull::new(positions, most.min(COARSE), within).filter(fills);
    if coarse.is_some() {
        // A round piece needs more corners than a part of it would.
        let most = match alone {
            true => most,
            false => most.saturating_mul(config.fragment_collider.parts),
        };
        let whole = hulls_of_parts(vec![positions.clone()], drawn, most, within);
        let whole = whole.into_iter().find(fills);
        if let Some(shape) = whole.as_ref().and_then(solid) {
            return shape;
        }
    }
    let shares = fragment.cell_shares.iter().map(|(_, points)| &**points);
    let parts = merged_parts(shares.collect(), config.fragment_collider.parts);
    let hulls = hulls_of_parts(parts, drawn, most, within);
    compound(hulls.iter().filter_map(solid))
        .or_else(|| solid(&ConvexHull::new(positions, most, within)?))
        .unwrap_or_else(|| fitted_box(positions, fragment.mass.volume))
}

/// A box, or a compound of the asset's cells, in the body frame.
pub(crate) fn whole_shape(asset: &Asset, detail: ColliderDetail) -> SharedShape {
    // Boxes touch each other exactly, and quickly.
    if let Some(half) = box_of(&asset.fracture().positions, asset.mass().volume) {
        return SharedShape::cuboid(half.x, half.y, half.z);
    }
    let cells = asset.cells().iter().map(|cell| &*cell.points).collect();
    let parts = merged_parts(cells, detail.parts);
    let hulls = parts.iter().filter_map(|points| {
        let corners = thinned(points, detail.hull_points.max(4));
        let hull = SharedShape::convex_hull(&corners)?;
        Some(hull).filter(|hull| hull.mass_properties(1.0).mass() > LEAST_VOLUME)
    });
    compound(hulls).unwrap_or_else(|| fitted_box(&asset.fracture().positions, asset.mass().volume))
}

fn has_volume(hull: &ConvexHull) -> bool {
    hull.volume() > f64::from(LEAST_VOLUME)
}

fn solid(hull: &ConvexHull) -> Option<SharedShape> {
    let hull = Some(hull).filter(|hull| has_volume(hull))?;
    SharedShape::convex_mesh(hull.corners.clone(), &hull.triangles)
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
