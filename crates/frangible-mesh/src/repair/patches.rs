//! Parts that hang together, each wound one way.

use super::edges::{Edges, Side};

const NONE: u32 = u32::MAX;

/// The parts of a surface that are connected across edges of two triangles.
pub(super) struct Patches {
    /// Part of each triangle.
    pub(super) of: Vec<u32>,
    /// For each triangle, true if it has to be turned for its part to be wound one way.
    pub(super) is_flipped: Vec<bool>,
    /// For each part, true if it has no consistent winding.
    pub(super) is_one_sided: Vec<bool>,
    /// For each part, true if it is bounded by nothing.
    pub(super) is_closed: Vec<bool>,
}

impl Patches {
    /// Winds each part as most of its triangles are.
    pub(super) fn new(count: usize, edges: &Edges) -> Self {
        let links = links(count, edges);
        let mut patches = Self {
            of: vec![NONE; count],
            is_flipped: vec![false; count],
            is_one_sided: Vec::new(),
            is_closed: Vec::new(),
        };
        let mut members: Vec<u32> = Vec::new();
        for seed in 0..count {
            if patches.of[seed] == NONE {
                members.clear();
                patches.grow(seed, &links, &mut members);
            }
        }
        patches.is_closed = vec![true; patches.is_one_sided.len()];
        let mut signs = Vec::new();
        for (_, group) in edges.groups() {
            patches.open_unbalanced(group, &mut signs);
        }
        patches
    }

    fn grow(&mut self, seed: usize, links: &[[u32; 3]], members: &mut Vec<u32>) {
        let patch = self.is_one_sided.len() as u32;
        let mut is_one_sided = false;
        let mut turned = 0;
        self.of[seed] = patch;
        members.push(seed as u32);
        let mut next = 0;
        while let Some(&t) = members.get(next) {
            next += 1;
            let flipped = self.is_flipped[t as usize];
            turned += usize::from(flipped);
            for &link in links[t as usize].iter().filter(|&&link| link != NONE) {
                let other = (link >> 1) as usize;
                let wanted = flipped ^ (link & 1 == 1);
                if self.of[other] == NONE {
                    self.of[other] = patch;
                    self.is_flipped[other] = wanted;
                    members.push(other as u32);
                } else {
                    is_one_sided |= self.is_flipped[other] != wanted;
                }
            }
        }
        if 2 * turned > members.len() {
            for &t in members.iter() {
                self.is_flipped[t as usize] ^= true;
            }
        }
        self.is_one_sided.push(is_one_sided);
    }

    /// A part is closed where as many of its triangles run along the edge as against it.
    fn open_unbalanced(&mut self, group: &[Side], signs: &mut Vec<(u32, i32)>) {
        signs.clear();
        signs.extend(group.iter().map(|side| {
            let t = side.triangle();
            let is_forward = side.is_forward() ^ self.is_flipped[t];
            (self.of[t], if is_forward { 1 } else { -1 })
        }));
        signs.sort_unstable();
        for part in signs.chunk_by(|a, b| a.0 == b.0) {
            if part.iter().map(|(_, sign)| sign).sum::<i32>() != 0 {
                self.is_closed[part[0].0 as usize] = false;
            }
        }
    }
}

/// For each triangle its neighbours across edges of two triangles: twice the neighbour, plus one if wound against it.
fn links(count: usize, edges: &Edges) -> Vec<[u32; 3]> {
    let mut links = vec![[NONE; 3]; count];
    for (_, group) in edges.groups() {
        let &[a, b] = group else { continue };
        let against = u32::from(a.is_forward() == b.is_forward());
        for (from, to) in [(a, b), (b, a)] {
            if let Some(slot) = links[from.triangle()]
                .iter_mut()
                .find(|slot| **slot == NONE)
            {
                *slot = 2 * to.triangle() as u32 + against;
            }
        }
    }
    links
}
