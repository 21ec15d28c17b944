//! A coffee mug.

use super::MILLIMETRE;
use super::curve::smooth_line;
use crate::DistanceSolid;
use glam::{DQuat, DVec2, DVec3};
use std::f64::consts::FRAC_PI_2;

/// A mug 95 mm tall and 85 mm across, 116 mm with its handle (y). Its wall is 5 mm, its bottom 7 mm, its handle 9 to
/// 13 mm thick.
pub fn coffee_cup() -> DistanceSolid {
    let rim = DistanceSolid::half_space(DVec3::Z, 95.0);
    let mut cup = beaker(29.2, 10.0, 10.0).smooth_intersection(rim, 2.0);
    if let Some(handle) = handle() {
        cup = cup.smooth_union(handle, 8.0);
    }
    cup.smooth_subtract(beaker(28.15, 13.0, 6.0), 3.0)
        .intersection(DistanceSolid::half_space(DVec3::NEG_Z, 0.0))
        .rotated(DQuat::from_rotation_z(-FRAC_PI_2))
        .translated(16.0 * DVec3::Y)
        .scaled(MILLIMETRE)
}

/// A slightly opening beaker higher than the mug, its bottom edge rounded by `rounding`, by the centre of that rounding.
fn beaker(radius: f64, z: f64, rounding: f64) -> DistanceSolid {
    let top = 120.0;
    let side = DVec2::new(radius + 0.0389 * (top - z), top);
    DistanceSolid::revolved(vec![
        DVec2::new(0.0, z),
        DVec2::new(radius, z),
        side,
        DVec2::new(0.0, top),
    ])
    .grown(rounding)
}

/// Broader than thick, for the fingers: the way between two tubes is filled by their blend.
fn handle() -> Option<DistanceSolid> {
    let line = [
        (DVec3::new(36.0, 2.2, 79.0), 6.6),
        (DVec3::new(50.0, 2.2, 80.5), 5.2),
        (DVec3::new(62.5, 2.2, 74.0), 4.7),
        (DVec3::new(69.0, 2.2, 58.0), 4.7),
        (DVec3::new(65.5, 2.2, 40.0), 4.7),
        (DVec3::new(54.0, 2.2, 27.5), 5.0),
        (DVec3::new(36.0, 2.2, 21.0), 6.6),
    ];
    let half = DistanceSolid::tube(&smooth_line(&line, 20))?;
    let other = half.clone().translated(-4.4 * DVec3::Y);
    Some(half.smooth_union(other, 3.0))
}
