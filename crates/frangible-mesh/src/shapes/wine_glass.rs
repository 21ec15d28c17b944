//! A wine glass.

use super::MILLIMETRE;
use crate::DistanceSolid;
use glam::DVec2;

/// Corners of half a section through the axis, from the middle of the foot outside up to the rim and inside down again: (r, z), mm.
const OUTSIDE: [(f64, f64); 20] = [
    (0.0, 1.0),
    (29.0, 1.0),
    (33.5, 1.0),
    (33.5, 1.4),
    (24.0, 2.8),
    (12.0, 5.0),
    (6.5, 9.0),
    (4.0, 16.0),
    (3.0, 26.0),
    (2.8, 45.0),
    (2.9, 70.0),
    (3.6, 82.0),
    (8.0, 89.0),
    (19.0, 96.0),
    (30.0, 107.0),
    (36.9, 122.0),
    (38.9, 138.0),
    (37.4, 155.0),
    (34.4, 172.0),
    (31.9, 186.0),
];
const INSIDE: [(f64, f64); 8] = [
    (34.2, 172.0),
    (37.2, 155.0),
    (38.7, 138.0),
    (36.7, 122.2),
    (29.8, 107.2),
    (18.6, 96.6),
    (8.0, 91.5),
    (0.0, 90.6),
];

/// Margin added on all sides of the section, mm, which rounds its corners: half the thickness of the wall.
const ROUND: f64 = 1.0;

/// Steps of the curve between two corners of the section.
const STEPS: usize = 6;

/// A wine glass 187 mm tall, with a bowl 80 mm across, a foot of 69 mm and a stem of 7.6 mm; its wall is 2.0 mm
/// thick at the rim and a little more below: a sturdy one.
pub fn wine_glass() -> DistanceSolid {
    let corners: Vec<DVec2> = OUTSIDE
        .iter()
        .chain(&INSIDE)
        .map(|&(r, z)| DVec2::new(r, z))
        .collect();
    // The foot is straight below, and the rim is an edge.
    let (foot, rim) = (4, OUTSIDE.len() - 1);
    let mut section = corners[..foot].to_vec();
    smooth(&corners[foot..=rim], &mut section);
    section.push(corners[rim]);
    smooth(&corners[rim + 1..], &mut section);
    section.extend(corners.last());
    DistanceSolid::revolved(section)
        .grown(ROUND)
        .scaled(MILLIMETRE)
}

/// Adds a curve through points, without the last one: Catmull and Rom's.
fn smooth(points: &[DVec2], into: &mut Vec<DVec2>) {
    for i in 0..points.len() - 1 {
        let at = |k: usize| points[k.min(points.len() - 1)];
        let [a, b, c, d] = [at(i.saturating_sub(1)), at(i), at(i + 1), at(i + 2)];
        for step in 0..STEPS {
            let t = step as f64 / STEPS as f64;
            let curve = 2.0 * b
                + (c - a) * t
                + (2.0 * a - 5.0 * b + 4.0 * c - d) * t * t
                + (3.0 * b - a - 3.0 * c + d) * t * t * t;
            into.push(DVec2::new((0.5 * curve.x).max(0.0), 0.5 * curve.y));
        }
    }
}
