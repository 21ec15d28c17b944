//! Closed surfaces: thin, sharp, pierced, slender, far away.

use frangible_mesh::Surface;
use frangible_mesh::glam::DVec3;

use super::shapes::{
    cuboid, joined, moved, revolve, revolved_volume, sphere, sphere_volume, turned,
};
use super::{HardCase, closed};

pub(crate) fn all() -> Vec<HardCase> {
    vec![
        wine_glass(),
        thin_plate(),
        hollow_ball(),
        cube(),
        needle_pyramid(),
        star_prism(),
        lattice(),
        sliver_cylinder(),
        near_tangent_balls(),
        touching_balls(),
        inside_out_ball(),
        far_ball(),
    ]
}

/// Wall of 1.5 mm, a foot of 70 mm, a stem of 8 mm.
pub(crate) fn wine_glass() -> HardCase {
    let wall = 0.0015;
    let bowl = |offset: f64, i: usize| {
        let angle = std::f64::consts::FRAC_PI_2 * i as f64 / 16.0 * 1.25;
        let radius = 0.04 + offset;
        [radius * angle.sin(), 0.135 - 1.2 * radius * angle.cos()]
    };
    let mut profile = vec![
        [0.0, 0.0],
        [0.035, 0.0],
        [0.035, 0.0015],
        [0.006, 0.005],
        [0.004, 0.02],
        [0.004, 0.08],
    ];
    profile.extend((3..=16).map(|i| bowl(0.0, i)));
    profile.extend((1..=16).rev().map(|i| bowl(-wall, i)));
    profile.push([0.0, 0.135 - 1.2 * (0.04 - wall)]);
    let surface = revolve(&profile, 64);
    closed("wine glass", surface, revolved_volume(&profile, 64))
}

pub(crate) fn thin_plate() -> HardCase {
    let surface = cuboid(DVec3::ZERO, DVec3::new(1.0, 1.0, 1e-3));
    closed("thin plate", surface, 1e-3)
}

/// A ball of 50 mm with a wall of 1.5 mm.
pub(crate) fn hollow_ball() -> HardCase {
    let (outer, inner, n) = (0.05, 0.0485, 40);
    let surface = joined(
        sphere(DVec3::ZERO, outer, n),
        turned(sphere(DVec3::ZERO, inner, n)),
    );
    let volume = sphere_volume(outer, n) - sphere_volume(inner, n);
    closed("hollow ball", surface, volume)
}

pub(crate) fn cube() -> HardCase {
    closed("cube", cuboid(DVec3::ZERO, DVec3::ONE), 1.0)
}

/// Four triangles that meet at 0.6°.
pub(crate) fn needle_pyramid() -> HardCase {
    let (half, height) = (0.005, 1.0);
    let base = [[-half, -half], [half, -half], [half, half], [-half, half]];
    let mut positions: Vec<DVec3> = base.map(|[x, y]| DVec3::new(x, y, 0.0)).to_vec();
    positions.push(DVec3::new(0.0, 0.0, height));
    let sides = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
    let triangles = [[[0, 2, 1], [0, 3, 2]].as_slice(), &sides].concat();
    let surface = Surface {
        positions,
        triangles,
    };
    closed("needle pyramid", surface, 4.0 * half * half * height / 3.0)
}

/// Nine sharp points around, reflex edges between.
pub(crate) fn star_prism() -> HardCase {
    let (points, long, short, height) = (9, 1.0, 0.3, 0.5);
    let m = 2 * points;
    let turn = std::f64::consts::TAU / m as f64;
    let mut surface = Surface::default();
    for z in [0.0, height] {
        surface.positions.push(DVec3::new(0.0, 0.0, z));
        for j in 0..m {
            let (r, angle) = (if j % 2 == 0 { long } else { short }, turn * j as f64);
            let place = DVec3::new(r * angle.cos(), r * angle.sin(), z);
            surface.positions.push(place);
        }
    }
    let top = m as u32 + 1;
    for j in 0..m as u32 {
        let (a, b) = (1 + j, 1 + (j + 1) % m as u32);
        surface.triangles.extend([
            [0, b, a],
            [top, top + a, top + b],
            [a, b, top + b],
            [a, top + b, top + a],
        ]);
    }
    let volume = points as f64 * long * short * turn.sin() * height;
    closed("star prism", surface, volume)
}

/// Struts along the edges of 3 × 3 × 3 cells, 81 handles, each strut square.
pub(crate) fn lattice() -> HardCase {
    const N: i32 = 10;
    let size = 0.1;
    let filled = |cell: [i32; 3]| {
        cell.iter().all(|&i| (0..N).contains(&i))
            && cell.iter().filter(|&&i| i % 3 == 0).count() > 1
    };
    let mut surface = Surface::default();
    let mut cells = 0;
    for index in 0..N.pow(3) {
        let cell = [index / N / N, index / N % N, index % N];
        if !filled(cell) {
            continue;
        }
        cells += 1;
        for axis in 0..3 {
            for side in [0, 1] {
                let mut beyond = cell;
                beyond[axis] += 2 * side - 1;
                if filled(beyond) {
                    continue;
                }
                let first = surface.positions.len() as u32;
                for [i, j] in [[0, 0], [1, 0], [1, 1], [0, 1]] {
                    let mut corner = cell;
                    corner[axis] += side;
                    corner[(axis + 1) % 3] += if side == 1 { i } else { j };
                    corner[(axis + 2) % 3] += if side == 1 { j } else { i };
                    let place = DVec3::from_array(corner.map(f64::from)) * size;
                    surface.positions.push(place);
                }
                let quad = [[0, 1, 2], [0, 2, 3]].map(|t| t.map(|v| v + first));
                surface.triangles.extend(quad);
            }
        }
    }
    closed("lattice", surface, f64::from(cells) * size.powi(3))
}

/// Sides ten thousand times longer than wide.
pub(crate) fn sliver_cylinder() -> HardCase {
    let n = 240;
    let profile = [[0.0, 0.0], [1.0, 0.0], [1.0, 260.0], [0.0, 260.0]];
    closed(
        "sliver cylinder",
        revolve(&profile, n),
        revolved_volume(&profile, n),
    )
}

/// A gap of 0.1 mm between balls of 1 m.
pub(crate) fn near_tangent_balls() -> HardCase {
    let surface = joined(
        sphere(DVec3::ZERO, 1.0, 24),
        sphere(2.0001 * DVec3::Z, 1.0, 24),
    );
    closed("near-tangent balls", surface, 2.0 * sphere_volume(1.0, 24))
}

pub(crate) fn touching_balls() -> HardCase {
    let surface = joined(
        sphere(DVec3::ZERO, 1.0, 24),
        sphere(2.0 * DVec3::Z, 1.0, 24),
    );
    closed("touching balls", surface, 2.0 * sphere_volume(1.0, 24))
}

pub(crate) fn inside_out_ball() -> HardCase {
    let surface = turned(sphere(DVec3::ZERO, 1.0, 24));
    closed("inside-out ball", surface, sphere_volume(1.0, 24))
}

/// A hundred thousand times its size from the origin.
pub(crate) fn far_ball() -> HardCase {
    let surface = moved(sphere(DVec3::ZERO, 1.0, 24), DVec3::new(2e5, -1e5, 5e4));
    closed("far ball", surface, sphere_volume(1.0, 24))
}
