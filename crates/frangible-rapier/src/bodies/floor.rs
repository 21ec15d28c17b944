//! Contacts of polyhedra with a half-space: of the corners that are lowest, wherever they are ([`footing`]).

use frangible::internals::mesh::{Corner, footing};
use rapier3d::geometry::{ContactData, ContactManifoldData};
use rapier3d::math::{Pose, Real, Vector};
use rapier3d::parry::query::{ContactManifold, TrackedContact, Unsupported};
use rapier3d::parry::shape::{HalfSpace, PackedFeatureId, Shape};

type Manifold = ContactManifold<ContactManifoldData, ContactData>;

/// Bits of a corner's number that count corners of one part; the others count parts.
const CORNER_BITS: u32 = 12;

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
    let known = |number| {
        let id = PackedFeatureId::vertex(number);
        old.iter()
            .any(|c| if flipped { c.fid1 == id } else { c.fid2 == id })
    };
    let mut near = Vec::new();
    corners(shape, |number, point| {
        let height = (*to_plane * point).dot(plane.normal);
        if height <= prediction {
            near.push(Corner {
                number,
                point,
                height,
                known: known(number),
            });
        }
    });
    let up = to_plane.rotation.inverse() * plane.normal;
    let mut manifold = manifolds.pop().unwrap_or_default();
    for corner in footing(&near, up) {
        let on_plane = *to_plane * corner.point - plane.normal * corner.height;
        let face = PackedFeatureId::face(0);
        manifold.points.push(TrackedContact::flipped(
            on_plane,
            corner.point,
            face,
            PackedFeatureId::vertex(corner.number),
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
