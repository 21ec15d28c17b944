//! A sitting rabbit.

use super::MILLIMETRE;
use super::curve::smooth_line;
use crate::distance::first_hit;
use crate::DistanceSolid;
use glam::{DQuat, DVec3};

/// A solid sitting rabbit, 150 mm tall with its ears, about 80 mm wide and 125 mm long. Thinnest are the ears, 9 mm.
pub fn rabbit() -> DistanceSolid {
    let belly = DistanceSolid::ellipsoid(DVec3::ZERO, DVec3::new(35.0, 44.0, 37.0))
        .rotated(DQuat::from_rotation_x(-0.35))
        .translated(DVec3::new(0.0, 16.0, 42.0));
    let chest = DistanceSolid::ellipsoid(DVec3::new(0.0, -14.0, 48.0), DVec3::new(26.0, 26.0, 34.0));
    let head = DistanceSolid::ellipsoid(DVec3::ZERO, DVec3::new(20.0, 25.0, 20.0))
        .rotated(DQuat::from_rotation_x(0.25))
        .translated(DVec3::new(0.0, -32.0, 92.0));
    let cheeks = DistanceSolid::sphere(DVec3::new(7.0, -48.0, 84.0), 9.0).mirrored_x();
    let mut rabbit = belly
        .smooth_union(chest, 22.0)
        .smooth_union(head, 16.0)
        .smooth_union(cheeks, 9.0)
        .smooth_union(haunches(), 7.0)
        .smooth_union(front_legs(), 6.0)
        .smooth_union(DistanceSolid::sphere(DVec3::new(0.0, 62.0, 24.0), 13.0), 5.0);
    if let Some(ears) = ears() {
        rabbit = rabbit.smooth_union(ears, 6.0);
    }
    rabbit = rabbit.smooth_intersection(DistanceSolid::half_space(DVec3::NEG_Z, 0.0), 3.0);
    let nose = DistanceSolid::ellipsoid(DVec3::new(0.0, -56.5, 89.5), DVec3::new(4.0, 3.2, 3.0));
    rabbit = rabbit.smooth_union(nose, 1.5);
    if let Some(at) = first_hit(&rabbit, DVec3::new(60.0, -42.0, 97.0), DVec3::NEG_X, 100.0, 1e-3) {
        rabbit = rabbit.smooth_union(DistanceSolid::sphere(at - 1.0 * DVec3::X, 4.2).mirrored_x(), 0.8);
    }
    rabbit.scaled(MILLIMETRE)
}

fn haunches() -> DistanceSolid {
    let thigh = DistanceSolid::ellipsoid(DVec3::ZERO, DVec3::new(14.0, 30.0, 27.0))
        .rotated(DQuat::from_rotation_x(0.3))
        .translated(DVec3::new(28.0, 22.0, 33.0));
    let foot = DistanceSolid::round_cone(DVec3::new(29.0, 20.0, 8.0), 9.0, DVec3::new(31.0, -22.0, 6.5), 8.5);
    thigh.smooth_union(foot, 5.0).mirrored_x()
}

fn front_legs() -> DistanceSolid {
    let leg = DistanceSolid::round_cone(DVec3::new(14.0, -26.0, 44.0), 10.0, DVec3::new(11.0, -37.0, 10.0), 7.5);
    let paw = DistanceSolid::ellipsoid(DVec3::new(11.0, -42.0, 6.5), DVec3::new(8.5, 12.0, 7.5));
    leg.smooth_union(paw, 6.0).mirrored_x()
}

/// Leaves laid back: tapering tubes cut to slabs, hollowed outwards.
fn ears() -> Option<DistanceSolid> {
    let line = [
        (DVec3::new(0.0, 0.0, -8.0), 5.0),
        (DVec3::new(0.0, 0.0, 8.0), 8.0),
        (DVec3::new(0.0, 0.0, 26.0), 10.0),
        (DVec3::new(0.0, 0.0, 42.0), 8.0),
        (DVec3::new(0.0, 0.0, 52.0), 5.0),
    ];
    let leaf = DistanceSolid::tube(&smooth_line(&line, 5))?;
    let slab = DistanceSolid::rounded_box(DVec3::new(40.0, 5.5, 80.0), 0.0);
    let dish = DistanceSolid::ellipsoid(DVec3::new(0.0, -10.5, 28.0), DVec3::new(7.0, 8.0, 22.0));
    let ear = leaf
        .smooth_intersection(slab, 4.0)
        .smooth_subtract(dish, 3.0)
        .rotated(DQuat::from_rotation_z(0.5) * DQuat::from_rotation_y(0.2) * DQuat::from_rotation_x(-0.5))
        .translated(DVec3::new(9.0, -22.0, 106.0));
    Some(ear.mirrored_x())
}
