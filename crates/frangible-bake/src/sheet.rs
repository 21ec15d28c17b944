//! A triangulated sheet over two parameters, deliberately irregular but with well-shaped triangles.
//!
//! A regular mesh would show in the crack faces. The sheet is therefore jittered with a seed, made
//! Delaunay by Lawson flips, and relaxed by a few steps of Laplacian smoothing; vertices on edges
//! slide only along them.
//!
//! Boxes and bodies of revolution are such a sheet, extruded in layers.

use frangible::glam::DVec3;

use crate::random;

/// No line: the vertex may move both ways.
pub(crate) const FREE: u32 = u32::MAX;

/// Triangles between parameter points.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sheet {
    /// Two parameters per vertex.
    pub(crate) coords: Vec<[f64; 2]>,
    /// For each of the two parameters, true if it may change.
    pub(crate) slides: Vec<[bool; 2]>,
    /// Sharp line the vertex lies on, or [`FREE`]; edges along a line are never flipped.
    pub(crate) line: Vec<u32>,
    /// Vertex indices, counter-clockwise in the parameters.
    pub(crate) triangles: Vec<[u32; 3]>,
}

impl Sheet {
    /// Adds a vertex and gives its index.
    pub(crate) fn push(&mut self, coords: [f64; 2], slides: [bool; 2], line: u32) -> u32 {
        self.coords.push(coords);
        self.slides.push(slides);
        self.line.push(line);
        (self.coords.len() - 1) as u32
    }

    /// Fills the strip between a lower and an upper row of (vertex, position along the row).
    pub(crate) fn zip(&mut self, lower: &[(u32, f64)], upper: &[(u32, f64)]) {
        let (mut i, mut j) = (0, 0);
        while i + 1 < lower.len() || j + 1 < upper.len() {
            let middle = |row: &[(u32, f64)], k: usize| {
                row.get(k + 1)
                    .map_or(f64::INFINITY, |next| 0.5 * (row[k].1 + next.1))
            };
            if middle(lower, i) <= middle(upper, j) {
                self.triangles
                    .push([lower[i].0, lower[i + 1].0, upper[j].0]);
                i += 1;
            } else {
                self.triangles
                    .push([lower[i].0, upper[j + 1].0, upper[j].0]);
                j += 1;
            }
        }
    }

    /// Makes the sheet irregular: rounds of jitter of a third of `edge`, flips and one smoothing step.
    /// One round leaves stretches of the lattice standing, three leave none.
    pub(crate) fn disorder(&mut self, edge: f64, seed: u64, lift: &dyn Fn([f64; 2]) -> DVec3) {
        for round in 0..3 {
            self.jitter(0.35 * edge, random::bits(seed, round), lift);
            self.flip(lift);
            self.relax(1, lift);
            self.flip(lift);
        }
    }

    /// Moves each free parameter by up to `amount` metres on the lifted sheet.
    fn jitter(&mut self, amount: f64, seed: u64, lift: &dyn Fn([f64; 2]) -> DVec3) {
        for v in 0..self.coords.len() {
            let tangents = tangents(self.coords[v], lift);
            for axis in 0..2 {
                if self.slides[v][axis] {
                    let length = tangents[axis].length().max(1e-12);
                    self.coords[v][axis] +=
                        amount * random::symmetric(seed, 2 * v as u64 + axis as u64) / length;
                }
            }
        }
    }

    /// Laplacian smoothing: every vertex moves most of the way to the mean of its neighbours.
    pub(crate) fn relax(&mut self, steps: usize, lift: &dyn Fn([f64; 2]) -> DVec3) {
        for _ in 0..steps {
            let lifted: Vec<DVec3> = self.coords.iter().map(|&c| lift(c)).collect();
            let mut sums = vec![(DVec3::ZERO, 0.0); lifted.len()];
            for t in &self.triangles {
                for k in 0..3 {
                    let sum = &mut sums[t[k] as usize];
                    sum.0 += lifted[t[(k + 1) % 3] as usize] + lifted[t[(k + 2) % 3] as usize];
                    sum.1 += 2.0;
                }
            }
            for v in 0..lifted.len() {
                let move_ = 0.7 * (sums[v].0 / sums[v].1 - lifted[v]);
                let tangents = tangents(self.coords[v], lift);
                for axis in 0..2 {
                    let squared = tangents[axis].length_squared();
                    if self.slides[v][axis] && squared > 0.0 {
                        self.coords[v][axis] += move_.dot(tangents[axis]) / squared;
                    }
                }
            }
        }
    }

