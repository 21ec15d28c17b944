//! Outlines of a face: closed loops of the edges that only one of its triangles has.

use glam::DVec2;

/// Deviation of a vertex from a straight line that still counts as none, over the size of the face.
const STRAIGHT: f64 = 1e-7;

/// The loops of edges without an opposite one, each from its smallest vertex, the face on its left. None where loops meet at a vertex.
pub(super) fn loops(triangles: &[[u32; 3]], vertices: usize) -> Option<Vec<Vec<u32>>> {
    let edges = |t: &[u32; 3]| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]];
    let mut all: Vec<[u32; 2]> = triangles.iter().flat_map(edges).collect();
    all.sort_unstable();
    let mut next = vec![u32::MAX; vertices];
    for &[a, b] in &all {
        if all.binary_search(&[b, a]).is_err() {
            if next[a as usize] != u32::MAX {
                return None;
            }
            next[a as usize] = b;
        }
    }
    let mut found = Vec::new();
    for first in 0..vertices as u32 {
        let mut round = Vec::new();
        let mut at = first;
        while next[at as usize] != u32::MAX {
            round.push(at);
            at = std::mem::replace(&mut next[at as usize], u32::MAX);
        }
        if !round.is_empty() {
            if at != first {
                return None;
            }
            found.push(round);
        }
    }
    Some(found)
}

/// The corners of a loop: its vertices but those on a straight line between others.
pub(super) fn corners(places: &[DVec2], size: f64) -> Vec<DVec2> {
    let count = places.len();
    let at = |i: usize| places[i % count];
    // From a vertex that is a corner for sure.
    let far = |a: &usize, b: &usize| {
        at(*a)
            .x
            .total_cmp(&at(*b).x)
            .then(at(*a).y.total_cmp(&at(*b).y))
    };
    let first = (0..count).max_by(far).unwrap_or(0);
    let mut kept = vec![at(first)];
    let mut from = first;
    let mut to = first + 1;
    while to < first + count {
        let line = (at(to + 1) - at(from)).normalize_or_zero();
        let off = |i: usize| (at(i) - at(from)).perp_dot(line).abs() > STRAIGHT * size;
        if (from + 1..=to).any(off) {
            kept.push(at(to));
            from = to;
        }
        to += 1;
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_has_two_loops_and_a_square_four_corners() {
        // Two squares inside each other, and the frame between them.
        let at = |k: usize| [0, 1, 2, 3].map(|i| (4 * k + i) as u32);
        let (outer, inner) = (at(0), at(1));
        let frame: Vec<[u32; 3]> = (0..4)
            .flat_map(|i| {
                let j = (i + 1) % 4;
                [
                    [outer[i], outer[j], inner[j]],
                    [outer[i], inner[j], inner[i]],
                ]
            })
            .collect();
        let found = loops(&frame, 8).unwrap();
        assert_eq!(found, [vec![0, 1, 2, 3], vec![4, 7, 6, 5]]);
        // Two triangles that meet at a vertex.
        assert!(loops(&[[0, 1, 2], [0, 3, 4]], 5).is_none());
        let square = [
            [0.0, 0.0],
            [0.5, 0.0],
            [1.0, 0.0],
            [1.0, 1.0],
            [0.3, 1.0],
            [0.0, 1.0],
        ];
        let square = square.map(DVec2::from_array);
        assert_eq!(corners(&square, 1.0).len(), 4);
    }
}
