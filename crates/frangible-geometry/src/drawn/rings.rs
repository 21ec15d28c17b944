//! Closed lines: borders of a fragment's share of a surface, and rims of its crack faces.

use glam::DVec3;

/// A closed line.
#[derive(Debug)]
pub(super) struct Ring {
    /// Its points in order, by number.
    pub(super) points: Vec<u32>,
    /// Number of its sides on the border of a hole.
    pub(super) on_hole: usize,
}

impl Ring {
    /// Returns true if all its sides are on the border of a hole.
    pub(super) fn is_hole(&self) -> bool {
        self.on_hole == self.points.len()
    }

    pub(super) fn places(&self, at: impl Fn(u32) -> DVec3) -> Vec<DVec3> {
        self.points.iter().map(|&v| at(v)).collect()
    }
}

/// Directed sides that are left where one and its reverse take each other away.
pub(super) fn open(sides: impl Iterator<Item = ([u32; 2], bool)>) -> Vec<([u32; 2], bool)> {
    // Both ends in one number are sorted faster than an array.
    let both = |low: u32, high: u32| u64::from(low) << 32 | u64::from(high);
    let mut sides: Vec<(u64, bool, bool)> = sides
        .filter(|([a, b], _)| a != b)
        .map(|([a, b], on_hole)| (both(a.min(b), a.max(b)), a < b, on_hole))
        .collect();
    sides.sort_unstable();
    let mut open = Vec::new();
    for same in sides.chunk_by(|x, y| x.0 == y.0) {
        let (ends, _, on_hole) = same[0];
        let [a, b] = [(ends >> 32) as u32, ends as u32];
        let forward = same.iter().filter(|side| side.1).count();
        let back = same.len() - forward;
        let left = |ends, count| std::iter::repeat_n((ends, on_hole), count);
        open.extend(left([a, b], forward.saturating_sub(back)));
        open.extend(left([b, a], back.saturating_sub(forward)));
    }
    open.sort_unstable();
    open
}

/// Rings of sorted sides, as many of which leave each point as lead to it. None passes a point twice: two that touch are two.
pub(super) fn rings(sides: &[([u32; 2], bool)]) -> Vec<Ring> {
    const NOT_IN_LINE: usize = usize::MAX;
    let leaving = |point| sides.partition_point(|side| side.0[0] < point);
    let mut used = vec![false; sides.len()];
    let mut rings = Vec::new();
    // Place in the line at hand of the point that each side leaves; kept at the first side of a point.
    let mut place = vec![NOT_IN_LINE; sides.len() + 1];
    for first in 0..sides.len() {
        // Points of the line, whether the side that leaves each is on a hole, and the first side of each.
        let mut line: Vec<(u32, bool, usize)> = Vec::new();
        let mut next = (!used[first]).then_some(first);
        let mut at = leaving(sides[first].0[0]);
        while let Some(side) = next {
            used[side] = true;
            let ([from, to], on_hole) = sides[side];
            place[at] = line.len();
            line.push((from, on_hole, at));
            at = leaving(to);
            if place[at] != NOT_IN_LINE {
                let ring = line.split_off(place[at]);
                for &(.., first) in &ring {
                    place[first] = NOT_IN_LINE;
                }
                rings.push(Ring {
                    on_hole: ring.iter().filter(|point| point.1).count(),
                    points: ring.into_iter().map(|point| point.0).collect(),
                });
            }
            let mut ahead = (at..sides.len()).take_while(|&side| sides[side].0[0] == to);
            next = ahead.find(|&side| !used[side]);
        }
        for (.., first) in line {
            place[first] = NOT_IN_LINE;
        }
    }
    rings
}
