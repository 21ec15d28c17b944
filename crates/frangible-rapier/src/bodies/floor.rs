//! Contacts of polyhedra with a half-space: of the corners that are lowest, wherever they are.
//!
//! Parry takes the face of a polyhedron that is most nearly parallel to the plane and touches with that face's
//! corners alone. On a jagged piece that face is a small one somewhere, not the one at the bottom: the tip sinks
//! until the face arrives (measured: 12 mm on a piece of a brick), then the piece rocks from face to face for
//! ever. Here a body touches with its lowest corner and those that span the widest base with it.

use rapier3d::geometry::{ContactData, ContactManifoldData};
use rapier3d::math::{Pose, Real, Vector};
use rapier3d::parry::query::{ContactManifold, TrackedContact, Unsupported};
use rapier3d::parry::shape::{HalfSpace, PackedFeatureId, Shape};

/// A corner higher than the lowest one by h counts as nearer by this × h: a base is spanned by corners that touch,
/// not by ones that hover inside the prediction distance.
const HEIGHT_COST: f32 = 20.0;

/// Depth below the plane from which on corners are alike, m: all of them touch, so that a sunken body is lifted by its widest base. Lifted by its
/// lowest corner alone it turns about that, and goes on turning where it is. Rapier leaves resting bodies 0.1 mm deep.
const SUNK: f32 = 3e-4;

/// A corner that touched in the last step counts as farther by this, m, so that the base does not flicker between
/// corners that are as good.
const LOYALTY: f32 = 5e-4;

type Manifold = ContactManifold<ContactManifoldData, ContactData>;

/// Bits of a corner's number that count corners of one part; the others count parts.
const CORNER_BITS: u32 = 12;

/// A corner of a shape at which the solver may touch the plane.
#[derive(Clone, Copy)]
struct Corner {
    /// Number of the corner, the same as long as the shape lives.
    id: PackedFeatureId,
    /// Position in the shape's frame, m.
    point: Vector,
    /// Height above the plane, m.
    height: f32,
    /// Cost of the height and worth of loyalty, m.
    worth: f32,
}

/// Returns true if a shape is a polyhedron, or a compound of nothing but polyhedra.
fn has_corners(shape: &dyn Shape) -> bool {
    match shape.as_compound() {
        Some(compound) => (compound.shapes().iter()).all(|(_, part)| is_polyhedron(&**part)),
        None => is_polyhedron(shape),
    }
}

/// Visits the corners of a shape that has some.
fn corners(shape: &dyn Shape, mut visit: impl FnMut(u32, Vector)) {
    let mut part = |first: u32, pose: &Pose, shape: &dyn Shape| {
        if let Some(hull) = shape.as_convex_polyhedron() {
            for (i, &point) in (first..).zip(hull.points()) {
                visit(i, *pose * point);
            }
        } else if let Some(cuboid) = shape.as_cuboid() {
            for i in 0..8 {
                let side = |axis: u32| if i >> axis & 1 == 1 { 1.0 } else { -1.0 };
                let corner = Vector::new(side(0), side(1), side(2)) * cuboid.half_extents;
                visit(first | i, *pose * corner);
            }
        }
    };
    match shape.as_compound() {
        Some(compound) => {
            for (k, (pose, shape)) in (0_u32..).zip(compound.shapes()) {
                part(k << CORNER_BITS, pose, &**shape);
            }
        }
        None => part(0, &Pose::IDENTITY, shape),
    }
}

/// The up to four corners to stand on.
fn base(near: &[Corner], up: Vector) -> Vec<Corner> {
    let best = |score: &dyn Fn(&Corner) -> f32| {
        near.iter()
            .copied()
            .max_by(|a, b| score(a).total_cmp(&score(b)).then(b.id.0.cmp(&a.id.0)))
    };
    let mut base: Vec<Corner> = Vec::with_capacity(4);
    let mut add = |corner: Option<Corner>| {
        if let Some(corner) = corner.filter(|c| base.iter().all(|b| b.id != c.id)) {
            base.push(corner);
        }
    };
    let Some(first) = best(&|c| -c.height) else {
        return base;
    };
    let flat = |v: Vector| v - up * v.dot(up);
    let second = best(&|c| flat(c.point - first.point).length() + c.worth).unwrap_or(first);
    let across = up
        .cross(flat(second.point - first.point))
        .normalize_or_zero();
    add(Some(first));
    add(Some(second));
    for side in [across, -across] {
        add(best(&|c| (c.point - first.point).dot(side) + c.worth)
            .filter(|c| (c.point - first.point).dot(side) > 0.0));
    }
    base
}

/// `to_plane`: pose of the shape in the half-space's frame. `flipped`: the shape is the first of the pair.
pub(crate) fn touch(
    to_plane: &Pose,
    plane: &HalfSpace,
    shape: &dyn Shape,
    prediction: Real,
    manifolds: &mut Vec<Manifold>,
    flipped: bool,
) -> Result<(), Unsupported> {
    if !has_corners(shape) {
        return Err(Unsupported);
    }
    manifolds.truncate(1);
    let old = manifolds
        .first_mut()
        .map(|m| std::mem::take(&mut m.points))
        .unwrap_or_default();
    if let Some(compound) = shape.as_compound() {
        // A half-space meets every body; most are far above it.
        let bounds = compound.local_aabb().transform_by(to_plane);
        let nearest =
            bounds.center().dot(plane.normal) - bounds.half_extents().dot(plane.normal.abs());
        if nearest > prediction {
            // The manifold stays, without points: the solver may still refer to it.
            return Ok(());
        }
    }
    let known = |id| {
        old.iter()
            .any(|c| if flipped { c.fid1 == id } else { c.fid2 == id })
    };
    let mut near = Vec::new();
    corners(shape, |number, point| {
        let height = (*to_plane * point).dot(plane.normal);
        if height <= prediction {
            near.push(Corner {
                id: PackedFeatureId::vertex(number),
                point,
                height,
                worth: 0.0,
            });
        }
    });
    let lowest = near.iter().map(|c| c.height).fold(f32::INFINITY, f32::min);
    for corner in &mut near {
        let loyalty = if known(corner.id) { LOYALTY } else { 0.0 };
        corner.worth = loyalty - HEIGHT_COST * (corner.height.max(-SUNK) - lowest.max(-SUNK));
    }
    let up = to_plane.rotation.inverse() * plane.normal;
    let mut manifold = manifolds.pop().unwrap_or_default();
    for corner in base(&near, up) {
        let on_plane = *to_plane * corner.point - plane.normal * corner.height;
        let face = PackedFeatureId::face(0);
        manifold.points.push(TrackedContact::flipped(
            on_plane,
            corner.point,
            face,
            corner.id,
            corner.height,
            flipped,
        ));
    }
    (manifold.local_n1, manifold.local_n2) = if flipped {
        (-up, plane.normal)
    } else {
        (plane.normal, -up)
    };
    manifold.match_contacts(&old);
    manifolds.push(manifold);
    Ok(())
}

/// Returns true if a shape is convex and has flat faces.
fn is_polyhedron(shape: &dyn Shape) -> bool {
    shape.as_convex_polyhedron().is_some() || shape.as_cuboid().is_some()
}
