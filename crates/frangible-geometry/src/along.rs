//! Distances along a surface.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use glam::{DVec3, Vec3};

use super::Rows;

/// Geodesic distances on a triangle surface.
pub struct AlongSurface<'a> {
    positions: &'a [Vec3],
    triangles: &'a [[u32; 3]],
    around: Rows,
}

impl<'a> AlongSurface<'a> {
    /// Prepares these triangles; every index must refer to a position.
    #[must_use]
    pub fn new(positions: &'a [Vec3], triangles: &'a [[u32; 3]]) -> Self {
        Self {
            positions,
            triangles,
            around: Rows::inverse(positions.len(), triangles),
        }
    }

    /// Returns the distance of each vertex from the nearest source, m, over the triangles that are `open`; infinite for unreachable
    /// vertices.
    ///
    /// Fast marching on triangles (Kimmel and Sethian 1998): exact in front of a straight line of sources on a flat surface without
    /// obtuse triangles, otherwise an upper bound that is a few per cent too large.
    #[must_use]
    pub fn distances(&self, sources: &[u32], open: impl Fn(usize) -> bool) -> Vec<f64> {
        let mut distances = vec![f64::INFINITY; self.positions.len()];
        let mut settled = vec![false; self.positions.len()];
        // Distances are never negative: their bits sort as they do.
        let mut waiting = BinaryHeap::new();
        for &v in sources {
            distances[v as usize] = 0.0;
            waiting.push(Reverse((0_u64, v)));
        }
        while let Some(Reverse((_, v))) = waiting.pop() {
            if std::mem::replace(&mut settled[v as usize], true) {
                continue;
            }
            for &t in self.around.of(v) {
                if !open(t as usize) {
                    continue;
                }
                let corners = self.triangles[t as usize];
                for k in 0..3 {
                    let [w, a, b] = [corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]];
                    if settled[w as usize] {
                        continue;
                    }
                    let x = [w, a, b].map(|i| self.positions[i as usize].as_dvec3());
                    let known = [a, b].map(|i| match settled[i as usize] {
                        true => distances[i as usize],
                        false => f64::INFINITY,
                    });
                    let found = across(x, known);
                    if found < distances[w as usize] {
                        distances[w as usize] = found;
                        waiting.push(Reverse((found.to_bits(), w)));
                    }
                }
            }
        }
        distances
    }

    /// Returns the mean over the corners of each triangle.
    #[must_use]
    pub fn at_triangles(&self, distances: &[f64]) -> Vec<f64> {
        let mean = |t: &[u32; 3]| t.iter().map(|&v| distances[v as usize]).sum::<f64>() / 3.0;
        self.triangles.iter().map(mean).collect()
    }
}

/// Distance at the first corner from those at the two others: a plane front that passes between them, or the shorter side.
fn across([w, a, b]: [DVec3; 3], [of_a, of_b]: [f64; 2]) -> f64 {
    let (to_a, to_b) = (a - w, b - w);
    let along_sides = (of_a + to_a.length()).min(of_b + to_b.length());
    if !(of_a.is_finite() && of_b.is_finite()) {
        return along_sides;
    }
    // The gradient g = Σ c_i (x_i − w) has g·(x_i − w) = T_i − t and length 1: a quadratic equation in t.
    let (aa, ab, bb) = (to_a.dot(to_a), to_a.dot(to_b), to_b.dot(to_b));
    let determinant = aa * bb - ab * ab;
    if determinant <= 1e-12 * aa * bb {
        return along_sides;
    }
    let solve = |[p, q]: [f64; 2]| {
        [
            (bb * p - ab * q) / determinant,
            (aa * q - ab * p) / determinant,
        ]
    };
    let ([one_a, one_b], [own_a, own_b]) = (solve([1.0, 1.0]), solve([of_a, of_b]));
    let squares = one_a + one_b;
    let linear = own_a + own_b;
    let constant = of_a * own_a + of_b * own_b - 1.0;
    let discriminant = linear * linear - squares * constant;
    if discriminant < 0.0 {
        return along_sides;
    }
    let t = (linear + discriminant.sqrt()) / squares;
    // From between the two other corners, or it is no news from them.
    let comes_between = own_a - t * one_a <= 0.0 && own_b - t * one_b <= 0.0;
    match comes_between && t >= of_a.max(of_b) {
        true => t.min(along_sides),
        false => along_sides,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::numbers;

    /// A square sheet of `n` × `n` cells in the unit square, its inner vertices moved about.
    fn sheet(n: u32) -> (Vec<Vec3>, Vec<[u32; 3]>) {
        let mut numbers = numbers();
        let mut random = || 0.5 * (numbers() - 0.5) / n as f32;
        let mut positions = Vec::new();
        for j in 0..=n {
            for i in 0..=n {
                let inner = i > 0 && i < n && j > 0 && j < n;
                let moved = [random(), random()].map(|x| if inner { x } else { 0.0 });
                let [x, y] = [i, j].map(|k| k as f32 / n as f32);
                positions.push(Vec3::new(x + moved[0], y + moved[1], 0.0));
            }
        }
        let at = |i: u32, j: u32| j * (n + 1) + i;
        let cells = (0..n).flat_map(|j| (0..n).map(move |i| (i, j)));
        let triangles = cells.flat_map(|(i, j)| {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            match (i + j) % 2 {
                0 => [[a, b, c], [a, c, d]],
                _ => [[a, b, d], [b, c, d]],
            }
        });
        (positions, triangles.collect())
    }

    #[test]
    fn distances_from_a_line_are_those_of_the_plane_within_a_few_hundredths() {
        let (positions, triangles) = sheet(20);
        let along = AlongSurface::new(&positions, &triangles);
        let line: Vec<u32> = (0..=20).collect();
        let found = along.distances(&line, |_| true);
        for (p, d) in positions.iter().zip(&found) {
            let exact = f64::from(p.y);
            // A tenth of an edge: obtuse triangles are passed along their sides.
            assert!(
                (exact - 1e-6..1.02 * exact + 0.005).contains(d),
                "{d} at {p}"
            );
        }
    }

    #[test]
    fn distances_from_a_point_are_those_of_the_plane_within_a_few_hundredths() {
        let (positions, triangles) = sheet(40);
        let along = AlongSurface::new(&positions, &triangles);
        let found = along.distances(&[0], |_| true);
        for (p, d) in positions.iter().zip(&found) {
            let exact = f64::from(p.length());
            assert!(*d >= exact - 1e-6, "{d} at {p}");
            assert!(*d <= 1.04 * exact + 0.025, "{d} at {p}");
        }
    }

    #[test]
    fn no_way_leads_over_closed_triangles() {
        let (positions, triangles) = sheet(20);
        let along = AlongSurface::new(&positions, &triangles);
        // A wall across the middle, with a gap at the right.
        let open = |t: usize| {
            let [x, y] = [0, 1].map(|k| {
                triangles[t]
                    .iter()
                    .map(|&v| positions[v as usize][k])
                    .sum::<f32>()
                    / 3.0
            });
            !(0.45..0.55).contains(&y) || x > 0.9
        };
        let found = along.distances(&[0], open);
        let beyond = 20 * 21; // The far left corner.
        assert!(found[beyond] > 1.8, "{}", found[beyond]);
        let shut = along.distances(&[0], |t| {
            open(t) && triangles[t].iter().all(|&v| positions[v as usize].x < 0.9)
        });
        assert_eq!(shut[beyond], f64::INFINITY);
    }
}
