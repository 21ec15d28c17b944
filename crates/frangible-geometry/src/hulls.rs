//! Hulls of the convex parts of a body that follow what is drawn of it.
//!
//! The corners of the parts are nodes of the fracture mesh. The surface that an author drew lies outside of that mesh here and there, by a part of a
//! tetrahedron (measured: 1 % of a piece's longest side, and more on small ones). A piece whose collider follows the mesh alone sinks into the floor by as
//! much.

use glam::{DVec3, Vec3};

use crate::{ConvexHull, closest_on_triangle};

/// Volume below which a hull is none, m³: contacts of flat hulls have random normals.
const LEAST_VOLUME: f64 = 1e-15;

/// Distance from all parts beyond which a drawn point belongs to none of them, over the distance that is allowed: it is on a shell that the mesh does not have.
const BEYOND: f64 = 10.0;

/// Hulls of convex parts, each as [`ConvexHull::new`] makes it. The points of a part without a volume go to its nearest neighbour, so that no corner is
/// left without a hull. A drawn point that no hull reaches goes to the nearest one, unless it is far from all.
#[must_use]
pub fn hulls_of_parts(
    parts: Vec<Vec<Vec3>>,
    drawn: &[Vec3],
    most: usize,
    within: f32,
) -> Vec<ConvexHull> {
    let hull = |points: &[Vec3]| {
        ConvexHull::new(points, most, within).filter(|hull| hull.volume() > LEAST_VOLUME)
    };
    let (mut all, mut flat) = (Vec::with_capacity(parts.len()), Vec::new());
    for points in parts {
        match hull(&points) {
            Some(hull) => all.push((points, hull)),
            None => flat.push(points),
        }
    }
    let grow = |(part, grown): &mut (Vec<Vec3>, ConvexHull), points: Vec<Vec3>| {
        part.extend(points);
        if let Some(hull) = hull(part) {
            *grown = hull;
        }
    };
    let middle = |points: &[Vec3]| points.iter().sum::<Vec3>() / points.len().max(1) as f32;
    for points in flat {
        let at = middle(&points);
        let away = |part: &(Vec<Vec3>, ConvexHull)| middle(&part.0).distance_squared(at);
        let nearest = all.iter_mut().min_by(|a, b| away(a).total_cmp(&away(b)));
        if let Some(part) = nearest {
            grow(part, points);
        }
    }
    let missed = missed(all.iter().map(|(_, hull)| hull), drawn, f64::from(within));
    for (part, points) in all.iter_mut().zip(missed) {
        if !points.is_empty() {
            grow(part, points);
        }
    }
    all.into_iter().map(|(_, hull)| hull).collect()
}

/// The points farther than is allowed from all hulls, each with the hull that is nearest.
fn missed<'a>(
    hulls: impl Iterator<Item = &'a ConvexHull>,
    points: &[Vec3],
    within: f64,
) -> Vec<Vec<Vec3>> {
    let solids: Vec<Solid> = hulls.map(Solid::new).collect();
    let mut missed = vec![Vec::new(); solids.len()];
    // Neighbours in the list are neighbours on the surface, most of them.
    let mut last = 0;
    for &point in points {
        let place = point.as_dvec3();
        let order = (last..solids.len()).chain(0..last);
        let mut nearest = (BEYOND * within, None);
        for i in order {
            if let Some(away) = solids[i].distance(place, nearest.0) {
                nearest = (away, Some(i));
                if away <= within {
                    break;
                }
            }
        }
        if let (away, Some(i)) = nearest {
            last = i;
            if away > within {
                missed[i].push(point);
            }
        }
    }
    missed
}

/// Planes of the faces of a hull, and their corners.
struct Solid(Vec<([DVec3; 3], DVec3)>);

impl Solid {
    fn new(hull: &ConvexHull) -> Self {
        let face = |triangle: &[u32; 3]| {
            let corners = triangle.map(|v| hull.corners[v as usize].as_dvec3());
            let [a, b, c] = corners;
            (corners, (b - a).cross(c - a).normalize_or_zero())
        };
        Self(hull.triangles.iter().map(face).collect())
    }

