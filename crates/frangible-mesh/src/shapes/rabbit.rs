//! A sitting rabbit.

use super::MILLIMETRE;
use crate::DistanceSolid;
use crate::distance::first_hit;
use glam::{DQuat, DVec3};

/// A solid sitting rabbit, 148 mm tall with its ears, 84 mm wide and 132 mm long (y). Thinnest are the ears, 10
/// mm.
pub fn rabbit() -> DistanceSolid {
    let belly = DistanceSolid::ellipsoid(DVec3::ZERO, DVec3::new(35.0, 44.0, 37.0))
        .rotated(DQuat::from_rotation_x(-0.35))
        .translated(DVec3::new(0.0, 16.0, 42.0));
    let chest =
        DistanceSolid::ellipsoid(DVec3::new(0.0, -14.0, 48.0), DVec3::new(26.0, 26.0, 34.0));
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
        .smooth_union(
            DistanceSolid::sphere(DVec3::new(0.0, 60.0, 23.0), 13.0),
            5.0,
        )
        .smooth_union(ears(), 6.0);
    let nose = DistanceSolid::ellipsoid(DVec3::new(0.0, -56.5, 89.5), DVec3::new(4.0, 3.2, 3.0));
    rabbit = rabbit.smooth_union(nose, 1.5);
    if let Some(at) = first_hit(
        &rabbit,
        DVec3::new(60.0, -42.0, 97.0),
        DVec3::NEG_X,
        100.0,
        1e-3,
    ) {
        rabbit = rabbit.smooth_union(
            DistanceSolid::sphere(at - 1.0 * DVec3::X, 4.2).mirrored_x(),
            0.8,
        );
    }
    rabbit
        .smooth_intersection(DistanceSolid::half_space(DVec3::NEG_Z, 0.0), 3.0)
        .translated(-6.8 * DVec3::Y)
        .scaled(MILLIMETRE)
}

fn haunches() -> DistanceSolid {
    let thigh = DistanceSolid::ellipsoid(DVec3::ZERO, DVec3::new(14.0, 30.0, 27.0))
        .rotated(DQuat::from_rotation_x(0.3))
        .translated(DVec3::new(28.0, 22.0, 33.0));
    let foot = DistanceSolid::round_cone(
        DVec3::new(28.0, 18.0, 9.0),
        10.0,
        DVec3::new(31.0, -14.0, 7.5),
        9.5,
    );
    thigh.smooth_union(foot, 5.0).mirrored_x()
}

fn front_legs() -> DistanceSolid {
    let leg = DistanceSolid::round_cone(
        DVec3::new(14.0, -26.0, 44.0),
        10.0,
        DVec3::new(11.0, -37.0, 10.0),
        7.5,
    );
    let paw = DistanceSolid::ellipsoid(DVec3::new(11.0, -42.0, 6.5), DVec3::new(8.5, 12.0, 7.5));
    leg.smooth_union(paw, 6.0).mirrored_x()
}

/// Leaves laid back, hollowed towards the front.
fn ears() -> DistanceSolid {
    let leaf =
        DistanceSolid::ellipsoid(DVec3::new(0.0, 0.0, 24.0), DVec3::new(6.0, 2.5, 24.0)).grown(4.0);
    let stem = DistanceSolid::round_cone(
        DVec3::new(0.0, 0.0, -8.0),
        6.0,
        DVec3::new(0.0, 0.0, 16.0),
        5.0,
    );
    let dish = DistanceSolid::ellipsoid(DVec3::new(0.0, -10.5, 27.0), DVec3::new(6.0, 6.5, 20.0));
    leaf.smooth_union(stem, 5.0)
        .smooth_subtract(dish, 4.0)
        .rotated(
            DQuat::from_rotation_z(0.45)
                * DQuat::from_rotation_y(0.36)
                * DQuat::from_rotation_x(-0.5),
        )
        .translated(DVec3::new(12.0, -22.0, 105.0))
        .mirrored_x()
}
