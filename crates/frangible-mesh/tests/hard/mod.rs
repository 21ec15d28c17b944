//! Surfaces that are hard to fill.

use frangible_mesh::Surface;
use frangible_mesh::glam::DVec3;

/// A sphere of 2 n² − 2 n triangles or so: n rings.
pub(crate) fn sphere(centre: DVec3, radius: f64, n: usize) -> Surface {
    let mut surface = Surface::default();
    let m = 2 * n;
    for i in 0..=n {
        for j in 0..m {
            let (a, b) = (
                std::f64::consts::PI * i as f64 / n as f64,
                std::f64::consts::TAU * j as f64 / m as f64,
            );
            surface
                .positions
                .push(centre + radius * DVec3::new(a.sin() * b.cos(), a.sin() * b.sin(), a.cos()));
        }
    }
    for i in 0..n {
        for j in 0..m {
            let at = |i: usize, j: usize| (i * m + j % m) as u32;
            surface
                .triangles
                .push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
            surface
                .triangles
                .push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    surface
}
