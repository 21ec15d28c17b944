//! Contacts of convex polyhedra with each other and with other convex shapes, searched in units in which bodies are of the size of ten.
//!
//! Parry's search for closest points (GJK, and EPA where bodies overlap) has absolute tolerances, which suit bodies of the size of one. With
//! pieces of some millimetres, in metres, it goes wrong: in a heap of a brick's shards three searches of four ended with a normal that
//! pointed through the bodies, so that the solver pushed them apart, and a ball of 6 mm that touches a prism of as much is said to be up to
//! 5 mm too near or too far in one case of five. The same search in units that suit the bodies fails in one of a thousand.
//!
//! A normal can be checked without a search: along the right one, the gap between the two bodies' support points is the
//! distance that was found. If it is wrong, which happens to bodies that touch within some micrometres, it is replaced by the best of that
//! normal, the one before and those of the faces: the one along which the bodies are farthest apart.

use rapier3d::geometry::{ContactData, ContactManifoldData};
use rapier3d::math::{Pose, Real, Vector};
use rapier3d::parry::bounding_volume::BoundingVolume;
use rapier3d::parry::query::details::{
    NormalConstraints, NormalConstraintsPair, contact_support_map_support_map_with_params,
};
use rapier3d::parry::query::gjk::{GJKResult, VoronoiSimplex};
use rapier3d::parry::query::{
    ContactManifold, DefaultQueryDispatcher, PersistentQueryDispatcher, TrackedContact, Unsupported,
};
use rapier3d::parry::shape::{
    PackedFeatureId, PolygonalFeature, PolygonalFeatureMap, Shape, SupportMap, Triangle,
};

type Manifold = ContactManifold<ContactManifoldData, ContactData>;

/// Difference between the distance that was found and the gap along its normal that is taken for rounding, m.
const ROUNDING: Real = 5e-5;

/// Share of a distance by which the search may miss it.
const SEARCH_ERROR: Real = 2e-3;

/// Size of the smaller body in the units of the search.
const SEARCH_SIZE: Real = 10.0;

/// Contacts of two convex shapes: where one is a polyhedron as this module says, all others Parry's.
pub(crate) fn touch(
    pos12: &Pose,
    shapes: [&dyn Shape; 2],
    constraints: [Option<&dyn NormalConstraints>; 2],
    prediction: Real,
    manifold: &mut Manifold,
) -> Result<(), Unsupported> {
    let angular = shapes.iter().any(|s| s.as_convex_polyhedron().is_some());
    let [Some(a), Some(b)] = shapes.map(Solid::of).map(|s| s.filter(|_| angular)) else {
        return DefaultQueryDispatcher.contact_manifold_convex_convex(
            pos12,
            shapes[0],
            shapes[1],
            constraints[0],
            constraints[1],
            prediction,
            manifold,
        );
    };
    let pair = Pair { pos12, a, b };
    // The contact of a body with a ball does not turn with the body, so that it is found anew each time.
    let ball = a.features.is_none() || b.features.is_none();
    if !ball && manifold.try_update_contacts(pos12) {
        return Ok(());
    }
    // Most pairs of cells are apart, and stay apart along the normal that parted them before: no search is needed.
    let reach = prediction + a.radius + b.radius;
    let known = manifold.local_n1.try_normalize();
    if manifold.points.is_empty() && known.is_some_and(|normal| pair.gap(normal) > reach) {
        return Ok(());
    }
    let old = std::mem::take(&mut manifold.points);
    match pair.search(reach, known) {
        Found::Apart(normal) => manifold.local_n1 = normal,
        Found::Close {
            normal,
            gap,
            points,
        } => {
            pair.lay_out(manifold, normal, gap, points, constraints);
            manifold.match_contacts(&old);
        }
    }
    Ok(())
}

/// A convex shape: all that is nearer than a radius to what a support map tells of.
#[derive(Clone, Copy)]
struct Solid<'a> {
    shape: &'a dyn Shape,
    support: &'a dyn SupportMap,
    /// Its faces and edges; a ball has none.
    features: Option<&'a dyn PolygonalFeatureMap>,
    radius: Real,
}

