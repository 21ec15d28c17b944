//! A chandelier of twelve arms.

use super::MILLIMETRE;
use super::candle::candle_cup;
use super::curve::{smooth_line, smooth_profile};
use crate::DistanceSolid;
use glam::DVec3;

/// Arms.
const ARMS: u32 = 12;

/// Distance from the axis and height of the joint between an arm and its pan, mm.
const END: (f64, f64) = (150.0, 134.0);

/// Twelve arms in a ring about a turned shaft, each with a drip pan and a candle cup: 340 mm across, 230 mm tall, the
/// knob below on the ground. The arms are 14 to 15 mm thick; thinnest are the pans, 11 mm.
pub fn chandelier() -> DistanceSolid {
    let mut body = shaft();
    if let Some(arm) = arm() {
        body = body.smooth_union(arm.ring(ARMS), 6.0);
    }
    body.intersection(DistanceSolid::half_space(DVec3::NEG_Z, 0.0))
        .scaled(MILLIMETRE)
}

/// Knob, bowl that holds the arms, vase and ball, turned on a lathe.
fn shaft() -> DistanceSolid {
    let half = [
        (0.0, -1.0),
        (9.0, 2.0),
        (13.0, 12.0),
        (9.5, 23.0),
        (9.0, 32.0),
        (20.0, 44.0),
        (33.0, 62.0),
        (36.0, 82.0),
        (27.0, 100.0),
        (13.0, 116.0),
        (10.0, 132.0),
        (18.0, 152.0),
        (20.0, 168.0),
        (11.0, 186.0),
        (9.0, 198.0),
        (14.0, 212.0),
        (9.0, 226.0),
        (0.0, 230.0),
    ];
    DistanceSolid::revolved(smooth_profile(&half, 6))
}

/// The arm along x: down from the bowl, out, and up under its pan.
fn arm() -> Option<DistanceSolid> {
    let (x, z) = END;
    let line = [
        (DVec3::new(16.0, 0.0, 84.0), 8.0),
        (DVec3::new(48.0, 0.0, 72.0), 7.5),
        (DVec3::new(82.0, 0.0, 61.0), 7.2),
        (DVec3::new(118.0, 0.0, 67.0), 7.0),
        (DVec3::new(142.0, 0.0, 94.0), 7.0),
        (DVec3::new(x, 0.0, z), 7.0),
    ];
    let arm = DistanceSolid::tube(&smooth_line(&line, 10))?;
    Some(arm.smooth_union(candle_cup().translated(DVec3::new(x, 0.0, z)), 6.0))
}
