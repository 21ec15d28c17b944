//! Walking along a ray by the distance itself.

use crate::Solid;
use glam::DVec3;

/// First point, within `reach` (m) of `origin` along `direction` (unit), whose distance is below `tolerance` (m): a
/// ball as large as the distance holds no surface, so the walk passes none.
pub fn first_hit(
    solid: &dyn Solid,
    origin: DVec3,
    direction: DVec3,
    reach: f64,
    tolerance: f64,
) -> Option<DVec3> {
    let mut way = 0.0;
    // A ray that grazes a surface slows down; after this many steps it counts as a hit.
    for _ in 0..4096 {
        let p = origin + way * direction;
        let distance = solid.signed_distance(p);
        if distance < tolerance {
            return Some(p);
        }
        way += distance;
        if way > reach || way.is_nan() {
            return None;
        }
    }
    Some(origin + way * direction)
}
