//! Surfaces that overlap, nest or cross themselves.

use std::f64::consts::{PI, TAU};

use frangible_mesh::Surface;
use frangible_mesh::glam::DVec3;

use super::shapes::{cuboid, joined, moved, revolve, revolved_volume, sphere, sphere_volume};
use super::{HardCase, leaky};

pub(crate) fn all() -> Vec<HardCase> {
    vec![
        overlapping_boxes(),
        crossing_tube(),
        ball_twice(),
        nested_balls(),
        box_with_a_pin(),
    ]
}

pub(crate) fn overlapping_boxes() -> HardCase {
    let one = cuboid(DVec3::ZERO, DVec3::ONE);
    let other = cuboid(DVec3::splat(0.5), DVec3::new(1.5, 1.6, 1.7));
    leaky(
        "overlapping boxes",
        joined(one, other),
        1.0 + 1.0 * 1.1 * 1.2 - 0.125,
    )
}

/// A round tube along a figure of eight that runs through itself at a right angle.
pub(crate) fn crossing_tube() -> HardCase {
    let (radius, along, around) = (0.12, 240, 40);
    let path = |i: usize| {
        let t = TAU * i as f64 / along as f64;
        DVec3::new(t.cos(), t.sin() * t.cos(), 0.0)
    };
    let mut surface = Surface::default();
    let mut length = 0.0;
    for i in 0..along {
        let t = TAU * i as f64 / along as f64;
        let forwards = DVec3::new(-t.sin(), (2.0 * t).cos(), 0.0).normalize();
        let side = forwards.cross(DVec3::Z);
        for j in 0..around {
            let angle = TAU * j as f64 / around as f64;
            let offset = radius * (angle.cos() * side + angle.sin() * DVec3::Z);
            surface.positions.push(path(i) + offset);
        }
        length += path(i).distance(path(i + 1));
    }
    for i in 0..along {
        for j in 0..around {
            let at = |i: usize, j: usize| ((i % along) * around + j % around) as u32;
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            surface.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    // Pappus, less what two crossing cylinders share.
    let volume = PI * radius * radius * length - 16.0 / 3.0 * radius.powi(3);
    leaky("crossing tube", surface, volume)
}

/// Winding number 2 inside.
pub(crate) fn ball_twice() -> HardCase {
    let ball = || sphere(DVec3::ZERO, 1.0, 24);
    leaky("ball twice", joined(ball(), ball()), sphere_volume(1.0, 24))
}

/// The inner ball is no cavity, for it is turned like the outer one.
pub(crate) fn nested_balls() -> HardCase {
    let surface = joined(
        sphere(DVec3::ZERO, 1.0, 24),
        sphere(DVec3::new(0.2, 0.0, 0.0), 0.5, 24),
    );
    leaky("nested balls", surface, sphere_volume(1.0, 24))
}

/// A pin of 1 mm on a box of 1 m.
pub(crate) fn box_with_a_pin() -> HardCase {
    let profile = [[0.0, -0.01], [5e-4, -0.01], [5e-4, 0.02], [0.0, 0.02]];
    let pin = moved(revolve(&profile, 24), DVec3::new(0.3, 0.4, 1.0));
    let surface = joined(cuboid(DVec3::ZERO, DVec3::ONE), pin);
    let volume = 1.0 + revolved_volume(&profile, 24) * 2.0 / 3.0;
    leaky("box with a pin", surface, volume)
}
