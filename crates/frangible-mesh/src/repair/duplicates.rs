//! Triangles on the same three vertices.

use frangible_geometry::DisjointSets;
use rayon::slice::ParallelSliceMut as _;

use super::edges::{Edges, Side};

/// Keeps one triangle of each set on the same vertices; returns how many went.
///
/// If as many face either way, they are back to back without thickness. Sheets of such pairs that end at open
/// edges of the rest close it, and those that hang on nothing are a double-sided model: one copy stays. Membranes
/// between closed parts and fins bound nothing: both copies go.
pub(super) fn drop_duplicates(triangles: &mut Vec<[u32; 3]>, vertices: usize) -> usize {
    let before = triangles.len();
    let mut order: Vec<([u32; 3], u32)> = triangles
        .iter()
        .zip(0..)
        .map(|(&t, i)| (sorted(t), i))
        .collect();
    order.par_sort_unstable();
    let mut keep = vec![true; before];
    let mut is_paired = vec![false; before];
    let mut any_pair = false;
    for same in order
        .chunk_by(|a, b| a.0 == b.0)
        .filter(|same| same.len() > 1)
    {
        let is_even = |i: u32| is_even(triangles[i as usize]);
        let even = same.iter().filter(|(_, i)| is_even(*i)).count();
        let odd = same.len() - even;
        let stays = same
            .iter()
            .find(|(_, i)| even == odd || is_even(*i) == (even > odd));
        for &(_, i) in same {
            keep[i as usize] = stays.is_some_and(|stays| stays.1 == i);
        }
        if let Some(&(_, i)) = stays.filter(|_| even == odd) {
            is_paired[i as usize] = true;
            any_pair = true;
        }
    }
    drop(order);
    retain(triangles, &keep);
    if any_pair {
        retain(&mut is_paired, &keep);
        let keep = needed(triangles, &is_paired, vertices);
        retain(triangles, &keep);
    }
    before - triangles.len()
}

fn sorted(mut triangle: [u32; 3]) -> [u32; 3] {
    triangle.sort_unstable();
    triangle
}

/// Returns true if the vertices rise along the winding, up to where it starts.
pub(crate) fn is_even([a, b, c]: [u32; 3]) -> bool {
    [a < b, b < c, c < a]
        .into_iter()
        .filter(|&rises| rises)
        .count()
        == 2
}

pub(super) fn retain<T>(list: &mut Vec<T>, keep: &[bool]) {
    let mut flags = keep.iter();
    list.retain(|_| flags.next().copied().unwrap_or(true));
}

/// For each triangle, true if it stays: all do but the sheets of pairs whose rims mostly lie on edges that are closed without them.
fn needed(triangles: &[[u32; 3]], is_paired: &[bool], vertices: usize) -> Vec<bool> {
    let edges = Edges::new(vertices, triangles);
    let mut sheets = DisjointSets::new(triangles.len());
    let split = |group: &[Side]| {
        let paired: Vec<usize> = group
            .iter()
            .map(|s| s.triangle())
            .filter(|&t| is_paired[t])
            .collect();
        let others = group.len() - paired.len();
        (paired, others)
    };
    for (_, group) in edges.groups() {
        let (paired, _) = split(group);
        for pair in paired.windows(2) {
            sheets.join(pair[0] as u32, pair[1] as u32);
        }
    }
    let mut votes = vec![0_i64; triangles.len()];
    for (_, group) in edges.groups() {
        let (paired, others) = split(group);
        let vote = match others {
            0 => continue,
            1 => 1,
            _ => -1,
        };
        for t in paired {
            votes[sheets.find(t as u32) as usize] += vote;
        }
    }
    (0..triangles.len())
        .map(|t| !is_paired[t] || votes[sheets.find(t as u32) as usize] >= 0)
        .collect()
}
