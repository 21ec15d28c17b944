//! Contacts of pieces with a flat floor: of the corners on which they stand ([`footing`]), in place of those of the face that Parry finds.
//!
//! A floor is a half-space, or the face of a box that a piece touches with all its low corners. Avian predicts contacts some millimetres ahead, so that it
//! tells of every piece that is about to stand on one.

use avian3d::collision::contact_types::PackedFeatureId;
use avian3d::parry::shape::Shape;
use avian3d::prelude::*;
use bevy::prelude::*;
use frangible::glam;
use frangible::internals::mesh::{Corner, footing};

use crate::meshes::{into, out};

/// Bits of a corner's number that count corners of one part; the others count parts.
const CORNER_BITS: u32 = 12;

/// A collider with its place.
#[derive(Clone, Copy)]
pub(super) struct Placed<'a> {
    pub(super) collider: &'a Collider,
    pub(super) at: Vec3,
    pub(super) turn: Quat,
}

impl Placed<'_> {
    fn shape(&self) -> &dyn Shape {
        &**self.collider.shape_scaled()
    }

    /// Visits the corners of a polyhedron, or of a compound of nothing but polyhedra, in the collider's frame. Returns false for any other shape.
    fn corners(&self, mut visit: impl FnMut(u32, Vec3)) -> bool {
        if let Some(hull) = self.shape().as_convex_polyhedron() {
            for (number, p) in (0..).zip(hull.points()) {
                visit(number, Vec3::from_array(p.to_array()));
            }
            return true;
        }
        let Some(compound) = self.shape().as_compound() else {
            return false;
        };
        for (part, (pose, shape)) in (0_u32..).zip(compound.shapes()) {
            let Some(hull) = shape.as_convex_polyhedron() else {
                return false;
            };
            for (number, &p) in (part << CORNER_BITS..).zip(hull.points()) {
                visit(number, Vec3::from_array((*pose * p).to_array()));
            }
        }
        true
    }
}

/// A flat floor: a point of it, its normal, and the box of which it is a face: the half extents along the two sides of the face, which are unit vectors.
struct Floor {
    point: Vec3,
    normal: Vec3,
    sides: Option<[(Vec3, f32); 2]>,
}

impl Floor {
    /// The face of a collider above which another one is. Parry's normal does not tell: with pieces of some millimetres it is often wrong.
    fn of(placed: &Placed, other: &Placed) -> Option<Self> {
        if let Some(plane) = placed.shape().as_halfspace() {
            return Some(Self {
                point: placed.at,
                normal: placed.turn * Vec3::from_array(plane.normal.to_array()),
                sides: None,
            });
        }
        let half = Vec3::from_array(placed.shape().as_cuboid()?.half_extents.to_array());
        let local = placed.turn.inverse() * (other.at - placed.at);
        let above = local.abs() - half;
        let axis = above.max_position();
        if above[axis] <= 0.0 {
            return None;
        }
        let side = |axis: usize| (placed.turn * Vec3::AXES[axis], half[axis]);
        let normal = placed.turn * (Vec3::AXES[axis] * local[axis].signum());
        Some(Self {
            point: placed.at + normal * half[axis],
            normal,
            sides: Some([side((axis + 1) % 3), side((axis + 2) % 3)]),
        })
    }

    fn carries(&self, point: Vec3) -> bool {
        let inside = |&(side, half): &(Vec3, f32)| (point - self.point).dot(side).abs() <= half;
        self.sides.iter().flatten().all(inside)
    }
}

/// Lets a piece stand on its own corners, if the other one is a flat floor. `relative` is the velocity of the second body against the first at a point, m/s;
/// `near` is the height up to which a corner touches that does not approach the floor, m.
pub(super) fn stand(
    pair: &mut ContactPair,
    [first, second]: [Placed; 2],
    relative: impl Fn(&ContactPoint) -> Vec3,
    (dt, near): (f32, f32),
) {
    let Some(known) = pair.manifolds.first() else {
        return;
    };
    let Some(&ContactPoint {
        anchor1,
        anchor2,
        point: at,
        ..
    }) = known.points.first()
    else {
        return;
    };
    // Avian's normal points from the first to the second.
    let (floor, piece, flipped) = match (Floor::of(&first, &second), Floor::of(&second, &first)) {
        (Some(floor), None) => (floor, second, false),
        (None, Some(floor)) => (floor, first, true),
        _ => return,
    };
    let normal = if flipped { -floor.normal } else { floor.normal };
    let centres = [at - anchor1, at - anchor2];
    let contact = |number: u32, world: Vec3, height: f32| {
        let middle = world - floor.normal * (0.5 * height);
        let mut contact =
            ContactPoint::new(middle - centres[0], middle - centres[1], middle, -height);
        contact.normal_speed = relative(&contact).dot(normal);
        let ids = [PackedFeatureId::face(0), PackedFeatureId::vertex(number)];
        match flipped {
            false => contact.with_feature_ids(ids[0], ids[1]),
            true => contact.with_feature_ids(ids[1], ids[0]),
        }
    };
    let (mut low, mut carried) = (Vec::new(), true);
    let has_corners = piece.corners(|number, point| {
        let world = piece.at + piece.turn * point;
        let height = (world - floor.point).dot(floor.normal);
        let comes = (-contact(number, world, height).normal_speed).max(0.0) * dt;
        if height <= near + comes {
            carried &= floor.carries(world);
            low.push(Corner {
                number,
                point: into(point),
                height,
                known: false,
            });
        }
    });
    if !has_corners || !carried || low.is_empty() {
        return;
    }
    let up: glam::Vec3 = into(piece.turn.inverse() * floor.normal);
    let contacts = footing(&low, up);
    let contacts = contacts.iter().map(|corner| {
        contact(
            corner.number,
            piece.at + piece.turn * out(corner.point),
            corner.height,
        )
    });
    let contacts = contacts.collect();
    let manifold = ContactManifold {
        normal,
        points: contacts,
        ..known.clone()
    };
    pair.manifolds = vec![manifold];
}
