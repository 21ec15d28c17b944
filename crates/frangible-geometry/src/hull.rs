//! Convex hulls of few corners, chosen until the hull is as true as asked for.
//!
//! The points are taken in the order of Quickhull [Barber, Dobkin, Huhdanpaa 1996]: of the hull of those taken so far, the point that is
//! farthest away comes next. It ends as soon as none is farther away than is allowed, which is after few points: of a shard with a thousand
//! vertices some twenty matter.

use glam::{DVec3, Vec3};

use crate::closest_on_triangle;

/// Distance from a face below which a point counts as on it, over the extent of all points: above the rounding of coordinates in f32.
const ON_FACE: f64 = 1e-6;

/// Share of the extent that a tetrahedron of the points has to reach in each direction; flatter points have no hull.
const FLAT: f64 = 1e-5;

/// A triangle of the hull, counter-clockwise from outside.
struct Face {
    corners: [u32; 3],
    normal: DVec3,
    offset: f64,
    /// Points that lie outside of this face, the farthest of them, and how far it is away, m.
    outside: Vec<u32>,
    farthest: (f64, u32),
    gone: bool,
}

impl Face {
    fn new(points: &[DVec3], corners: [u32; 3]) -> Self {
        let [a, b, c] = corners.map(|v| points[v as usize]);
        let normal = (b - a).cross(c - a).normalize_or_zero();
        Self {
            corners,
            normal,
            offset: normal.dot(a),
            outside: Vec::new(),
            farthest: (0.0, 0),
            gone: false,
        }
    }

    /// Distance of a point from the plane of the face, m; negative inside.
    fn height(&self, point: DVec3) -> f64 {
        self.normal.dot(point) - self.offset
    }

    fn take(&mut self, point: u32, away: f64) {
        self.outside.push(point);
        if away > self.farthest.0 {
            self.farthest = (away, point);
        }
    }
}

/// A convex polyhedron whose corners are some of many points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ConvexHull {
    /// Its corners, in the order of the points, m.
    pub corners: Vec<Vec3>,
    /// Its faces in triangles, counter-clockwise from outside.
    pub triangles: Vec<[u32; 3]>,
}

impl ConvexHull {
    /// Makes the hull of at most `most` of the points, 4 or more, from which none of the points is farther away than `within`, m, as far as so few
    /// suffice. Returns `None` if the points lie in a plane.
    #[must_use]
    pub fn new(points: &[Vec3], most: usize, within: f32) -> Option<Self> {
        let mut hull = Hull::new(points, f64::from(within))?;
        while hull.taken.len() < most
            && let Some(face) = hull.farthest()
        {
            hull.add(face);
        }
        hull.taken.sort_unstable();
        let number = |v| hull.taken.partition_point(|&taken| taken < v) as u32;
        let faces = hull.faces.iter().filter(|face| !face.gone);
        Some(Self {
            corners: hull.taken.iter().map(|&v| points[v as usize]).collect(),
            triangles: faces.map(|face| face.corners.map(number)).collect(),
        })
    }

    /// Its volume, m³.
    #[must_use]
    pub fn volume(&self) -> f64 {
        let at = |v: u32| self.corners[v as usize].as_dvec3();
        let middle = at(0);
        let cone = |&[a, b, c]: &[u32; 3]| {
            let [a, b, c] = [a, b, c].map(|v| at(v) - middle);
            a.dot(b.cross(c)) / 6.0
        };
        self.triangles.iter().map(cone).sum()
    }
}

/// A hull that grows.
struct Hull {
    points: Vec<DVec3>,
    faces: Vec<Face>,
    taken: Vec<u32>,
    /// Height up to which a point counts as on a face, and distance that is allowed, m.
    on_face: f64,
    within: f64,
}

