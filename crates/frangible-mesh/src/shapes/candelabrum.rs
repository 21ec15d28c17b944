//! A candelabrum of five lights.

use super::MILLIMETRE;
use super::candle::candle_cup;
use super::curve::{smooth_line, smooth_profile};
use crate::DistanceSolid;
use glam::DVec3;

/// A turned foot and stem with a cup on top, and two arms to each side in one plane: 300 mm wide, 330 mm tall. Thinnest are the
/// pans, 11 mm, and the arms, 12 mm.
pub fn candelabrum() -> DistanceSolid {
    let mut body = stem().smooth_union(candle_cup().translated(293.0 * DVec3::Z), 6.0);
    for (reach, low, high) in [(75.0, 178.0, 268.0), (131.0, 120.0, 243.0)] {
        if let Some(arms) = arms(reach, low, high) {
            body = body.smooth_union(arms, 8.0);
        }
    }
    body.intersection(DistanceSolid::half_space(DVec3::NEG_Z, 0.0))
        .scaled(MILLIMETRE)
}

fn stem() -> DistanceSolid {
    let half = [
        (0.0, -3.0),
        (26.0, -3.0),
        (50.0, -3.0),
        (59.5, 0.5),
        (61.0, 7.0),
        (54.0, 13.0),
        (34.0, 19.0),
        (17.0, 32.0),
        (11.0, 52.0),
        (15.0, 76.0),
        (18.0, 96.0),
        (13.0, 120.0),
        (10.0, 148.0),
        (13.0, 172.0),
        (14.0, 186.0),
        (9.0, 212.0),
        (7.5, 260.0),
        (7.0, 292.0),
        (0.0, 293.0),
    ];
    DistanceSolid::revolved(smooth_profile(&half, 6))
}

/// A pair of arms that leave the stem at height `low`, sag, and rise to their pans `reach` away at height `high`.
fn arms(reach: f64, low: f64, high: f64) -> Option<DistanceSolid> {
    let at = |share: f64, z: f64| DVec3::new(share * reach, 0.0, z);
    let line = [
        (at(0.0, low), 7.5),
        (at(0.3, low - 6.0), 6.8),
        (at(0.72, low + 8.0), 6.4),
        (at(0.97, low + 0.5 * (high - low)), 6.1),
        (at(1.0, high), 6.0),
    ];
    let arm = DistanceSolid::tube(&smooth_line(&line, 10))?;
    Some(
        arm.smooth_union(candle_cup().translated(at(1.0, high)), 6.0)
            .mirrored_x(),
    )
}