    /// Distance of a point, 0 inside; `None` if that is not below a limit.
    fn distance(&self, point: DVec3, limit: f64) -> Option<f64> {
        let heights = || (self.0.iter()).map(|(corners, normal)| normal.dot(point - corners[0]));
        if heights().any(|height| height >= limit) {
            return None;
        }
        // The nearest face is one that the point sees.
        let seen = self.0.iter().zip(heights()).filter(|(_, h)| *h > 0.0);
        let away = seen.map(|((corners, _), _)| {
            let weights = closest_on_triangle(*corners, point);
            let on = corners.iter().zip(weights).map(|(&c, weight)| c * weight);
            point.distance(on.sum())
        });
        let away = away.reduce(f64::min).unwrap_or(0.0);
        (away < limit).then_some(away)
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::{BEYOND, hulls_of_parts};
    use crate::ConvexHull;

    /// Corners of a box, m.
    fn cuboid(low: Vec3, high: Vec3) -> Vec<Vec3> {
        let corner = |i: u32| {
            let side = |axis: usize| if i >> axis & 1 == 1 { high } else { low }[axis];
            Vec3::from_array([0, 1, 2].map(side))
        };
        (0..8).map(corner).collect()
    }

    /// Largest extent of some of the hulls in a direction, m.
    fn reach(hulls: &[ConvexHull], direction: Vec3) -> f32 {
        let corners = hulls.iter().flat_map(|hull| &hull.corners);
        corners.map(|p| p.dot(direction)).fold(f32::MIN, f32::max)
    }

    #[test]
    fn a_drawn_point_that_no_part_reaches_goes_to_the_nearest_one() {
        let within = 1e-4;
        let parts = || {
            let low = cuboid(Vec3::ZERO, Vec3::new(0.02, 0.01, 0.01));
            let high = cuboid(Vec3::new(0.0, 0.01, 0.0), Vec3::new(0.01, 0.03, 0.01));
            vec![low, high]
        };
        let plain = hulls_of_parts(parts(), &[], 64, within);
        // Over the low part beside the high one: no hull may fill the corner between the two.
        let beside = Vec3::new(0.0195, 0.0106, 0.005);
        let above = Vec3::new(0.005, 0.0305, 0.005);
        let near = Vec3::new(0.005, 0.01 - 0.5 * within, -0.5 * within);
        let far = Vec3::new(0.03 + 2.0 * BEYOND as f32 * within, 0.02, 0.005);
        let grown = hulls_of_parts(parts(), &[beside, above, near, far], 64, within);
        assert_eq!(plain.len(), 2);
        let [low, high] = [&grown[..1], &grown[1..]];
        assert!(low[0].corners.contains(&beside) && high[0].corners.contains(&above));
        assert_eq!(reach(low, Vec3::X), 0.02);
        assert_eq!(reach(high, Vec3::X), 0.01);
        assert_eq!(reach(&grown, Vec3::NEG_Z), 0.0);
        assert_eq!(reach(&grown, Vec3::Y), above.y);
    }

    #[test]
    fn a_point_beyond_a_sharp_tip_is_missed_though_it_is_hardly_above_a_face() {
        let within = 1e-4;
        // A wedge of a thirtieth.
        let wedge = vec![
            Vec3::new(0.0, 0.0, 0.0),
            Vec3::new(0.0, 0.001, 0.0),
            Vec3::new(0.0, 0.0, 0.01),
            Vec3::new(0.0, 0.001, 0.01),
            Vec3::new(0.03, 0.0, 0.0),
            Vec3::new(0.03, 0.0, 0.01),
        ];
        let tip = Vec3::new(0.0308, 0.0, 0.005);
        let hulls = hulls_of_parts(vec![wedge], &[tip], 64, within);
        assert_eq!(reach(&hulls, Vec3::X), tip.x);
    }
}