impl Hull {
    /// A tetrahedron of points that lie far apart.
    fn new(points: &[Vec3], within: f64) -> Option<Self> {
        let points: Vec<DVec3> = points.iter().map(|p| p.as_dvec3()).collect();
        let most = |score: &dyn Fn(DVec3) -> f64| {
            let scores = points.iter().map(|&p| score(p)).enumerate();
            let first = scores.reduce(|a, b| if b.1 > a.1 { b } else { a });
            first.filter(|(_, score)| score.is_finite())
        };
        let at = |v: usize| points[v];
        let (a, _) = most(&|p| -p.x)?;
        let (b, size) = most(&|p| p.distance(at(a)))?;
        let along = (at(b) - at(a)).normalize_or_zero();
        let (c, width) = most(&|p| (p - at(a)).reject_from_normalized(along).length())?;
        let across = along.cross(at(c) - at(a)).normalize_or_zero();
        let (d, depth) = most(&|p| (p - at(a)).dot(across).abs())?;
        if width.min(depth) <= FLAT * size || size <= 0.0 {
            return None;
        }
        let mut corners = [a, b, c, d].map(|v| v as u32);
        if (at(d) - at(a)).dot(across) > 0.0 {
            corners.swap(1, 2);
        }
        let [a, b, c, d] = corners;
        let on_face = ON_FACE * size;
        let mut hull = Self {
            faces: [[a, b, c], [a, d, b], [b, d, c], [c, d, a]]
                .map(|corners| Face::new(&points, corners))
                .into(),
            points,
            taken: corners.to_vec(),
            on_face,
            within: within.max(on_face),
        };
        let all: Vec<u32> = (0..hull.points.len() as u32).collect();
        hull.share_out(&all, 0);
        Some(hull)
    }

    /// Gives each point to the nearest face, from this one on, outside of which it lies.
    fn share_out(&mut self, points: &[u32], from: usize) {
        for &point in points {
            let place = self.points[point as usize];
            let mut nearest = (f64::INFINITY, 0);
            for (i, face) in self.faces.iter().enumerate().skip(from) {
                let height = face.height(place);
                if height > self.on_face && height < nearest.0 {
                    let away = self.distance(face, place);
                    nearest = if away < nearest.0 { (away, i) } else { nearest };
                }
            }
            if nearest.0.is_finite() {
                self.faces[nearest.1].take(point, nearest.0);
            }
        }
    }

    /// Distance of a point from a face, m: above a sharp edge it may be far away, and yet hardly above the plane of any face.
    fn distance(&self, face: &Face, place: DVec3) -> f64 {
        let corners = face.corners.map(|v| self.points[v as usize]);
        let weights = closest_on_triangle(corners, place);
        let on = corners.iter().zip(weights).map(|(&c, weight)| c * weight);
        place.distance(on.sum())
    }

    /// The face whose farthest point is farthest away, if that is more than is allowed.
    fn farthest(&self) -> Option<usize> {
        let faces = self.faces.iter().enumerate().filter(|(_, f)| !f.gone);
        let points = faces.map(|(i, face)| (face.farthest.0, i));
        let best = points.reduce(|a, b| if b.0 > a.0 { b } else { a });
        best.filter(|best| best.0 > self.within).map(|best| best.1)
    }

