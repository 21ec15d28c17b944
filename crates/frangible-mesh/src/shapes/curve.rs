//! Smooth lines through few points.

use glam::{DVec2, DVec3, DVec4};

/// A line through all `knots` (position and radius), `steps` pieces between two, by Catmull and Rom's cubic.
pub(super) fn smooth_line(knots: &[(DVec3, f64)], steps: u32) -> Vec<(DVec3, f64)> {
    let points: Vec<DVec4> = knots
        .iter()
        .map(|(at, radius)| at.extend(*radius))
        .collect();
    spline(&points, steps)
        .into_iter()
        .map(|q| (q.truncate(), q.w))
        .collect()
}

/// A smooth curve through knots in the plane, for outlines.
pub(super) fn smooth_profile(knots: &[(f64, f64)], steps: u32) -> Vec<DVec2> {
    let points: Vec<DVec4> = knots
        .iter()
        .map(|&(r, z)| DVec4::new(r, z, 0.0, 0.0))
        .collect();
    spline(&points, steps)
        .into_iter()
        .map(|q| DVec2::new(q.x, q.y))
        .collect()
}

fn spline(points: &[DVec4], steps: u32) -> Vec<DVec4> {
    let mut line: Vec<DVec4> = points.first().copied().into_iter().collect();
    for (i, ends) in points.windows(2).enumerate() {
        let (p, q) = (ends[0], ends[1]);
        let before = if i > 0 { points[i - 1] } else { 2.0 * p - q };
        let after = points.get(i + 2).copied().unwrap_or(2.0 * q - p);
        for step in 1..=steps {
            let t = f64::from(step) / f64::from(steps);
            let cubic = 3.0 * (p - q) + after - before;
            let square = 2.0 * before - 5.0 * p + 4.0 * q - after;
            line.push(0.5 * (2.0 * p + t * (q - before + t * (square + t * cubic))));
        }
    }
    line
}
