//! A coffee mug.

use super::MILLIMETRE;
use super::curve::{smooth_line, smooth_profile};
use crate::DistanceSolid;
use glam::{DVec2, DVec3};

const WALL: f64 = 5.0;

/// A mug 95 mm tall and 85 mm across, handle aside (it reaches to x = 74 mm). Its wall is 5 mm, its bottom 7 mm, its
/// handle 9 to 13 mm thick.
pub fn coffee_cup() -> DistanceSolid {
    let side = [
        (31.0, 0.0),
        (34.5, 0.6),
        (37.0, 4.0),
        (39.2, 16.0),
        (40.4, 34.0),
        (41.1, 60.0),
        (42.3, 88.0),
    ];
    let mut outside = vec![DVec2::ZERO];
    outside.extend(smooth_profile(&side, 6));
    outside.extend([DVec2::new(42.5, 94.9), DVec2::new(0.0, 94.9)]);
    let outside = DistanceSolid::revolved(outside);
    let inside = outside
        .clone()
        .grown(-WALL)
        .intersection(DistanceSolid::half_space(DVec3::NEG_Z, -7.0))
        .union(DistanceSolid::cone(37.25, 37.6, 30.0).translated(85.0 * DVec3::Z));
    let mut cup = outside;
    if let Some(handle) = handle() {
        cup = cup.smooth_union(handle, 8.0);
    }
    cup.smooth_subtract(inside, 3.0).scaled(MILLIMETRE)
}

/// Broader than thick, for the fingers: the way between two tubes is filled by their blend.
fn handle() -> Option<DistanceSolid> {
    let line = [
        (DVec3::new(36.0, 2.2, 79.0), 6.6),
        (DVec3::new(50.0, 2.2, 80.5), 5.2),
        (DVec3::new(62.5, 2.2, 74.0), 4.7),
        (DVec3::new(68.3, 2.2, 58.0), 4.7),
        (DVec3::new(64.5, 2.2, 40.0), 4.7),
        (DVec3::new(53.5, 2.2, 27.5), 5.0),
        (DVec3::new(36.0, 2.2, 21.0), 6.6),
    ];
    let half = DistanceSolid::tube(&smooth_line(&line, 8))?;
    let other = half.clone().translated(-4.4 * DVec3::Y);
    Some(half.smooth_union(other, 3.0))
}
