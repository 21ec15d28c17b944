//! Drip pan and cup, where an arm ends.

use crate::DistanceSolid;
use glam::DVec3;

/// A pan 40 mm across and 11 mm thick, and on it a cup 38 mm tall, the candle in it; mm, the pan's middle in the origin.
pub(super) fn candle_cup() -> DistanceSolid {
    let pan = DistanceSolid::cylinder(20.0, 5.5, 4.5);
    let cup = DistanceSolid::round_cone(
        DVec3::new(0.0, 0.0, 8.0),
        9.0,
        DVec3::new(0.0, 0.0, 26.0),
        11.5,
    );
    pan.smooth_union(cup, 5.0)
}
