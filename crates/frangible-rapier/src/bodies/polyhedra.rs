//! Contacts of convex polyhedra, checked: Parry's search for closest points fails where flat faces lie close together.
//!
//! The search (GJK) keeps a simplex of support points. Where two flat faces nearly touch, these points lie in one plane, their
//! simplex has no volume, and rounding decides on which side of it the origin is. It may then end with a normal that
//! points through the bodies: of two tiles 0.1 mm apart, cut into 64 cells each, 30 pairs of cells were said to overlap by up to twice their
//! thickness, and the solver pushed the tiles apart.
//!
//! Whether a normal is right can be told without a search: along it, the gap between the two bodies' support points is the
//! distance that was found. Where it is not, the normal is sought among those of the faces, and of pairs of edges where all
//! faces overlap (separating axes), which need no simplex.

use rapier3d::geometry::{ContactData, ContactManifoldData, TypedShape};
use rapier3d::math::{Pose, Real, Vector};
use rapier3d::parry::query::details::{
    NormalConstraints, contact_support_map_support_map_with_params,
};
use rapier3d::parry::query::gjk::{GJKResult, VoronoiSimplex};
use rapier3d::parry::query::{
    ContactManifold, DefaultQueryDispatcher, PersistentQueryDispatcher, TrackedContact, Unsupported,
};
use rapier3d::parry::shape::{PackedFeatureId, PolygonalFeature, PolygonalFeatureMap, Shape};

type Manifold = ContactManifold<ContactManifoldData, ContactData>;

/// Difference between the distance that was found and the gap along its normal that is taken for rounding, m.
const ROUNDING: Real = 5e-5;

/// Share of a distance by which the search may miss it.
const SEARCH_ERROR: Real = 2e-3;

/// Lead that a pair of edges needs over every face in parting bodies, m, so that normals do not flicker between equals.
const EDGE_LEAD: Real = 1e-6;

/// Whether a shape is convex and has flat faces.
pub(crate) fn is_polyhedron(shape: &dyn Shape) -> bool {
    matches!(
        shape.as_typed_shape(),
        TypedShape::ConvexPolyhedron(_) | TypedShape::Cuboid(_)
    )
}

/// Parry's contacts of two convex shapes; those of polyhedra and boxes are mended where the search failed.
pub(crate) fn touch(
    pos12: &Pose,
    shapes: [&dyn Shape; 2],
    constraints: [Option<&dyn NormalConstraints>; 2],
    prediction: Real,
    manifold: &mut Manifold,
) -> Result<(), Unsupported> {
    let [g1, g2] = shapes;
    let parrys = |manifold: &mut Manifold| {
        DefaultQueryDispatcher.contact_manifold_convex_convex(
            pos12,
            g1,
            g2,
            constraints[0],
            constraints[1],
            prediction,
            manifold,
        )
    };
    // Two boxes are not searched, but parted along axes.
    let boxes = g1.as_cuboid().is_some() && g2.as_cuboid().is_some();
    let (Some(a), Some(b)) = (Polyhedron::of(g1), Polyhedron::of(g2)) else {
        return parrys(manifold);
    };
    if boxes || constraints.iter().any(Option::is_some) {
        return parrys(manifold);
    }
    if manifold.try_update_contacts(pos12) {
        return Ok(());
    }
    let old = manifold.points.clone();
    parrys(manifold)?;
    let pair = Pair { pos12, a, b };
    if !pair.agrees(manifold, prediction) {
        pair.mend(manifold, prediction);
        manifold.match_contacts(&old);
    }
    Ok(())
}

/// A convex shape with flat faces.
#[derive(Clone, Copy)]
struct Polyhedron<'a> {
    shape: &'a dyn Shape,
    map: &'a dyn PolygonalFeatureMap,
}

impl<'a> Polyhedron<'a> {
    fn of(shape: &'a dyn Shape) -> Option<Self> {
        let (map, _) = shape.as_polygonal_feature_map()?;
        is_polyhedron(shape).then_some(Self { shape, map })
    }

    fn normals(&self) -> Vec<Vector> {
        match self.shape.as_convex_polyhedron() {
            // A face without an area has no normal.
            Some(hull) => (hull.faces().iter().map(|face| face.normal))
                .filter(|normal| normal.length_squared() > 0.5)
                .collect(),
            None => Vector::AXES.into_iter().flat_map(|n| [n, -n]).collect(),
        }
    }

