//! Colliders of bodies and pieces: of the convex cells that a bake has made, put together until they are few. No convex decomposition
//! happens in a game. Shapes serve contact alone; masses come from the exact pieces.

use avian3d::parry::{self, shape::SharedShape};
use avian3d::prelude::*;
use bevy::prelude::*;
use frangible::internals::mesh::{ConvexHull, bounds, hulls_of_parts, merged_parts};
use frangible::{Asset as Baked, Fragment, TriMesh, glam};

use crate::meshes::out;

/// Resource with the detail of the colliders of new bodies and fragments. It dominates the cost of a scene with hundreds of bodies. A body with a
/// [`Collider`] from the game keeps it. Contacts of balls use the body's exact surface, regardless of its collider.
#[derive(Resource, Clone, Copy, Debug, PartialEq)]
pub struct ColliderDetail {
    /// Largest number of convex parts of a whole body, 1 or more, and of points of each part. 1 part is the convex hull. Default 12 and 48.
    pub whole: (usize, usize),
    /// Largest number of convex parts of a fragment that a single hull does not fit, and of points of each part. Default 4 and 24. A supported fragment
    /// uses its exact surface.
    pub fragment: (usize, usize),
    /// Largest ratio of hull volume to piece volume at which a fragment gets a single convex hull. Default 1.5.
    pub hull_volume_ratio: f64,
    /// Speculative contact distance of fragments, m: Avian's [`SpeculativeMargin`]. Default 0.05. Without a limit, hundreds of pieces that fly apart at
    /// 25 m/s predict contacts within half a metre, and so with each other, which dominates their cost. Faster pieces may tunnel through bodies
    /// thinner than their motion per step.
    pub fragments_see: f32,
}

impl Default for ColliderDetail {
    fn default() -> Self {
        Self {
            whole: (12, 48),
            fragment: (4, 24),
            hull_volume_ratio: 1.5,
            fragments_see: 0.05,
        }
    }
}

/// Distance by which a collider may miss a point of its solid, over the longest side of the solid.
const TOLERANCE: f32 = 3e-3;

/// Volume of a hull that is no collider, m³.
const LEAST_VOLUME: f64 = 1e-15;

/// Smallest extent of a stand-in box, m.
const LEAST_EXTENT: f32 = 4e-4;

/// The collider of a whole body.
pub(super) fn whole(baked: &Baked, (parts, points): (usize, usize)) -> Collider {
    let cells = baked.cells().iter().map(|cell| &cell.points[..]).collect();
    let solid = baked.surface_positions();
    compound(cells, &[], [parts, points], within(solid)).unwrap_or_else(|| bounding_box(solid))
}

/// The collider of a fragment: one hull, the hulls of its shares of the cells, or a box. One that is held has its own surface: the rest of a pane in
/// its frame has a hole, which few hulls would close, and as nothing moves it, it never meets others of its kind.
pub(super) fn of_fragment(fragment: &Fragment, detail: &ColliderDetail) -> Collider {
    if fragment.supported
        && let Some(surface) = surface(&fragment.mesh)
    {
        return surface;
    }
    let (parts, points) = detail.fragment;
    let solid = &fragment.mesh.positions;
    let drawn = (fragment.render.as_ref()).map_or(&[][..], |drawn| &drawn.positions);
    // A round piece needs more corners than a part of it would.
    let corners = points.max(4).saturating_mul(parts.max(1));
    let one = hulls_of_parts(vec![solid.clone()], drawn, corners, within(solid)).pop();
    let is_convex =
        |hull: &ConvexHull| hull.volume() <= detail.hull_volume_ratio * fragment.mass.volume;
    if let Some(one) = one.as_ref().filter(|one| is_convex(one)).and_then(collider) {
        return one;
    }
    let shares = fragment.cell_shares.iter().map(|(_, points)| &points[..]);
    compound(shares.collect(), drawn, [parts, points], within(solid))
        .or_else(|| collider(one.as_ref()?))
        .unwrap_or_else(|| bounding_box(solid))
}

fn surface(mesh: &TriMesh) -> Option<Collider> {
    let corners = mesh.positions.iter().map(|&p| out(p)).collect();
    Collider::try_trimesh(corners, mesh.triangles.clone()).ok()
}

/// Distance by which a collider may miss a point of its solid, m: colliders follow what is drawn, because a tip that one misses sinks into the floor.
fn within(solid: &[glam::Vec3]) -> f32 {
    let (low, high) = bounds(solid);
    TOLERANCE * (high - low).max_element()
}

/// None where the hull has no volume: contacts of flat hulls have random normals.
fn collider(hull: &ConvexHull) -> Option<Collider> {
    let corner = |p: &glam::Vec3| parry::math::Vector::from_array(p.to_array());
    let corners = hull.corners.iter().map(corner).collect();
    let hull = Some(hull).filter(|hull| hull.volume() > LEAST_VOLUME)?;
    SharedShape::convex_mesh(corners, &hull.triangles).map(Collider::from)
}

fn compound(
    parts: Vec<&[glam::Vec3]>,
    drawn: &[glam::Vec3],
    [most, points]: [usize; 2],
    within: f32,
) -> Option<Collider> {
    let hulls = hulls_of_parts(merged_parts(parts, most), drawn, points.max(4), within);
    let mut hulls: Vec<Collider> = hulls.iter().filter_map(collider).collect();
    match hulls.len() {
        0 | 1 => hulls.pop(),
        _ => {
            let placed = hulls.into_iter().map(|h| (Vec3::ZERO, Quat::IDENTITY, h));
            Some(Collider::compound(placed.collect()))
        }
    }
}

fn bounding_box(points: &[glam::Vec3]) -> Collider {
    let none = (glam::Vec3::INFINITY, glam::Vec3::NEG_INFINITY);
    let (low, high) = points
        .iter()
        .fold(none, |(low, high), p| (low.min(*p), high.max(*p)));
    let size = (high - low).max(glam::Vec3::splat(LEAST_EXTENT));
    let middle = out((low + high) * 0.5);
    Collider::compound(vec![(
        middle,
        Quat::IDENTITY,
        Collider::cuboid(size.x, size.y, size.z),
    )])
}
