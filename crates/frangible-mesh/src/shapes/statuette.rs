//! A ballet dancer.

use super::MILLIMETRE;
use super::curve::smooth_line;
use crate::DistanceSolid;
use glam::{DQuat, DVec2, DVec3};

/// A dancer on one leg on a round plinth of 84 mm, 250 mm tall: the foot of the other leg at the knee, arms in a ring
/// above her head, so that she has two holes. Thinnest are the tutu, 6 mm, and the ankle, neck and wrists, 10 to 11
/// mm.
pub fn statuette() -> DistanceSolid {
    let mut body = figure();
    for limb in [arms(), legs()].into_iter().flatten() {
        body = body.smooth_union(limb, 5.0);
    }
    plinth()
        .smooth_union(body, 4.0)
        .intersection(DistanceSolid::half_space(DVec3::NEG_Z, 0.0))
        .scaled(MILLIMETRE)
}

fn plinth() -> DistanceSolid {
    let profile = [
        (0.0, 1.5),
        (38.5, 1.5),
        (40.5, 2.5),
        (40.5, 8.0),
        (37.0, 10.0),
        (35.5, 12.5),
        (36.0, 15.0),
        (35.0, 17.5),
        (32.0, 18.5),
        (0.0, 18.5),
    ];
    DistanceSolid::revolved(profile.iter().map(|&(r, z)| DVec2::new(r, z)).collect()).grown(1.5)
}

fn figure() -> DistanceSolid {
    let hips = DistanceSolid::ellipsoid(DVec3::new(0.0, 1.0, 136.0), DVec3::new(15.0, 12.0, 14.0));
    let waist = DistanceSolid::round_cone(
        DVec3::new(0.0, 0.0, 140.0),
        10.5,
        DVec3::new(0.0, 0.0, 156.0),
        9.5,
    );
    let chest =
        DistanceSolid::ellipsoid(DVec3::new(0.0, -0.5, 171.0), DVec3::new(15.5, 10.5, 16.0));
    let neck = DistanceSolid::capsule(
        DVec3::new(0.0, 1.0, 180.0),
        DVec3::new(0.0, 0.0, 200.0),
        5.3,
    );
    let head = DistanceSolid::ellipsoid(DVec3::new(0.0, -1.0, 209.5), DVec3::new(10.0, 11.5, 13.0));
    let bun = DistanceSolid::sphere(DVec3::new(0.0, 9.0, 219.0), 6.5);
    let head = head.smooth_union(bun, 2.0);
    let bust = waist.smooth_union(chest, 12.0);
    let lower = hips.smooth_union(tutu(), 5.0);
    lower.smooth_union(bust.smooth_union(neck.smooth_union(head, 4.0), 7.0), 8.0)
}

/// A dish with folds: ribs that reach past its rim.
fn tutu() -> DistanceSolid {
    let profile = [
        (0.0, 5.0),
        (20.0, 3.0),
        (47.0, -4.0),
        (48.0, -3.0),
        (22.0, 5.0),
        (0.0, 9.0),
    ];
    let folds = DistanceSolid::round_cone(
        DVec3::new(22.0, 0.0, 3.6),
        2.6,
        DVec3::new(49.5, 0.0, -3.7),
        3.7,
    )
    .ring(26);
    DistanceSolid::revolved(profile.iter().map(|&(r, z)| DVec2::new(r, z)).collect())
        .grown(2.4)
        .smooth_union(folds, 2.0)
        .rotated(DQuat::from_rotation_x(-0.12))
        .translated(138.0 * DVec3::Z)
}

fn legs() -> Option<DistanceSolid> {
    Some(standing_leg()?.smooth_union(raised_leg()?, 5.0))
}

fn standing_leg() -> Option<DistanceSolid> {
    let line = [
        (DVec3::new(0.0, -1.0, 18.0), 6.0),
        (DVec3::new(0.0, -2.0, 24.0), 6.2),
        (DVec3::new(0.0, 0.0, 34.0), 5.4),
        (DVec3::new(0.0, 3.0, 58.0), 7.6),
        (DVec3::new(-0.5, 0.0, 78.0), 6.8),
        (DVec3::new(-2.0, -1.0, 104.0), 8.8),
        (DVec3::new(-5.0, 0.0, 132.0), 10.5),
    ];
    DistanceSolid::tube(&smooth_line(&line, 12))
}

fn raised_leg() -> Option<DistanceSolid> {
    let line = [
        (DVec3::new(6.0, 0.0, 132.0), 10.0),
        (DVec3::new(24.0, -10.0, 117.0), 8.6),
        (DVec3::new(42.0, -17.0, 103.0), 6.8),
        (DVec3::new(30.0, -12.0, 92.0), 7.2),
        (DVec3::new(14.0, -7.0, 82.0), 5.4),
        (DVec3::new(3.0, -4.0, 73.0), 5.0),
    ];
    DistanceSolid::tube(&smooth_line(&line, 12))
}

fn arms() -> Option<DistanceSolid> {
    let line = [
        (DVec3::new(0.0, -9.0, 245.0), 5.0),
        (DVec3::new(12.0, -9.0, 243.5), 5.0),
        (DVec3::new(27.0, -7.0, 232.0), 5.1),
        (DVec3::new(33.0, -4.0, 212.0), 5.6),
        (DVec3::new(27.0, -1.0, 194.0), 5.8),
        (DVec3::new(14.0, 0.0, 180.0), 6.2),
    ];
    Some(DistanceSolid::tube(&smooth_line(&line, 12))?.mirrored_x())
}
