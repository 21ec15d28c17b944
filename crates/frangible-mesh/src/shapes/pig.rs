//! A piggy bank.

use super::MILLIMETRE;
use super::curve::smooth_line;
use crate::DistanceSolid;
use crate::distance::first_hit;
use glam::{DQuat, DVec3};
use std::f64::consts::TAU;

const WALL: f64 = 7.0;

/// A piggy bank 151 mm long (y, from snout to tail), 92 mm wide and 116 mm tall with its ears. It is hollow with a
/// wall of 7 mm (6 mm at the rounded rims of the slot); a slot of 35 × 4 mm leads through its back into the
/// cavity. Snout, ears, legs and tail are solid; the thinnest of them is the tail, 6.8 mm at its tip.
pub fn piggy_bank() -> DistanceSolid {
    let egg = DistanceSolid::ellipsoid(DVec3::new(0.0, 8.0, 56.0), DVec3::new(46.0, 54.0, 44.0));
    let head = DistanceSolid::ellipsoid(DVec3::new(0.0, -34.0, 65.0), DVec3::new(35.0, 31.0, 34.0));
    let hull = egg.smooth_union(head, 22.0);
    let cavity = hull.clone().grown(-WALL);
    let slot = DistanceSolid::rounded_box(DVec3::new(2.0, 17.5, 30.0), 1.5)
        .translated(DVec3::new(0.0, 10.0, 110.0));

    let snout = DistanceSolid::cylinder(16.0, 14.0, 4.0)
        .rotated(DQuat::from_rotation_x(0.25 * TAU))
        .translated(DVec3::new(0.0, -62.0, 61.0));
    let mut pig = hull
        .clone()
        .smooth_union(snout, 7.0)
        .smooth_union(legs(), 12.0)
        .smooth_union(ears(), 5.0);
    if let Some(tail) = tail() {
        pig = pig.smooth_union(tail, 5.0);
    }
    let from = DVec3::new(21.0, -110.0, 81.0);
    if let Some(at) = first_hit(
        &hull,
        from,
        DVec3::new(-0.05, 1.0, 0.0).normalize(),
        200.0,
        1e-3,
    ) {
        pig = pig.smooth_union(DistanceSolid::sphere(at, 4.6).mirrored_x(), 1.0);
    }
    let nostril = DistanceSolid::ellipsoid(DVec3::new(5.6, -76.6, 62.0), DVec3::new(2.6, 3.4, 4.2))
        .mirrored_x();
    pig.smooth_subtract(nostril, 1.5)
        .smooth_subtract(cavity, 0.0)
        .smooth_subtract(slot, 2.0)
        .smooth_intersection(DistanceSolid::half_space(DVec3::NEG_Z, 0.0), 3.0)
        .scaled(MILLIMETRE)
}

fn legs() -> DistanceSolid {
    let leg = |y: f64, lean: f64| {
        DistanceSolid::round_cone(
            DVec3::new(23.0, y, 36.0),
            17.0,
            DVec3::new(26.0, y + lean, 8.0),
            12.5,
        )
    };
    leg(-27.0, -3.0).union(leg(36.0, 3.0)).mirrored_x()
}

/// A leaf: a tapered ball cut to a slab, hollowed in front.
fn ears() -> DistanceSolid {
    let leaf = DistanceSolid::round_cone(DVec3::ZERO, 14.0, DVec3::new(0.0, 0.0, 26.0), 4.0);
    let slab = DistanceSolid::rounded_box(DVec3::new(40.0, 4.6, 60.0), 0.0);
    let dish = DistanceSolid::ellipsoid(DVec3::new(0.0, -10.5, 9.0), DVec3::new(8.5, 8.0, 14.0));
    leaf.smooth_intersection(slab, 4.0)
        .smooth_subtract(dish, 3.0)
        .rotated(
            DQuat::from_rotation_z(0.35)
                * DQuat::from_rotation_y(0.55)
                * DQuat::from_rotation_x(0.3),
        )
        .translated(DVec3::new(21.0, -29.0, 91.0))
        .mirrored_x()
}

/// One turn and a bit, backwards.
fn tail() -> Option<DistanceSolid> {
    let knots: Vec<(DVec3, f64)> = (0..=14)
        .map(|i| {
            let t = f64::from(i) / 14.0;
            let turn = 1.3 * TAU * t;
            let loop_radius = 7.5 * (3.0 * t).min(1.0);
            let at = DVec3::new(
                loop_radius * turn.sin(),
                56.5 + 15.0 * t,
                67.0 + loop_radius * (1.0 - turn.cos()),
            );
            (at, 3.9 - 0.5 * t)
        })
        .collect();
    DistanceSolid::tube(&smooth_line(&knots, 3))
}