    /// The edges in a frame in which the shape stands as `pose` says.
    fn edges(&self, pose: &Pose) -> Vec<Edge> {
        let edge = |point, normals: [Vector; 2]| {
            Edge::new(*pose * point, normals.map(|n| pose.rotation * n))
        };
        match (self.shape.as_convex_polyhedron(), self.shape.as_cuboid()) {
            (Some(hull), _) => {
                // Parry's edges name faces that it may have dropped; the faces' own lists of edges are right.
                let mut faces = vec![[None; 2]; hull.edges().len()];
                for face in hull.faces() {
                    let first = face.first_vertex_or_edge as usize;
                    let last = first + face.num_vertices_or_edges as usize;
                    for &of in &hull.edges_adj_to_face()[first..last] {
                        let [a, b] = &mut faces[of as usize];
                        *(if a.is_none() { a } else { b }) = Some(face.normal);
                    }
                }
                (faces.iter().zip(hull.edges()))
                    .filter_map(|(&[a, b], of)| {
                        Some(edge(hull.points()[of.vertices[0] as usize], [a?, b?]))
                    })
                    .collect()
            }
            (None, Some(cuboid)) => (0..3)
                .flat_map(|axis| {
                    let [u, v] = [1, 2].map(|next| Vector::AXES[(axis + next) % 3]);
                    [(u, v), (u, -v), (-u, v), (-u, -v)]
                })
                .map(|(u, v)| edge(cuboid.half_extents * (u + v), [u, v]))
                .collect(),
            _ => Vec::new(),
        }
    }
}

/// An edge of a polyhedron.
struct Edge {
    point: Vector,
    /// Normals of the two faces that meet at it.
    normals: [Vector; 2],
    /// Their cross product, which lies along the edge.
    along: Vector,
}

impl Edge {
    fn new(point: Vector, normals: [Vector; 2]) -> Self {
        let along = normals[0].cross(normals[1]);
        Self {
            point,
            normals,
            along,
        }
    }

    /// The axis across both edges, from the first body to the second; none where it is not these edges that face each other along it.
    ///
    /// The normals of what touches an edge from outside are the arc between its faces' normals on the unit sphere. Two edges face each
    /// other where the one's arc crosses the other's, turned round.
    fn across(&self, other: &Self) -> Option<Vector> {
        let [a, b] = self.normals.map(|n| n.dot(other.along));
        let [c, d] = other.normals.map(|n| -n.dot(self.along));
        if a * b >= 0.0 || c * d >= 0.0 || b * c <= 0.0 {
            return None;
        }
        let axis = self.along.cross(other.along).try_normalize()?;
        Some(axis * axis.dot(self.normals[0] + self.normals[1]).signum())
    }
}

/// Two polyhedra; what has no frame said is in that of the first.
struct Pair<'a> {
    pos12: &'a Pose,
    a: Polyhedron<'a>,
    b: Polyhedron<'a>,
}

