//! Contacts of convex polyhedra with each other and with other convex shapes, searched in units in which bodies are of the size of ten.
//!
//! Parry's search for closest points (GJK, and EPA where bodies overlap) has absolute tolerances, which suit bodies of the size of one. With
//! pieces of some millimetres, in metres, it goes wrong: in a heap of a brick's shards three searches of four ended with a normal that
//! pointed through the bodies, so that the solver pushed them apart, and a ball of 6 mm that touches a prism of as much is said to be up to
//! 5 mm too near or too far in one case of five. The same search in units that suit the bodies fails in one of a thousand.
//!
//! Whether a normal is right can be told without a search: along it, the gap between the two bodies' support points is the
//! distance that was found. Where it is not, which happens to bodies that touch within a micrometre, it is the best of that normal, the
//! one before and those of the faces: the one along which the bodies are farthest apart.

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
    // What touches a ball does not turn with it, so that its contact is found anew each time.
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

/// What a search found.
enum Found {
    /// The bodies are farther apart than contacts reach, along this normal.
    Apart(Vector),
    /// The normal between the bodies, how far apart they are along it, and their closest points, or the deepest where they overlap, where
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

/// Two solids without their radii; what has no frame said is in that of the first.
struct Pair<'a> {
    pos12: &'a Pose,
    a: Solid<'a>,
    b: Solid<'a>,
}

impl Pair<'_> {
    /// How far apart the bodies are along a unit normal from the first to the second, m; negative where they overlap.
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
        // Of bodies that touch within a micrometre the points are right, if not the normal between them.
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
mod tests {
    use rapier3d::geometry::SharedShape;
    use rapier3d::math::Rotation;

    use super::*;

