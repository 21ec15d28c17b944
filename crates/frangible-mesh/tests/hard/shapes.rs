//! Parts that cases are made of.

use std::f64::consts::{PI, TAU};

use frangible_mesh::Surface;
use frangible_mesh::glam::DVec3;

/// Radius and height of a profile's points, m.
pub(crate) type Profile = Vec<[f64; 2]>;

/// The profile turned around z in `n` steps; going up on the outside. Rings on the axis are fans, so their triangles
/// without area are left out.
pub(crate) fn revolve(profile: &[[f64; 2]], n: usize) -> Surface {
    let mut surface = Surface::default();
    let mut rings = Vec::new();
    for &[r, z] in profile {
        let first = surface.positions.len();
        let count = if r == 0.0 { 1 } else { n };
        for j in 0..count {
            let angle = TAU * j as f64 / n as f64;
            let place = DVec3::new(r * angle.cos(), r * angle.sin(), z);
            surface.positions.push(place);
        }
        rings.push((first, count));
    }
    for pair in rings.windows(2) {
        let [(low, low_count), (high, high_count)] = [pair[0], pair[1]];
        for j in 0..n {
            let at = |first: usize, count: usize, j: usize| (first + j % count) as u32;
            let [a, b] = [j, j + 1].map(|j| at(low, low_count, j));
            let [c, d] = [j, j + 1].map(|j| at(high, high_count, j));
            if a != b {
                surface.triangles.push([a, b, d]);
            }
            if c != d {
                surface.triangles.push([a, d, c]);
            }
        }
    }
    surface
}

/// Volume of [`revolve`]'s polyhedron, the profile closed along the axis or flat from its last point to it: frusta
/// with regular polygons, m³.
pub(crate) fn revolved_volume(profile: &[[f64; 2]], n: usize) -> f64 {
    let polygon = 0.5 * n as f64 * (TAU / n as f64).sin();
    let frustum = |[r, z]: [f64; 2], [s, y]: [f64; 2]| (y - z) * (r * r + r * s + s * s) / 3.0;
    let frusta = profile.windows(2).map(|pair| frustum(pair[0], pair[1]));
    polygon * frusta.sum::<f64>()
}

/// Half circle from the south to the north pole, `n` steps.
pub(crate) fn half_circle(radius: f64, n: usize) -> Profile {
    (0..=n)
        .map(|i| match i {
            0 => [0.0, -radius],
            _ if i == n => [0.0, radius],
            _ => {
                let angle = PI * i as f64 / n as f64;
                [radius * angle.sin(), -radius * angle.cos()]
            }
        })
        .collect()
}

/// A ball with `n` rings and 2 n meridians.
pub(crate) fn sphere(centre: DVec3, radius: f64, n: usize) -> Surface {
    moved(revolve(&half_circle(radius, n), 2 * n), centre)
}

/// Volume of [`sphere`], m³.
pub(crate) fn sphere_volume(radius: f64, n: usize) -> f64 {
    revolved_volume(&half_circle(radius, n), 2 * n)
}

/// A box of twelve triangles.
pub(crate) fn cuboid(low: DVec3, high: DVec3) -> Surface {
    let corner = |i: usize| {
        let pick = |bit: usize, axis: usize| if i & bit == 0 { low[axis] } else { high[axis] };
        DVec3::new(pick(1, 0), pick(2, 1), pick(4, 2))
    };
    let quads = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let halves = quads.map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
    Surface {
        positions: (0..8).map(corner).collect(),
        triangles: halves.concat(),
    }
}

/// The surface elsewhere.
pub(crate) fn moved(mut surface: Surface, by: DVec3) -> Surface {
    for p in &mut surface.positions {
        *p += by;
    }
    surface
}

/// The surface inside out.
pub(crate) fn turned(mut surface: Surface) -> Surface {
    for [_, b, c] in &mut surface.triangles {
        std::mem::swap(b, c);
    }
    surface
}

/// Joins two surfaces to one.
pub(crate) fn joined(mut one: Surface, other: Surface) -> Surface {
    let first = one.positions.len() as u32;
    one.positions.extend(other.positions);
    let moved = other.triangles.iter().map(|t| t.map(|v| v + first));
    one.triangles.extend(moved);
    one
}

/// Evenly distributed numbers in 0..1, the same at every call.
pub(crate) fn noise(count: usize) -> Vec<f64> {
    let mut state = 1_u64;
    let step = || {
        // Knuth's MMIX generator; the low bits are weak.
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    std::iter::repeat_with(step).take(count).collect()
}
