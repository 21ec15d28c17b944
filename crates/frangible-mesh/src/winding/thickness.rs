//! Thickness of a body, which its mesher must know to resolve the walls.

use rayon::prelude::*;

use super::mesh_solid::MeshSolid;
use super::packet::{WIDTH, area_vector};
use crate::solid::{Solid, SurfacePoint};

/// Rays around the inward normal lean this much: the half angle of a 30° cone, rad.
const LEAN: f64 = std::f64::consts::PI / 12.0;
/// Rays around the normal.
const AROUND: usize = 6;
/// Rays start this far below the surface, in sizes of the body.
const SKIN: f64 = 1e-7;
/// Lines across the body, along each of two axes, that measure its volume.
const LINES: usize = 64;

/// Measures of a solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thickness {
    /// Thickness that a twentieth of the surface is below, m.
    pub thinnest: f64,
    /// Thickness that half of the surface is below, m.
    pub median: f64,
    /// Area of the outer surface, m²; triangles buried in overlapping shells do not count.
    pub area: f64,
    /// Volume, m³, to about a per cent.
    pub volume: f64,
}

/// A body whose median wall is below this many times its thinnest is a shell: its walls are what holds it together.
const SHELL: f64 = 4.0;

impl Thickness {
    /// Thickness of the walls, m, of a body that is thin all over: hand it to
    /// [`TetOptions::wall`](crate::TetOptions::wall). `None` for a lump, be it with thin ears.
    #[must_use]
    pub fn of_shell(&self) -> Option<f64> {
        (self.thinnest > 0.0 && self.median < SHELL * self.thinnest).then_some(self.thinnest)
    }
}

/// Measures the wall at `samples` random places of the surface, equally many per area. At each, the median over seven
/// rays into the body within 30°, like the shape diameter [Shapira et al. 2008]: the thickness of a wall, and nearly
/// the diameter of a ball. The same seed gives the same bits. All zero without samples, or if no triangle borders the
/// inside.
#[must_use]
pub fn wall_thickness(solid: &MeshSolid, samples: usize, seed: u64) -> Thickness {
    let (points, triangle_area) = scatter(solid, samples, seed);
    let [low, high] = solid.bounds();
    let skin = SKIN * (high - low).length();
    let mut thicknesses: Vec<f64> = points
        .par_iter()
        .filter_map(|point| thickness_at(solid, point, skin))
        .collect();
    thicknesses.sort_by(f64::total_cmp);
    let at = |percent: usize| {
        let index = thicknesses.len() * percent / 100;
        thicknesses.get(index).copied().unwrap_or(0.0)
    };
    Thickness {
        thinnest: at(5),
        median: at(50),
        area: triangle_area * thicknesses.len() as f64 / samples.max(1) as f64,
        volume: volume(solid),
    }
}

/// Median thickness below a point of the surface, m; `None` where the surface does not part inside from outside.
fn thickness_at(solid: &dyn Solid, point: &SurfacePoint, skin: f64) -> Option<f64> {
    let SurfacePoint { position, normal } = *point;
    let below = position - skin * normal;
    if solid.inside(position + skin * normal) || !solid.inside(below) {
        return None;
    }
    let (side, other) = normal.any_orthonormal_pair();
    let mut lengths = [0.0; AROUND + 1];
    for (ray, length) in lengths.iter_mut().enumerate() {
        let lean = if ray == AROUND { 0.0 } else { LEAN };
        let turn = std::f64::consts::TAU * ray as f64 / AROUND as f64;
        let sideways = turn.cos() * side + turn.sin() * other;
        let direction = lean.sin() * sideways - lean.cos() * normal;
        *length = solid.exit(below, direction)?;
    }
    lengths.sort_by(f64::total_cmp);
    Some(skin + lengths[AROUND / 2])
}

/// Random points on the triangles, one per equal share of the area, and the area, m².
fn scatter(solid: &MeshSolid, samples: usize, seed: u64) -> (Vec<SurfacePoint>, f64) {
    let mut triangles = Vec::with_capacity(WIDTH * solid.packets().len());
    let mut total = 0.0;
    for packet in solid.packets() {
        for lane in 0..WIDTH {
            let corners = packet.triangle(lane);
            let normal = area_vector(corners);
            let area = normal.length();
            if area > 0.0 {
                total += area;
                triangles.push((total, corners, normal / area));
            }
        }
    }
    let mut random = Random(seed);
    let outwards = if solid.turned() { -1.0 } else { 1.0 };
    let points = (0..samples)
        .filter_map(|sample| {
            let target = total * (sample as f64 + random.next()) / samples as f64;
            let index = triangles.partition_point(|(sum, ..)| *sum < target);
            let (_, [a, b, c], normal) = triangles.get(index).or(triangles.last())?;
            let (mut u, mut v) = (random.next(), random.next());
            if u + v > 1.0 {
                (u, v) = (1.0 - u, 1.0 - v);
            }
            Some(SurfacePoint {
                position: a + u * (b - a) + v * (c - a),
                normal: outwards * normal,
            })
        })
        .collect();
    (points, total)
}

/// Volume by the lengths that parallel lines, along the longest axis, have inside, m³.
fn volume(solid: &MeshSolid) -> f64 {
    let [low, high] = solid.bounds();
    let extent = high - low;
    let axis = extent.max_position();
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let lengths: Vec<f64> = (0..LINES * LINES)
        .into_par_iter()
        .map(|line| {
            let place = |i: usize| (i as f64 + 0.5) / LINES as f64;
            let mut from = low;
            from[u] += place(line / LINES) * extent[u];
            from[v] += place(line % LINES) * extent[v];
            let mut to = from;
            to[axis] = high[axis];
            let share: f64 = solid
                .borders(from, to)
                .windows(2)
                .filter(|pair| solid.inside(from.lerp(to, 0.5 * (pair[0] + pair[1]))))
                .map(|pair| pair[1] - pair[0])
                .sum();
            share * extent[axis]
        })
        .collect();
    lengths.iter().sum::<f64>() * extent[u] * extent[v] / (LINES * LINES) as f64
}

/// SplitMix64 [Steele, Lea & Flood 2014].
struct Random(u64);

impl Random {
    /// Next number, in 0..1.
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}
