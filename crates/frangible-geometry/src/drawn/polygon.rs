//! Convex polygons in a plane.

use glam::DVec2;

/// The direction of an edge shorter than this is rounding; the triangle's own edges are of length 1.
pub(super) const SHORT: f64 = 1e-9;

/// Points no farther than this beyond the side of a polygon lie on it: the corners of two parts of a polygon are rounded.
const ROUNDING: f64 = 1e-12;

/// Corners in order, counter-clockwise.
pub(super) type Polygon = Vec<DVec2>;

/// Area; negative for a clockwise polygon.
pub(super) fn area(polygon: &[DVec2]) -> f64 {
    let fan = polygon.windows(2).skip(1);
    0.5 * fan
        .map(|w| (w[0] - polygon[0]).perp_dot(w[1] - polygon[0]))
        .sum::<f64>()
}

/// Mean of the corners.
pub(super) fn centre(polygon: &[DVec2]) -> DVec2 {
    polygon.iter().sum::<DVec2>() / polygon.len().max(1) as f64
}

/// The parts left and right of the line through `from` along `along`; either may be empty. Both get the same points
/// on the line.
pub(super) fn split(polygon: &[DVec2], from: DVec2, along: DVec2) -> [Polygon; 2] {
    let side = |p: DVec2| along.perp_dot(p - from);
    let room = || Polygon::with_capacity(polygon.len() + 1);
    let [mut left, mut right] = [room(), room()];
    for (i, &p) in polygon.iter().enumerate() {
        let q = polygon[(i + 1) % polygon.len()];
        let (s, t) = (side(p), side(q));
        if s >= 0.0 {
            left.push(p);
        }
        if s <= 0.0 {
            right.push(p);
        }
        if s * t < 0.0 {
            let cut = p.lerp(q, s / (s - t));
            left.push(cut);
            right.push(cut);
        }
    }
    [left, right].map(|p| if p.len() < 3 { Polygon::new() } else { p })
}

/// Halves across the longer side of the polygon's box.
pub(super) fn halves(polygon: &[DVec2]) -> [Polygon; 2] {
    let [low, high] = bounds(polygon);
    let size = high - low;
    let along = if size.x > size.y { DVec2::Y } else { DVec2::X };
    split(polygon, 0.5 * (low + high), along)
}

/// Lowest and highest corner of the polygon's box.
pub(super) fn bounds(polygon: &[DVec2]) -> [DVec2; 2] {
    polygon
        .iter()
        .fold([DVec2::INFINITY, DVec2::NEG_INFINITY], |[l, h], &p| {
            [l.min(p), h.max(p)]
        })
}

/// Returns true if two counter-clockwise convex polygons share more than their borders and what rounding makes of these.
pub(super) fn overlap(a: &[DVec2], b: &[DVec2]) -> bool {
    !has_separating_edge(a, b) && !has_separating_edge(b, a)
}

/// Returns true if all of `b` lies right of an edge of `a`, on it, or beyond it by no more than rounding; short edges do not count.
pub(super) fn has_separating_edge(a: &[DVec2], b: &[DVec2]) -> bool {
    (0..a.len()).any(|i| {
        let (from, to) = (a[i], a[(i + 1) % a.len()]);
        let square = from.distance_squared(to);
        let most = ROUNDING * square.sqrt();
        square > SHORT * SHORT && b.iter().all(|&p| (to - from).perp_dot(p - from) <= most)
    })
}