impl<'a> Solid<'a> {
    fn of(shape: &'a dyn Shape) -> Option<Self> {
        if let Some(ball) = shape.as_ball() {
            let (support, radius): (&dyn SupportMap, _) = (&Centre, ball.radius);
            return Some(Self {
                shape,
                support,
                features: None,
                radius,
            });
        }
        let (map, radius) = shape.as_polygonal_feature_map()?;
        Some(Self {
            shape,
            support: map,
            features: Some(map),
            radius,
        })
    }

    /// Normals of its faces, where it has flat ones.
    fn normals(&self) -> Vec<Vector> {
        if let Some(hull) = self.shape.as_convex_polyhedron() {
            let normals = hull.faces().iter().map(|face| face.normal);
            // A face without an area has no normal.
            return normals.filter(|n| n.length_squared() > 0.5).collect();
        }
        let triangle = self.shape.as_triangle().and_then(Triangle::normal);
        let axes = self.shape.as_cuboid().map(|_| Vector::AXES);
        let normals = axes.into_iter().flatten().chain(triangle);
        normals.flat_map(|n| [n, -n]).collect()
    }
}

/// A point: what a ball is without its radius.
struct Centre;

impl SupportMap for Centre {
    fn local_support_point(&self, _: Vector) -> Vector {
        Vector::ZERO
    }
}

/// A shape in units of which a metre has so many.
struct Scaled<'a>(&'a dyn SupportMap, Real);

impl SupportMap for Scaled<'_> {
    fn local_support_point(&self, dir: Vector) -> Vector {
        self.1 * self.0.local_support_point(dir)
    }
}

/// Result of a search.
enum Found {
    /// The bodies are farther apart than contacts reach, along this normal.
    Apart(Vector),
    /// The normal between the bodies, their distance along it, and their closest points, or the deepest where they overlap, where
    /// these are known.
    Close {
        normal: Vector,
        gap: Real,
        points: Option<[Vector; 2]>,
    },
}

/// The power of two below a positive number, so that scaling rounds nothing; one where there is none.
fn power_of_two(number: Real) -> Real {
    let power = Real::from_bits(number.to_bits() & 0xff80_0000);
    if power.is_normal() { power } else { 1.0 }
}

/// Two solids without their radii, in the frame of the first unless said otherwise.
struct Pair<'a> {
    pos12: &'a Pose,
    a: Solid<'a>,
    b: Solid<'a>,
}

