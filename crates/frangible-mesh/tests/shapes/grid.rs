//! A body as cubes: counting, flooding, Euler's number.

use frangible_mesh::Solid;
use frangible_mesh::glam::{DVec3, UVec3};
use rayon::prelude::*;

pub(crate) struct Grid {
    size: UVec3,
    low: DVec3,
    edge: f64,
    inside: Vec<bool>,
}

impl Grid {
    /// Cubes of that edge (m) over the body's bounds and two more on each side, inside where their centre is.
    pub(crate) fn of(solid: &dyn Solid, edge: f64) -> Self {
        let [low, high] = solid.bounds();
        let low = low - 2.0 * edge;
        let size = ((high - low) / edge).ceil().as_uvec3() + 2;
        let mut grid = Self {
            size,
            low,
            edge,
            inside: Vec::new(),
        };
        grid.inside = (0..size.element_product())
            .into_par_iter()
            .map(|i| solid.inside(grid.centre(i as usize)))
            .collect();
        grid
    }

    pub(crate) fn centre(&self, i: usize) -> DVec3 {
        let (x, y) = (self.size.x as usize, self.size.y as usize);
        let at = DVec3::new((i % x) as f64, (i / x % y) as f64, (i / x / y) as f64);
        self.low + self.edge * (at + 0.5)
    }

    /// Makes solid what `plug` says.
    pub(crate) fn plugged(mut self, plug: impl Fn(DVec3) -> bool) -> Self {
        for i in 0..self.inside.len() {
            self.inside[i] |= plug(self.centre(i));
        }
        self
    }

    pub(crate) fn volume(&self) -> f64 {
        self.inside.iter().filter(|&&inside| inside).count() as f64 * self.edge.powi(3)
    }

    /// Volumes (m³) of the parts, connected through faces, that are inside or outside.
    pub(crate) fn parts(&self, inside: bool) -> Vec<f64> {
        let steps = [
            1,
            self.size.x as usize,
            (self.size.x * self.size.y) as usize,
        ];
        let mut seen = vec![false; self.inside.len()];
        let mut volumes = Vec::new();
        for start in 0..self.inside.len() {
            if seen[start] || self.inside[start] != inside {
                continue;
            }
            seen[start] = true;
            let (mut open, mut count) = (vec![start], 0);
            while let Some(i) = open.pop() {
                count += 1;
                for step in steps {
                    // Wrapping from one row into the next joins outer cells only, which the margin joins anyway.
                    for next in [i.wrapping_sub(step), i + step] {
                        if next < seen.len() && !seen[next] && self.inside[next] == inside {
                            seen[next] = true;
                            open.push(next);
                        }
                    }
                }
            }
            volumes.push(f64::from(count) * self.edge.powi(3));
        }
        volumes
    }

    /// Corners - edges + faces - cubes of the closed cubes inside.
    pub(crate) fn euler_number(&self) -> i64 {
        let (x, y) = (self.size.x as usize, self.size.y as usize);
        let held = |i: usize, axes: &[usize]| {
            // The cubes around the corner, edge or face at the low end of cube `i`, which spreads not along `axes`.
            (0..1 << axes.len()).any(|choice: usize| {
                let back: usize = axes
                    .iter()
                    .enumerate()
                    .map(|(bit, axis)| (choice >> bit & 1) * axis)
                    .sum();
                self.inside[i - back]
            })
        };
        let (a, b, c) = (1, x, x * y);
        let count = |axes: &[usize]| {
            (a + b + c..self.inside.len())
                .filter(|&i| held(i, axes))
                .count() as i64
        };
        count(&[a, b, c]) - count(&[a, b]) - count(&[b, c]) - count(&[a, c])
            + count(&[a])
            + count(&[b])
            + count(&[c])
            - count(&[])
    }
}