    /// Numbers from 0 to 1 of a plain generator.
    fn numbers(mut state: u32) -> impl FnMut() -> Real {
        move || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) as Real / (1 << 24) as Real
        }
    }

    /// A prism of random outline and of one thickness, as the cells of a flat body are.
    fn prism(random: &mut impl FnMut() -> Real) -> SharedShape {
        let corners = 5 + (4.0 * random()) as usize;
        let turn = random();
        let points: Vec<Vector> = (0..corners)
            .flat_map(|k| {
                let angle =
                    (k as Real + 0.6 * random() + turn) * std::f32::consts::TAU / corners as Real;
                let radius = 0.006 + 0.003 * random();
                let (x, y) = (radius * angle.cos(), radius * angle.sin());
                [Vector::new(x, y, -0.004), Vector::new(x, y, 0.004)]
            })
            .collect();
        SharedShape::convex_hull(&points).expect("a prism has a volume")
    }

    /// How far apart two bodies are along the axis along which that is most, of the normals of faces and across pairs of edges, m.
    fn apart(pair: &Pair) -> Real {
        let edges = |body: Solid| match body.shape.as_convex_polyhedron() {
            Some(hull) => (hull.edges().iter())
                .map(|edge| edge.vertices.map(|v| hull.points()[v as usize]))
                .map(|[from, to]| to - from)
                .collect(),
            None => Vector::AXES.to_vec(),
        };
        let there = pair.pos12.rotation;
        let theirs: Vec<Vector> = edges(pair.b).into_iter().map(|e| there * e).collect();
        let across = (edges(pair.a).into_iter())
            .flat_map(|e| theirs.iter().map(move |other| e.cross(*other)))
            .filter_map(|axis| axis.try_normalize())
            .flat_map(|axis| [axis, -axis]);
        (pair.a.normals().into_iter())
            .chain(pair.b.normals().into_iter().map(|n| there * -n))
            .chain(across)
            .map(|axis| pair.gap(axis))
            .fold(Real::NEG_INFINITY, Real::max)
    }

    #[test]
    fn contacts_are_as_deep_as_the_bodies_overlap() {
        let mut random = numbers(7);
        let [mut overlapping, mut wrong_before, mut wrong_now] = [0; 3];
        for _ in 0..4000 {
            let shapes = [prism(&mut random), prism(&mut random)];
            let [x, y, z] = std::array::from_fn(|_| random() - 0.5);
            let shift = Vector::new(0.03 * x, 0.03 * y, 0.0076 + 1.2e-3 * z);
            let tilt = Vector::new(random() - 0.5, random() - 0.5, random());
            let pos12 = Pose::from_parts(
                shift,
                Rotation::from_scaled_axis(10_f32.powf(-4.0 + 2.0 * random()) * tilt),
            );
            let pair = [&*shapes[0], &*shapes[1]];
            let [a, b] = pair.map(|shape| Solid::of(shape).expect("it has faces"));
            let bodies = Pair {
                pos12: &pos12,
                a,
                b,
            };
            let gap = apart(&bodies);
            overlapping += usize::from(gap < 0.0);
            let wrong = |manifold: &Manifold| {
                let distances = manifold.points.iter().map(|point| point.dist);
                let deepest = distances.fold(Real::INFINITY, Real::min);
                let missed = gap < 0.0 && deepest > gap + 4.0 * ROUNDING;
                usize::from(missed || deepest < gap - 4.0 * ROUNDING)
            };
            let mut found = Manifold::new();
            DefaultQueryDispatcher
                .contact_manifold_convex_convex(
                    &pos12, pair[0], pair[1], None, None, 0.005, &mut found,
                )
                .expect("polyhedra are supported");
            wrong_before += wrong(&found);
            let mut ours = Manifold::new();
            touch(&pos12, pair, [None; 2], 0.005, &mut ours).expect("polyhedra are supported");
            wrong_now += wrong(&ours);
        }
        println!("of 4000 pairs {overlapping} overlap; Parry is wrong {wrong_before} times");
        assert!(overlapping > 1000 && wrong_before > 10);
        assert_eq!(wrong_now, 0);
    }

    #[test]
    fn bodies_of_any_size_are_searched_alike() {
        let mut random = numbers(11);
        let [mut overlapping, mut failed] = [0; 2];
        for round in 0..1200 {
            let second = match round % 2 {
                0 => prism(&mut random),
                _ => SharedShape::cuboid(0.005, 0.01, 0.003),
            };
            let first = prism(&mut random);
            let [x, y, z] = std::array::from_fn(|_| 0.02 * (random() - 0.5));
            let turn = Vector::new(random(), random(), random()) * 3.0;
            let size = [0.05, 1.0, 300.0][round % 3];
            let pos12 = Pose::from_parts(
                size * Vector::new(x, y, z),
                Rotation::from_scaled_axis(turn),
            );
            let shapes = [first, second]
                .map(|shape| shape.scale_dyn(Vector::splat(size), 1).expect("it scales"));
            let [a, b] =
                [&*shapes[0], &*shapes[1]].map(|shape| Solid::of(shape).expect("it has faces"));
            let pair = Pair {
                pos12: &pos12,
                a,
                b,
            };
            let gap = apart(&pair);
            if gap >= 0.0 {
                continue;
            }
            overlapping += 1;
            let Found::Close {
                normal, gap: depth, ..
            } = pair.search(0.002, None)
            else {
                panic!("bodies that overlap by {gap} m touch");
            };
            let error = 1e-3 * size * 0.01;
            assert!((pair.gap(normal) - depth).abs() < ROUNDING + error);
            failed += usize::from((depth - gap).abs() > error);
        }
        assert!(overlapping > 400, "{overlapping}");
        assert_eq!(failed, 0);
    }

    /// How far a shape's points without its radius are from a prism, by a search that has no tolerance: the farthest over many directions, the best of
    /// which is improved by ever smaller turns, m.
    fn distance(pair: &Pair, first: Vector) -> Real {
        let mut best = (first, pair.gap(first));
        let mut random = numbers(5);
        let mut direction = || 2.0 * Vector::new(random(), random(), random()) - Vector::ONE;
        for size in [
            1.0, 0.3, 0.1, 0.03, 0.01, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5,
        ] {
            let from = best.0;
            let from = if size < 1.0 { from } else { Vector::ZERO };
            for _ in 0..400 {
                let Some(axis) = (from + size * direction()).try_normalize() else {
                    continue;
                };
                let gap = pair.gap(axis);
                if gap > best.1 {
                    best = (axis, gap);
                }
            }
        }
        best.1
    }

    #[test]
    fn round_bodies_and_triangles_touch_prisms_where_they_are() {
        let mut random = numbers(3);
        let [mut wrong_before, mut wrong_now, mut touching] = [[0; 4]; 3];
        for round in 0..1200 {
            let first = prism(&mut random);
            let mut number = || random() - 0.5;
            let radius = 0.006 + 0.008 * number();
            let other = match round % 4 {
                0 => SharedShape::ball(radius),
                1 => SharedShape::capsule_y(0.004, radius),
                2 => SharedShape::cylinder(0.006, radius),
                _ => SharedShape::triangle(
                    Vector::new(-0.2, 0.0, -0.1),
                    Vector::new(0.1, 0.0, 0.3),
                    Vector::new(0.2, 0.0, -0.2),
                ),
            };
            let turn = Rotation::from_scaled_axis(3.0 * Vector::new(number(), number(), number()));
            let away = match round % 4 {
                3 => turn * Vector::Y,
                _ => Vector::new(number(), number(), number()).normalize(),
            };
            let [a, b] = [&*first, &*other].map(|shape| Solid::of(shape).expect("it has faces"));
            // As far along the direction as the bodies reach, and a little more or less.
            let edge = Pose::from_parts(Vector::ZERO, turn);
            let near = Pair { pos12: &edge, a, b }.gap(away);
            let more = [1e-3, 1e-6][round / 4 % 2] * number();
            let shift = away * (a.radius + b.radius - near + more);
            let pos12 = Pose::from_parts(shift, turn);
            let pair = Pair {
                pos12: &pos12,
                a,
                b,
            };
            let true_distance = distance(&pair, away) - b.radius;
            let deepest = |manifold: &Manifold| {
                let distances = manifold.points.iter().map(|point| point.dist);
                distances.fold(Real::INFINITY, Real::min)
            };
            let wrong = |manifold: &Manifold| {
                let near = true_distance < 1.9e-3;
                usize::from(near && (deepest(manifold) - true_distance).abs() > 2.0 * ROUNDING)
            };
            let pair = [&*first, &*other];
            let mut found = vec![];
            DefaultQueryDispatcher
                .contact_manifolds(&pos12, pair[0], pair[1], 2e-3, &mut found, &mut None)
                .expect("convex shapes are supported");
            wrong_before[round % 4] += wrong(&found[0]);
            let mut ours = Manifold::new();
            touch(&pos12, pair, [None; 2], 2e-3, &mut ours).expect("convex shapes are supported");
            touching[round % 4] += usize::from(!ours.points.is_empty());
            wrong_now[round % 4] += wrong(&ours);
            for point in &ours.points {
                let on = |shape: &dyn Shape, point: Vector| {
                    let bounds = shape.compute_local_aabb().loosened(1e-4);
                    bounds.contains_local_point(point)
                };
                assert!(on(pair[0], point.local_p1) && on(pair[1], point.local_p2));
            }
        }
        println!("of {touching:?} Parry is wrong {wrong_before:?} times, this {wrong_now:?}");
        assert!(touching.iter().all(|&count| count > 100));
        assert_eq!(wrong_now, [0; 4]);
    }
}
