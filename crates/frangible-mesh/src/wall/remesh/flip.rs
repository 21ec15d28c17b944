//! Turns edges until the sheet is Delaunay.

use std::collections::BTreeSet;

use glam::DVec3;

use super::sheet::{NONE, Sheet};

/// Rounds of flips; each turns edges whose triangles are still untouched in it.
const ROUNDS: usize = 40;
/// Cosine of the largest turn of a triangle by a flip.
const TURN: f64 = 0.7;

/// Lawson flips of all edges that are not sharp.
pub(crate) fn flip(sheet: &mut Sheet) {
    for _ in 0..ROUNDS {
        let edges = sheet.edges();
        let mut touched = vec![false; sheet.triangles.len()];
        let mut made: BTreeSet<[u32; 2]> = BTreeSet::new();
        for edge in &edges {
            let [(t, k), (u, l)] = edge.sides;
            if u == NONE || touched[t as usize] || touched[u as usize] {
                continue;
            }
            let (first, second) = (sheet.triangles[t as usize], sheet.triangles[u as usize]);
            let [a, b, c] = [0, 1, 2].map(|i| first[(k as usize + i) % 3]);
            let d = second[(l as usize + 2) % 3];
            let across = [c.min(d), c.max(d)];
            if c == d
                || sheet.sharp_at(a, b).is_some()
                || edges
                    .binary_search_by_key(&across, |edge| edge.ends)
                    .is_ok()
                || made.contains(&across)
                || !should_flip([a, b, c, d].map(|v| sheet.at(v)))
            {
                continue;
            }
            sheet.triangles[t as usize] = [a, d, c];
            sheet.triangles[u as usize] = [d, b, c];
            (touched[t as usize], touched[u as usize]) = (true, true);
            made.insert(across);
        }
        if made.is_empty() {
            break;
        }
    }
}

/// Triangles abc and bad: the edge ab goes when the angles at c and d sum to more than π, unless the two new triangles would fold over.
fn should_flip([a, b, c, d]: [DVec3; 4]) -> bool {
    let angle = |p: DVec3, q: DVec3, r: DVec3| (q - p).angle_between(r - p);
    if angle(c, a, b) + angle(d, b, a) <= std::f64::consts::PI + 1e-6 {
        return false;
    }
    let before = (b - a).cross(c - a) + (a - b).cross(d - b);
    [(d - a).cross(c - a), (b - d).cross(c - d)]
        .into_iter()
        .all(|after| after.dot(before) > TURN * after.length() * before.length())
}
