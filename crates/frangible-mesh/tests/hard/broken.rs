//! Surfaces with holes, cracks and wrong faces that still mean a body.

use frangible_mesh::Surface;
use frangible_mesh::glam::DVec3;

use super::shapes::{cuboid, half_circle, noise, revolve, revolved_volume, sphere, sphere_volume};
use super::{HardCase, leaky};

pub(crate) fn all() -> Vec<HardCase> {
    vec![
        open_ball(),
        cup_without_thickness(),
        half_ball(),
        ball_with_missing_faces(),
        ball_with_turned_faces(),
        noisy_soup(),
        t_junctions(),
        specks(),
    ]
}

/// A tenth of the area is missing; flat over a plane rim w = ½, so the hole is closed flat.
pub(crate) fn open_ball() -> HardCase {
    let mut profile = half_circle(1.0, 40);
    profile.retain(|[_, z]| *z < 0.805);
    let volume = revolved_volume(&profile, 80);
    leaky("open ball", revolve(&profile, 80), volume)
}

/// A sheet bent to a cup is closed over its rim, to a full cylinder: it has no wall to keep.
pub(crate) fn cup_without_thickness() -> HardCase {
    let profile = [[0.0, 0.0], [0.04, 0.0], [0.04, 0.05], [0.04, 0.1]];
    let volume = revolved_volume(&profile, 48);
    leaky("cup without thickness", revolve(&profile, 48), volume)
}

pub(crate) fn half_ball() -> HardCase {
    let mut profile = half_circle(1.0, 40);
    profile.truncate(21);
    let volume = revolved_volume(&profile, 80);
    leaky("half ball", revolve(&profile, 80), volume)
}

/// One face in forty is missing.
pub(crate) fn ball_with_missing_faces() -> HardCase {
    let mut surface = sphere(DVec3::ZERO, 1.0, 32);
    let mut kept = noise(surface.triangles.len()).into_iter();
    surface
        .triangles
        .retain(|_| kept.next().is_some_and(|x| x > 0.025));
    leaky("ball with missing faces", surface, sphere_volume(1.0, 32))
}

/// One face in a hundred looks inwards.
pub(crate) fn ball_with_turned_faces() -> HardCase {
    let mut surface = sphere(DVec3::ZERO, 1.0, 32);
    for (triangle, x) in surface.triangles.iter_mut().zip(noise(100_000)) {
        if x < 0.01 {
            triangle.swap(1, 2);
        }
    }
    leaky("ball with turned faces", surface, sphere_volume(1.0, 32))
}

/// Triangles that share no corner, each corner moved by up to 1 % of the radius.
pub(crate) fn noisy_soup() -> HardCase {
    let ball = sphere(DVec3::ZERO, 1.0, 24);
    let mut random = noise(9 * ball.triangles.len()).into_iter();
    let mut jitter = || 0.02 * (random.next().unwrap_or(0.5) - 0.5);
    let mut surface = Surface::default();
    for t in 0..ball.triangles.len() {
        let first = surface.positions.len() as u32;
        for corner in ball.corners(t) {
            let moved = corner + DVec3::new(jitter(), jitter(), jitter());
            surface.positions.push(moved);
        }
        surface.triangles.push([first, first + 1, first + 2]);
    }
    leaky("noisy soup", surface, sphere_volume(1.0, 24))
}

/// A cube with corners in the middle of edges that only one of the two faces knows.
pub(crate) fn t_junctions() -> HardCase {
    let mut surface = cuboid(DVec3::ZERO, DVec3::ONE);
    let mut halves = Vec::new();
    for [a, b, c] in std::mem::take(&mut surface.triangles) {
        if a == 0 {
            let middle = surface.positions.len() as u32;
            let [p, q] = [b, c].map(|v| surface.positions[v as usize]);
            surface.positions.push(0.5 * (p + q));
            halves.extend([[a, b, middle], [a, middle, c]]);
        } else {
            halves.push([a, b, c]);
        }
    }
    surface.triangles = halves;
    leaky("t-junctions", surface, 1.0)
}

/// A cube with triangles that are points or lines, and vertices that nothing uses, one of them not a number.
pub(crate) fn specks() -> HardCase {
    let mut surface = cuboid(DVec3::ZERO, DVec3::ONE);
    surface.positions.extend([DVec3::splat(0.5), DVec3::NAN]);
    surface.triangles.extend([[0, 0, 0], [1, 1, 2], [0, 7, 8]]);
    leaky("specks", surface, 1.0)
}