impl Pair<'_> {
    /// Distance of the bodies along a unit normal from the first to the second, m; negative where they overlap.
    fn gap(&self, normal: Vector) -> Real {
        let near = self.a.support.local_support_point(normal);
        (*self.pos12 * self.farthest_of_second(-normal) - near).dot(normal)
    }

    /// The point of the second body that is farthest in a direction, in its own frame.
    fn farthest_of_second(&self, direction: Vector) -> Vector {
        let there = self.pos12.rotation.inverse() * direction;
        self.b.support.local_support_point(there)
    }

    /// Searches the closest points from a normal on, if one is known. `reach`: how far contacts reach, m.
    fn search(&self, reach: Real, known: Option<Vector>) -> Found {
        let sizes =
            [self.a, self.b].map(|body| body.shape.compute_local_aabb().half_extents().length());
        let scale = power_of_two(SEARCH_SIZE / sizes[0].min(sizes[1]));
        let scaled = Pose::from_parts(self.pos12.translation * scale, self.pos12.rotation);
        let found = contact_support_map_support_map_with_params(
            &scaled,
            &Scaled(self.a.support, scale),
            &Scaled(self.b.support, scale),
            reach * scale,
            &mut VoronoiSimplex::new(),
            known,
        );
        let mut closest = None;
        match found {
            GJKResult::ClosestPoints(near, far, normal) => {
                let points = [near / scale, far / scale];
                let gap = (points[1] - points[0]).dot(normal);
                let error = ROUNDING + SEARCH_ERROR * gap.abs();
                if (gap - self.gap(normal)).abs() <= error {
                    return Found::Close {
                        normal,
                        gap,
                        points: Some(points),
                    };
                }
                closest = Some((normal, points));
            }
            GJKResult::NoIntersection(normal) if self.gap(normal) > reach - ROUNDING => {
                return Found::Apart(normal);
            }
            _ => {}
        }
        let more = closest.map(|(normal, _)| normal).into_iter().chain(known);
        let (normal, gap) = self.farthest(more, reach);
        if gap > reach - ROUNDING {
            return Found::Apart(normal);
        }
        // If bodies touch within some micrometres the points are right, but not the normal between them.
        let points = closest.map(|(_, points)| points);
        let points = points.filter(|[near, far]| (far - near).length() <= 2.0 * ROUNDING);
        Found::Close {
            normal,
            gap,
            points: points.or_else(|| self.corner(normal, gap)),
        }
    }

    /// A corner that the other body touches, and the point where it does; none where both corners lie beside the other body, as those of large
    /// faces may.
    fn corner(&self, normal: Vector, gap: Real) -> Option<[Vector; 2]> {
        let holds = |body: &Solid, point| {
            let bounds = body.shape.compute_local_aabb().loosened(ROUNDING);
            bounds.contains_local_point(point)
        };
        let far = *self.pos12 * self.farthest_of_second(-normal);
        let near = self.a.support.local_support_point(normal);
        let ways = [[far - gap * normal, far], [near, near + gap * normal]];
        ways.into_iter().find(|[near, far]| {
            holds(&self.a, *near) && holds(&self.b, self.pos12.inverse_transform_point(*far))
        })
    }

    /// Contacts of the faces that meet along a normal, and the closest points. Where a body is part of a surface, that may turn the normal
    /// or have no contact at all.
    fn lay_out(
        &self,
        manifold: &mut Manifold,
        normal: Vector,
        gap: Real,
        points: Option<[Vector; 2]>,
        constraints: [Option<&dyn NormalConstraints>; 2],
    ) {
        let (pos12, found) = (self.pos12, normal);
        let [near, far] = points.unwrap_or_else(|| {
            let near = self.a.support.local_support_point(normal);
            [near, *pos12 * self.farthest_of_second(-normal)]
        });
        let other = pos12.inverse_transform_point(far);
        let (mut normal, mut there) = (found, pos12.rotation.inverse() * -found);
        let [of_a, of_b] = constraints;
        if !(of_a, of_b).project_local_normals(pos12, &mut normal, &mut there) {
            return;
        }
        if let (Some(a), Some(b)) = (self.a.features, self.b.features) {
            let mut features = [PolygonalFeature::default(), PolygonalFeature::default()];
            a.local_support_feature_toward(normal, near, &mut features[0]);
            b.local_support_feature_toward(there, other, &mut features[1]);
            let [of_a, of_b] = &features;
            let back = pos12.inverse();
            PolygonalFeature::contacts(pos12, &back, normal, there, of_a, of_b, manifold, false);
        }
        if normal == found && points.is_some() {
            let unknown = PackedFeatureId::UNKNOWN;
            let closest = TrackedContact::new(near, other, unknown, unknown, gap);
            manifold.points.push(closest);
        }
        if constraints.iter().any(Option::is_some) {
            // Along a normal that was turned a body that reaches far may seem to go deep, as in Parry's own.
            let deepest = 5.0 * gap.min(0.0);
            (manifold.points).retain(|p| p.dist >= 0.0 || gap >= 0.0 || p.dist >= deepest);
        }
        for point in &mut manifold.points {
            point.local_p1 += normal * self.a.radius;
            point.local_p2 += there * self.b.radius;
            point.dist -= self.a.radius + self.b.radius;
        }
        (manifold.local_n1, manifold.local_n2) = (normal, there);
    }

    /// The normal along which the bodies are farthest apart, of these and those of flat faces, and how far, m; any along which they are
    /// farther apart than `enough`.
    fn farthest(&self, normals: impl Iterator<Item = Vector>, enough: Real) -> (Vector, Real) {
        let of_b = self.b.normals().into_iter();
        let all = normals
            .chain(self.a.normals())
            .chain(of_b.map(|normal| self.pos12.rotation * -normal));
        let mut best = (Vector::Y, Real::NEG_INFINITY);
        for normal in all {
            let gap = self.gap(normal);
            if gap > best.1 {
                best = (normal, gap);
            }
            if gap > enough - ROUNDING {
                break;
            }
        }
        best
    }
}

#[cfg(test)]
mod tests;