impl Pair<'_> {
    /// How far apart the bodies are along a unit normal from the first to the second, m; negative where they overlap.
    fn gap(&self, normal: Vector) -> Real {
        let near = self.a.map.local_support_point(normal);
        let far = self
            .b
            .map
            .local_support_point(self.pos12.rotation.inverse() * -normal);
        (*self.pos12 * far - near).dot(normal)
    }

    /// Whether the closest points that were found lie as far apart as the bodies do along their normal, and no face's normal parts bodies that
    /// overlap farther.
    fn agrees(&self, manifold: &Manifold, prediction: Real) -> bool {
        if manifold.local_n1 == Vector::ZERO {
            return false;
        }
        match manifold.points.last() {
            // Parry marks the closest points thus.
            Some(closest) if closest.fid1 == PackedFeatureId::UNKNOWN => {
                let found = closest.dist;
                let error = ROUNDING + SEARCH_ERROR * found.abs();
                (found - self.gap(manifold.local_n1)).abs() <= error
                    && (found >= -ROUNDING || self.farthest_face(0.0).1 <= found + error)
            }
            Some(_) => true,
            None => self.gap(manifold.local_n1) > prediction - ROUNDING,
        }
    }

    /// The face's normal along which the bodies are farthest apart, and how far, m; any along which they are farther apart than `enough`.
    fn farthest_face(&self, enough: Real) -> (Vector, Real) {
        let of_a = self.a.normals().into_iter();
        let of_b = self.b.normals().into_iter();
        let mut best = (Vector::Y, Real::NEG_INFINITY);
        for axis in of_a.chain(of_b.map(|n| self.pos12.rotation * -n)) {
            let gap = self.gap(axis);
            if gap > best.1 {
                best = (axis, gap);
            }
            if gap > enough {
                break;
            }
        }
        best
    }

    /// The normal along which bodies that overlap are farthest apart, and how far, m. Of bodies that are apart it is a face's, along
    /// which corners that face each other may seem nearer than they are; or any along which they are farther apart than `enough`.
    fn farthest(&self, enough: Real) -> (Vector, Real) {
        let mut best = self.farthest_face(enough);
        if best.1 >= 0.0 {
            return best;
        }
        let theirs = self.b.edges(self.pos12);
        for edge in self.a.edges(&Pose::IDENTITY) {
            for (axis, gap) in (theirs.iter())
                .filter_map(|other| Some((edge.across(other)?, other)))
                .map(|(axis, other)| (axis, axis.dot(other.point - edge.point)))
            {
                // Of edges that are parallel but for rounding the axis is noise: what counts is how far apart the bodies are along it.
                if gap > best.1 + EDGE_LEAD {
                    let gap = self.gap(axis);
                    if gap > best.1 + EDGE_LEAD {
                        best = (axis, gap);
                    }
                }
            }
        }
        best
    }

    /// Contacts anew, along the normal along which the bodies are farthest apart.
    fn mend(&self, manifold: &mut Manifold, prediction: Real) {
        let (normal, gap) = self.farthest(prediction);
        let there = self.pos12.rotation.inverse() * -normal;
        manifold.clear();
        manifold.local_n1 = normal;
        manifold.local_n2 = there;
        if gap > prediction {
            return;
        }
        let mut features = [PolygonalFeature::default(), PolygonalFeature::default()];
        self.a.map.local_support_feature(normal, &mut features[0]);
        self.b.map.local_support_feature(there, &mut features[1]);
        PolygonalFeature::contacts(
            self.pos12,
            &self.pos12.inverse(),
            normal,
            there,
            &features[0],
            &features[1],
            manifold,
            false,
        );
        manifold.points.extend(self.closest(normal, gap));
    }

    /// The points that are closest along the normal along which the bodies are `gap` apart, m.
    ///
    /// The search that fails for bodies that touch is run on bodies that are moved apart by the smaller one's size, where it is sound.
    fn closest(&self, normal: Vector, gap: Real) -> Option<TrackedContact<ContactData>> {
        let [a, b] =
            [self.a, self.b].map(|body| body.shape.compute_local_aabb().half_extents().length());
        let shift = normal * (a.min(b) - gap);
        let apart = Pose::from_parts(self.pos12.translation + shift, self.pos12.rotation);
        let GJKResult::ClosestPoints(near, far, _) = contact_support_map_support_map_with_params(
            &apart,
            self.a.map,
            self.b.map,
            Real::MAX,
            &mut VoronoiSimplex::new(),
            Some(normal),
        ) else {
            return None;
        };
        let far = far - shift;
        (((far - near).dot(normal) - gap).abs() <= ROUNDING).then(|| {
            let unknown = PackedFeatureId::UNKNOWN;
            let far = self.pos12.inverse_transform_point(far);
            TrackedContact::new(near, far, unknown, unknown, gap)
        })
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
            let [a, b] = pair.map(|shape| Polyhedron::of(shape).expect("it has faces"));
            let bodies = Pair {
                pos12: &pos12,
                a,
                b,
            };
            let (_, gap) = bodies.farthest(Real::INFINITY);
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
    fn bodies_that_overlap_are_parted_along_the_shortest_way() {
        let mut random = numbers(11);
        let mut across_edges = 0;
        for round in 0..400 {
            let second = match round % 2 {
                0 => prism(&mut random),
                _ => SharedShape::cuboid(0.005, 0.01, 0.003),
            };
            let first = prism(&mut random);
            let [x, y, z] = std::array::from_fn(|_| 0.02 * (random() - 0.5));
            let turn = Vector::new(random(), random(), random()) * 3.0;
            let pos12 = Pose::from_parts(Vector::new(x, y, z), Rotation::from_scaled_axis(turn));
            let [a, b] =
                [&*first, &*second].map(|shape| Polyhedron::of(shape).expect("it has faces"));
            let pair = Pair {
                pos12: &pos12,
                a,
                b,
            };
            let (normal, gap) = pair.farthest(Real::INFINITY);
            if gap >= 0.0 {
                continue;
            }
            assert!((pair.gap(normal) - gap).abs() < 1e-6);
            let faces = (a.normals().into_iter())
                .chain(b.normals().iter().map(|&n| pos12.rotation * -n))
                .map(|axis| pair.gap(axis))
                .fold(Real::NEG_INFINITY, Real::max);
            let theirs = b.edges(&pos12);
            let every = (a.edges(&Pose::IDENTITY).iter())
                .flat_map(|edge| theirs.iter().map(|other| edge.along.cross(other.along)))
                .filter_map(Vector::try_normalize)
                .flat_map(|axis| [pair.gap(axis), pair.gap(-axis)])
                .fold(faces, Real::max);
            across_edges += usize::from(every > faces + 1e-5);
            assert!((gap - every).abs() < 1e-6, "{gap} of {every}");
        }
        assert!(across_edges > 20, "{across_edges}");
    }
}
