//! A point for each die.

use std::f64::consts::TAU;

use glam::DVec2;

use crate::mesh::{Grid, WallFaces};
use crate::rng::{Purpose, stream, uniform};

/// Length of the dice along the crack's way over their width, where it began; farther off they are as long as wide.
const STRETCHED: f64 = 2.2;
/// Distance over which that falls to a third of its excess, in widths of a die.
const RELAXED: f64 = 8.0;
/// Largest displacement of a point, as a share of a die's length and width.
const JITTER: f64 = 0.32;
/// Least distance of a point from those on the outline, in widths of a die.
const CLEAR: f64 = 0.62;

/// Points of dice, m, in the mean plane: first those on the outlines, joined by the edges.
pub(super) struct Seeds {
    pub(super) points: Vec<DVec2>,
    pub(super) edges: Vec<[usize; 2]>,
}

impl Seeds {
    /// Scatters points for dice of this mean area, m², about the place where the crack began.
    pub(super) fn scatter(wall: &WallFaces, origin: DVec2, area: f64, seed: u64) -> Self {
        let width = area.sqrt();
        let mut seeds = Self {
            points: Vec::new(),
            edges: Vec::new(),
        };
        let mut rng = stream(seed, Purpose::Dice, 0);
        for corners in &wall.outlines {
            seeds.line(corners, width);
        }
        let mut outline = Grid::new(wall.bounds, width);
        for (number, &p) in (0..).zip(&seeds.points) {
            outline.add([p, p], number);
        }
        let [low, high] = wall.bounds;
        let on_outline = seeds.points.len();
        let clear = |p: DVec2, points: &[DVec2]| {
            let reach = DVec2::splat(CLEAR * width);
            let mut near = outline.near([p - reach, p + reach]);
            near.all(|i| points[i as usize].distance(p) > CLEAR * width)
        };
        let farthest = seeds.points.iter().map(|p| p.distance(origin));
        let farthest = farthest.fold(0.0, f64::max);
        // Rings about the origin, each of dice of the mean area.
        let mut inner = 0.0;
        while inner < farthest {
            let stretch = 1.0 + (STRETCHED - 1.0) * libm::exp(-inner / (RELAXED * width));
            let length = width * stretch.sqrt();
            let middle = inner + 0.5 * length;
            let count = (TAU * middle * length / area).round().max(1.0);
            let turn = TAU * uniform(&mut rng);
            for i in 0..count as usize {
                let mut jitter = || JITTER * (2.0 * uniform(&mut rng) - 1.0);
                let angle = turn + TAU * (i as f64 + jitter()) / count;
                let radius = middle + jitter() * length;
                let (sin, cos) = libm::sincos(angle);
                let p = origin + radius * DVec2::new(cos, sin);
                let within = p.cmpge(low).all() && p.cmple(high).all();
                if within
                    && clear(p, &seeds.points[..on_outline])
                    && wall.faces_at(p).is_some_and(|(least, _)| least > 0.0)
                {
                    seeds.points.push(p);
                }
            }
            inner += length;
        }
        seeds
    }

    /// Points along an outline, no farther from each other than a die is wide.
    fn line(&mut self, corners: &[DVec2], width: f64) {
        let first = self.points.len();
        for (i, &from) in corners.iter().enumerate() {
            let to = corners[(i + 1) % corners.len()];
            let parts = (from.distance(to) / width).ceil().max(1.0);
            let along = (0..parts as usize).map(|k| from.lerp(to, k as f64 / parts));
            self.points.extend(along);
        }
        let all = first..self.points.len();
        let next = |i: usize| if i + 1 < all.end { i + 1 } else { all.start };
        self.edges.extend(all.clone().map(|i| [i, next(i)]));
    }
}
