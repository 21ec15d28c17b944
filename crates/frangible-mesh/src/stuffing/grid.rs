//! Points of a regular grid inside a solid, found by asking the solid only near its surface.

use glam::DVec3;
use rayon::prelude::*;

use crate::solid::Solid;

/// Points `origin + spacing * (i, j, k)`, i < counts[0] and so on; i runs fastest.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    pub(crate) origin: DVec3,
    pub(crate) spacing: f64,
    pub(crate) counts: [usize; 3],
}

/// Points along a side of the blocks that are looked at first.
const BLOCK: usize = 16;

impl Grid {
    pub(crate) fn len(&self) -> usize {
        self.counts.iter().product()
    }

    pub(crate) fn index(&self, [i, j, k]: [usize; 3]) -> usize {
        (k * self.counts[1] + j) * self.counts[0] + i
    }

    pub(crate) fn point(&self, [i, j, k]: [usize; 3]) -> DVec3 {
        self.origin + self.spacing * DVec3::new(i as f64, j as f64, k as f64)
    }

    /// Works through the blocks of the grid's points on all threads: `work` is given the box `low..high` of each. The results come in the
    /// order of the blocks.
    fn by_blocks<T: Send>(&self, work: impl Fn([usize; 3], [usize; 3]) -> T + Sync) -> Vec<T> {
        let blocks = self.counts.map(|n| n.div_ceil(BLOCK));
        (0..blocks.iter().product::<usize>())
            .into_par_iter()
            .map(|b| {
                let place = [
                    b % blocks[0],
                    b / blocks[0] % blocks[1],
                    b / blocks[0] / blocks[1],
                ];
                let low = place.map(|c| c * BLOCK);
                let high = std::array::from_fn(|k| (low[k] + BLOCK).min(self.counts[k]));
                work(low, high)
            })
            .collect()
    }

    /// Inside or not, per point.
    pub(crate) fn inside(&self, solid: &dyn Solid) -> Vec<bool> {
        let found = self.by_blocks(|low, high| {
            let mut runs = Vec::new();
            self.classify(solid, low, high, &mut runs);
            runs
        });
        let mut inside = vec![false; self.len()];
        for run in found.iter().flatten() {
            for k in run.low[2]..run.high[2] {
                for j in run.low[1]..run.high[1] {
                    let start = self.index([run.low[0], j, k]);
                    inside[start..start + run.high[0] - run.low[0]].fill(true);
                }
            }
        }
        inside
    }

    /// Boxes of points that lie inside, within the box `low..high`.
    fn classify(&self, solid: &dyn Solid, low: [usize; 3], high: [usize; 3], out: &mut Vec<Run>) {
        let size: [usize; 3] = std::array::from_fn(|k| high[k] - low[k]);
        if size.iter().all(|&s| s == 1) {
            if solid.inside(self.point(low)) {
                out.push(Run { low, high });
            }
            return;
        }
        let (first, last) = (self.point(low), self.point(high.map(|h| h - 1)));
        let centre = 0.5 * (first + last);
        let distance = solid.signed_distance(centre);
        // Where an open surface is closed by its winding number no triangle marks the change of side: the corners
        // have to agree as well.
        if distance.abs() > 0.5 * first.distance(last) {
            let corner = |c: usize| {
                let pick = |k: usize| if c >> k & 1 == 0 { first[k] } else { last[k] };
                DVec3::new(pick(0), pick(1), pick(2))
            };
            let inside = distance < 0.0;
            if (0..8).all(|c| solid.inside(corner(c)) == inside) {
                if inside {
                    out.push(Run { low, high });
                }
                return;
            }
        }
        for [from, to] in eighths(low, high) {
            self.classify(solid, from, to, out);
        }
    }
}

/// The up to eight parts of a box of grid points, halved along each axis.
fn eighths(low: [usize; 3], high: [usize; 3]) -> impl Iterator<Item = [[usize; 3]; 2]> {
    let middle: [usize; 3] = std::array::from_fn(|k| low[k] + (high[k] - low[k]).div_ceil(2));
    (0..8)
        .map(move |c| {
            let upper = |k: usize| c >> k & 1 == 1;
            let from = std::array::from_fn(|k| if upper(k) { middle[k] } else { low[k] });
            let to = std::array::from_fn(|k| if upper(k) { high[k] } else { middle[k] });
            [from, to]
        })
        .filter(|[from, to]| (0..3).all(|k| from[k] < to[k]))
}

/// A box of grid points, `low` included, `high` not.
struct Run {
    low: [usize; 3],
    high: [usize; 3],
}

/// Volume of a solid, m³, on a grid of this spacing: every point stands for a cube, of which it counts the share that
/// its distance to the surface says lies inside.
#[must_use]
pub fn counted_volume(solid: &dyn Solid, spacing: f64) -> f64 {
    let [low, high] = solid.bounds();
    let counts = ((high - low) / spacing)
        .to_array()
        .map(|n| n.ceil() as usize + 2);
    let extent = spacing * DVec3::from_array(counts.map(|n| n as f64 - 1.0));
    let origin = 0.5 * (low + high) - 0.5 * extent;
    let grid = Grid {
        origin,
        spacing,
        counts,
    };
    let sums = grid.by_blocks(|low, high| grid.share_inside(solid, low, high));
    sums.iter().sum::<f64>() * spacing.powi(3)
}

impl Grid {
    /// Points of the box `low..high` that lie inside, those near the surface counted in part.
    fn share_inside(&self, solid: &dyn Solid, low: [usize; 3], high: [usize; 3]) -> f64 {
        let size: [usize; 3] = std::array::from_fn(|k| high[k] - low[k]);
        let number = size.iter().product::<usize>() as f64;
        let (first, last) = (self.point(low), self.point(high.map(|h| h - 1)));
        let distance = solid.signed_distance(0.5 * (first + last));
        let reach = 0.5 * first.distance(last) + 0.5 * self.spacing;
        if size.iter().all(|&s| s == 1) || distance.abs() > reach {
            return number * (0.5 - distance / self.spacing).clamp(0.0, 1.0);
        }
        eighths(low, high)
            .map(|[from, to]| self.share_inside(solid, from, to))
            .sum()
    }
}
