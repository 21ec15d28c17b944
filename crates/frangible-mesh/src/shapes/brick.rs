//! A facing brick.

use super::MILLIMETRE;
use crate::DistanceSolid;
use glam::DVec3;

/// A brick of 210 × 100 × 50 mm (x, y, z) with edges rounded by 2 mm and three holes of 32 mm through its height, 60
/// mm apart. Thinnest between two holes: 28 mm; between a hole and an end: 29 mm.
pub fn brick_solid() -> DistanceSolid {
    let mut brick = DistanceSolid::rounded_box(DVec3::new(105.0, 50.0, 25.0), 2.0);
    for x in [-60.0, 0.0, 60.0] {
        let hole = DistanceSolid::cylinder(16.0, 40.0, 0.0).translated(DVec3::new(x, 0.0, 0.0));
        brick = brick.smooth_subtract(hole, 5.0);
    }
    brick.translated(25.0 * DVec3::Z).scaled(MILLIMETRE)
}
