//! A claw hammer's head.

use super::MILLIMETRE;
use super::curve::smooth_profile;
use crate::DistanceSolid;
use glam::{DQuat, DVec2, DVec3};
use std::f64::consts::{FRAC_PI_2, TAU};

/// The head of a claw hammer, 122 mm long (y, from the face to the claws' tips), with an eye of 14 × 22 mm for the
/// handle. It lies as held: face and eye upright, the claws curving down. The claws thin out to 4 mm.
pub fn hammer_head() -> DistanceSolid {
    let face = DistanceSolid::cylinder(14.5, 8.0, 2.0)
        .rotated(DQuat::from_rotation_x(FRAC_PI_2))
        .translated(DVec3::new(0.0, -46.0, 0.0));
    let neck = DistanceSolid::round_cone(DVec3::new(0.0, -46.0, 0.0), 9.5, DVec3::new(0.0, -10.0, 0.0), 11.0);
    let cheek = DistanceSolid::rounded_box(DVec3::new(13.5, 17.0, 15.0), 4.0);
    let eye = DistanceSolid::rounded_box(DVec3::new(7.0, 11.0, 40.0), 5.0);
    face.smooth_union(neck, 5.0)
        .smooth_union(cheek, 6.0)
        .smooth_union(claws(), 6.0)
        .smooth_subtract(eye, 2.0)
        .translated(DVec3::new(0.0, -4.0, 31.0))
        .scaled(MILLIMETRE)
}

fn claws() -> DistanceSolid {
    let mut side = smooth_profile(&[(6.0, 12.0), (24.0, 12.0), (44.0, 4.0), (60.0, -11.0), (68.0, -27.0)], 5);
    side.extend(smooth_profile(&[(66.5, -28.5), (55.0, -14.0), (40.0, -5.0), (24.0, -8.0), (6.0, -11.0)], 5));
    // Drawn in y and z, as a prism in x and y.
    let wedge = DistanceSolid::prism(side, 12.0).grown(1.5);
    let notch = [(0.0, 22.0), (1.2, 27.0), (6.0, 80.0), (-6.0, 80.0), (-1.2, 27.0)];
    let notch = DistanceSolid::prism(notch.iter().map(|&(x, y)| DVec2::new(x, y)).collect(), 60.0);
    wedge
        .rotated(DQuat::from_axis_angle(DVec3::ONE.normalize(), TAU / 3.0))
        .smooth_subtract(notch, 3.0)
}
