//! A claw hammer's head.

use super::MILLIMETRE;
use super::curve::smooth_profile;
use crate::DistanceSolid;
use glam::{DQuat, DVec2, DVec3};
use std::f64::consts::{FRAC_PI_2, TAU};

/// The head of a claw hammer, 124 mm long (y, from the face to the claws' tips), with an eye of 14 × 22 mm for the
/// handle. It lies as held: face and eye upright, the claws curving down. The claws thin out to 5 mm.
pub fn hammer_head() -> DistanceSolid {
    let face = DistanceSolid::cylinder(14.5, 8.0, 2.0)
        .rotated(DQuat::from_rotation_x(FRAC_PI_2))
        .translated(DVec3::new(0.0, -45.0, 0.0));
    let neck = DistanceSolid::round_cone(
        DVec3::new(0.0, -45.0, 0.0),
        9.5,
        DVec3::new(0.0, -10.0, 0.0),
        11.0,
    );
    let cheek = DistanceSolid::rounded_box(DVec3::new(14.0, 18.0, 15.5), 4.0);
    let eye = DistanceSolid::rounded_box(DVec3::new(7.0, 11.0, 40.0), 5.0);
    face.smooth_union(neck, 5.0)
        .smooth_union(cheek, 6.0)
        .smooth_union(claws(), 4.0)
        .smooth_subtract(eye, 2.0)
        .translated(DVec3::new(0.0, -7.0, 30.0))
        .intersection(DistanceSolid::half_space(DVec3::NEG_Z, 0.0))
        .scaled(MILLIMETRE)
}

fn claws() -> DistanceSolid {
    let mut side = smooth_profile(
        &[
            (4.0, 11.5),
            (22.0, 11.5),
            (44.0, 4.0),
            (60.0, -11.0),
            (68.0, -27.0),
        ],
        8,
    );
    side.extend(smooth_profile(
        &[
            (66.5, -28.5),
            (55.0, -14.0),
            (40.0, -5.0),
            (22.0, -8.5),
            (4.0, -11.0),
        ],
        8,
    ));
    // Drawn in y and z, as a prism in x and y.
    let wedge = DistanceSolid::prism(side, 10.5).grown(1.5);
    let notch = [
        (0.0, 22.0),
        (1.2, 27.0),
        (6.0, 80.0),
        (-6.0, 80.0),
        (-1.2, 27.0),
    ];
    let notch = DistanceSolid::prism(notch.iter().map(|&(x, y)| DVec2::new(x, y)).collect(), 60.0);
    wedge
        .rotated(DQuat::from_axis_angle(DVec3::ONE.normalize(), TAU / 3.0))
        .smooth_subtract(notch, 3.0)
}