    /// Lawson flips on the lifted sheet until it is Delaunay, sharp lines kept.
    pub(crate) fn flip(&mut self, lift: &dyn Fn([f64; 2]) -> DVec3) {
        let lifted: Vec<DVec3> = self.coords.iter().map(|&c| lift(c)).collect();
        // Every pass flips edges whose triangles are still untouched in it; 40 passes have always been plenty.
        for _ in 0..40 {
            let mut edges: Vec<(u32, u32, u32, u32)> = Vec::with_capacity(3 * self.triangles.len());
            for (e, t) in self.triangles.iter().enumerate() {
                for k in 0..3 {
                    let (a, b) = (t[k], t[(k + 1) % 3]);
                    edges.push((a.min(b), a.max(b), e as u32, k as u32));
                }
            }
            edges.sort_unstable();
            let mut touched = vec![false; self.triangles.len()];
            let mut flips = 0;
            for pair in edges.windows(2) {
                let (first, second) = (pair[0], pair[1]);
                let (e, f) = (first.2 as usize, second.2 as usize);
                if (first.0, first.1) != (second.0, second.1) || touched[e] || touched[f] {
                    continue;
                }
                let (a, b) = (
                    self.triangles[e][first.3 as usize],
                    self.triangles[e][(first.3 as usize + 1) % 3],
                );
                let (c, d) = (
                    self.triangles[e][(first.3 as usize + 2) % 3],
                    self.triangles[f][(second.3 as usize + 2) % 3],
                );
                if self.line[a as usize] != FREE && self.line[a as usize] == self.line[b as usize] {
                    continue;
                }
                let key = (c.min(d), c.max(d));
                let place = edges.partition_point(|x| (x.0, x.1) < key);
                let exists = edges.get(place).is_some_and(|x| (x.0, x.1) == key);
                if !exists && should_flip([a, b, c, d].map(|v| lifted[v as usize])) {
                    self.triangles[e] = [a, d, c];
                    self.triangles[f] = [d, b, c];
                    (touched[e], touched[f]) = (true, true);
                    flips += 1;
                }
            }
            if flips == 0 {
                break;
            }
        }
    }
}

/// Derivatives of the lifted sheet with respect to the two parameters, by central differences.
fn tangents(c: [f64; 2], lift: &dyn Fn([f64; 2]) -> DVec3) -> [DVec3; 2] {
    let h = 1e-5;
    [
        (lift([c[0] + h, c[1]]) - lift([c[0] - h, c[1]])) / (2.0 * h),
        (lift([c[0], c[1] + h]) - lift([c[0], c[1] - h])) / (2.0 * h),
    ]
}

/// Triangles abc and bad: the edge ab goes when the angles at c and d sum to more than π, unless the
/// two new triangles would fold over.
fn should_flip([a, b, c, d]: [DVec3; 4]) -> bool {
    let angle = |p: DVec3, q: DVec3, r: DVec3| (q - p).angle_between(r - p);
    if angle(c, a, b) + angle(d, b, a) <= std::f64::consts::PI + 1e-6 {
        return false;
    }
    let normal = (b - a).cross(c - a) + (a - b).cross(d - b);
    let (first, second) = ((d - a).cross(c - a), (b - d).cross(c - d));
    first.dot(normal) > 0.05 * first.length() * normal.length()
        && second.dot(normal) > 0.05 * second.length() * normal.length()
}