    /// Adds the farthest point of a face: the faces that it sees give way to a fan about it.
    fn add(&mut self, face: usize) {
        let point = self.faces[face].farthest.1;
        let place = self.points[point as usize];
        let sees = |f: &Face| !f.gone && f.height(place) > 0.0;
        let seen: Vec<usize> = (0..self.faces.len())
            .filter(|&i| sees(&self.faces[i]))
            .collect();
        // Sides of seen faces whose other side is not seen.
        let sides = seen.iter().flat_map(|&i| {
            let [a, b, c] = self.faces[i].corners;
            [[a, b], [b, c], [c, a]]
        });
        let sides: Vec<[u32; 2]> = sides.collect();
        let rim = sides.iter().filter(|[a, b]| !sides.contains(&[*b, *a]));
        let fan: Vec<Face> = rim
            .map(|&[a, b]| Face::new(&self.points, [a, b, point]))
            .collect();
        let mut orphans = Vec::new();
        for &i in &seen {
            let face = &mut self.faces[i];
            face.gone = true;
            orphans.append(&mut face.outside);
        }
        orphans.retain(|&p| p != point);
        self.taken.push(point);
        let from = self.faces.len();
        self.faces.extend(fan);
        self.share_out(&orphans, from);
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::ConvexHull;
    use crate::random::numbers;
    use glam::Vec3;

    /// Height of the point farthest above a face of the hull, m.
    fn highest(hull: &ConvexHull, points: &[Vec3]) -> f64 {
        let heights = hull.triangles.iter().flat_map(|triangle| {
            let [a, b, c] = triangle.map(|v| hull.corners[v as usize].as_dvec3());
            let normal = (b - a).cross(c - a).normalize_or_zero();
            points.iter().map(move |p| normal.dot(p.as_dvec3() - a))
        });
        heights.fold(f64::NEG_INFINITY, f64::max)
    }

    fn is_closed(hull: &ConvexHull) -> bool {
        let mut sides: BTreeMap<[u32; 2], i32> = BTreeMap::new();
        for &[a, b, c] in &hull.triangles {
            for [from, to] in [[a, b], [b, c], [c, a]] {
                *sides.entry([from.min(to), from.max(to)]).or_default() +=
                    if from < to { 1 } else { -1 };
            }
        }
        sides.values().all(|&count| count == 0)
    }

    #[test]
    fn a_hull_misses_no_point_by_more_than_is_allowed() {
        let mut number = numbers();
        let mut random = || Vec3::from_array([0; 3].map(|_| 2.0 * number() - 1.0));
        let ball: Vec<Vec3> = (0..2000).map(|_| random().normalize_or(Vec3::X)).collect();
        let shard: Vec<Vec3> = (ball.iter())
            .map(|p| Vec3::new(30.0, 9.0, 0.5) * *p + 4.0 * (p.x + p.y))
            .collect();
        for (points, size) in [(ball, 2.0), (shard, 60.0)] {
            let mut before = 0;
            for share in [0.1, 0.03, 0.01, 0.003] {
                let within = share * size;
                let hull = ConvexHull::new(&points, usize::MAX, within).unwrap();
                let missed = highest(&hull, &points);
                assert!(is_closed(&hull), "{share}: a side has one face");
                assert!(missed <= f64::from(within), "{missed} of {within}");
                assert!(highest(&hull, &hull.corners) < 1e-6 * f64::from(size));
                assert!(hull.corners.len() > before && hull.corners.len() < points.len());
                before = hull.corners.len();
            }
        }
    }

    #[test]
    fn a_box_has_its_corners_and_hardly_more_however_many_points_lie_on_it() {
        let steps = 0..=6;
        let grid = steps
            .clone()
            .flat_map(|i| steps.clone().map(move |j| (i, j)));
        let grid = grid.flat_map(|(i, j)| steps.clone().map(move |k| (i, j, k)));
        let side = Vec3::new(0.07, 0.02, 0.011);
        let points: Vec<Vec3> = grid
            .map(|(i, j, k): (i32, i32, i32)| side * Vec3::new(i as f32, j as f32, k as f32))
            .collect();
        let hull = ConvexHull::new(&points, usize::MAX, 1e-5).unwrap();
        // Of the points of an edge that lie equally far away, any may come first.
        assert!(
            (8..=10).contains(&hull.corners.len()),
            "{}",
            hull.corners.len()
        );
        assert_eq!(hull.triangles.len(), 2 * hull.corners.len() - 4);
        let volume = 216.0 * side.as_dvec3().element_product();
        assert!((hull.volume() / volume - 1.0).abs() < 1e-6);
    }

    #[test]
    fn no_more_corners_are_taken_than_asked_for_and_a_flat_body_has_no_hull() {
        let mut number = numbers();
        let mut points: Vec<Vec3> = (0..300)
            .map(|_| Vec3::from_array([0; 3].map(|_| number())))
            .collect();
        for most in [4, 9, 20] {
            let hull = ConvexHull::new(&points, most, 0.0).unwrap();
            assert_eq!(hull.corners.len(), most);
            assert!(hull.volume() > 0.0 && is_closed(&hull));
        }
        points.iter_mut().for_each(|p| p.z = 0.3 * p.x - p.y);
        assert!(ConvexHull::new(&points, 20, 1e-4).is_none());
        assert!(ConvexHull::new(&points[..2], 20, 1e-4).is_none());
        assert!(ConvexHull::new(&[], 20, 1e-4).is_none());
    }
}
