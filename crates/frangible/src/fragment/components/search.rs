//! Search for the parts of components: sides of new cuts that hang together or have nowhere to go.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::Components;
use crate::body::MeshIndex;
use crate::mesh::DisjointSets;
use crate::state::EdgeCut;

/// Nodes that a side looks at before it is asked again whether it has looked at least.
const TURN: u32 = 32;

/// Nodes seen from one place beside new cuts.
#[derive(Clone, Debug, Default)]
struct Side {
    /// Component that it lies in.
    component: u32,
    /// [Spots](Components::spot) seen and not looked at, from `next` on.
    waiting: Vec<u32>,
    next: usize,
    /// Number of nodes that were looked at.
    looked_at: u32,
    has_parted: bool,
}

pub(super) struct Search<'a> {
    known: &'a mut Components,
    cut_by: &'a [u32],
    index: &'a MeshIndex,
    sides: Vec<Side>,
    /// Sides that have met.
    sets: DisjointSets,
    /// For each component, the sides that may still go on, met ones counted once.
    going: Vec<u32>,
}

impl<'a> Search<'a> {
    /// The sides: these nodes and those around them, joined where an uncut edge joins them.
    pub(super) fn new(
        known: &'a mut Components,
        cut_by: &'a [u32],
        index: &'a MeshIndex,
        starts: Vec<u32>,
    ) -> Self {
        let mut sets = DisjointSets::new(starts.len());
        for (place, &v) in (1..).zip(&starts) {
            known.side_of[v as usize] = place;
        }
        let going = vec![0; known.list.len()];
        let mut search = Self {
            known,
            cut_by,
            index,
            sides: Vec::new(),
            sets: DisjointSets::new(0),
            going,
        };
        // What the starts see, each with the start that saw it first.
        let mut beyond = Vec::new();
        search.known.seen.clone_from(&starts);
        for (place, &v) in (0..).zip(&starts) {
            for (w, edge) in index.around(v) {
                if search.parts(w, edge) {
                    continue;
                }
                let spot = search.known.spot(w, index);
                match search.known.side_of[spot as usize] {
                    0 => {
                        search.see(spot, place);
                        beyond.push((spot, place));
                    }
                    other => _ = sets.join(place, other - 1),
                }
            }
        }
        search.gather(&starts, &mut sets, beyond);
        search
    }

    /// A side for every set of starts, and what it has seen.
    fn gather(&mut self, starts: &[u32], sets: &mut DisjointSets, beyond: Vec<(u32, u32)>) {
        let mut side_of_set = vec![u32::MAX; starts.len()];
        let mut side_of_start = Vec::with_capacity(starts.len());
        for (place, &v) in (0..).zip(starts) {
            let side = &mut side_of_set[sets.find(place) as usize];
            if *side == u32::MAX {
                *side = self.sides.len() as u32;
                let component = self.known.of_node[v as usize];
                self.going[component as usize] += 1;
                self.sides.push(Side {
                    component,
                    ..Side::default()
                });
            }
            side_of_start.push(*side);
        }
        let known = &mut *self.known;
        for &spot in &known.seen {
            let side = &mut known.side_of[spot as usize];
            *side = side_of_start[*side as usize - 1] + 1;
        }
        for (spot, start) in beyond {
            let side = side_of_start[start as usize];
            self.sides[side as usize].waiting.push(spot);
        }
        self.sets = DisjointSets::new(self.sides.len());
    }

    /// Returns true if a cut parts a node from the one at the other end of an edge.
    #[inline]
    fn parts(&self, node: u32, edge: u32) -> bool {
        self.cut_by[edge as usize] != EdgeCut::WHOLE || self.known.is_outside(node)
    }

    pub(super) fn run(&mut self) {
        let mut left: u32 = self.going.iter().map(|going| going.saturating_sub(1)).sum();
        let sides = (0..).zip(&self.sides);
        let several = sides.filter(|(_, side)| self.going[side.component as usize] > 1);
        let mut order: BinaryHeap<Reverse<(u32, u32)>> =
            several.map(|(side, _)| Reverse((0, side))).collect();
        while left > 0 {
            let Some(Reverse((looked_at, side))) = order.pop() else {
                break;
            };
            let s = &self.sides[side as usize];
            let component = s.component as usize;
            // Entries of sides that have met another, or have gone on since, are out of date.
            if self.sets.find(side) != side
                || s.looked_at != looked_at
                || self.going[component] == 1
            {
                continue;
            }
            let before = self.going[component];
            let side = self.turn(side);
            let s = &mut self.sides[side as usize];
            if s.next < s.waiting.len() {
                order.push(Reverse((s.looked_at, side)));
            } else if self.going[component] > 1 {
                s.has_parted = true;
                self.going[component] -= 1;
            }
            left -= before - self.going[component];
        }
    }

    /// Lets a side look at some nodes; returns the one it is part of afterwards.
    fn turn(&mut self, mut side: u32) -> u32 {
        let mut left = TURN;
        while left > 0 {
            let s = &mut self.sides[side as usize];
            let Some(&at) = s.waiting.get(s.next) else {
                break;
            };
            s.next += 1;
            let index = self.index;
            match at.checked_sub(index.nodes() as u32) {
                None => {
                    s.looked_at += 1;
                    left -= 1;
                    for (w, edge) in index.around(at) {
                        if !self.parts(w, edge) {
                            side = self.reach(w, side);
                        }
                    }
                }
                Some(patch) => {
                    let nodes = index.patches.nodes(patch).len() as u32;
                    s.looked_at += nodes;
                    left = left.saturating_sub(nodes);
                    for &w in index.patches.rim(patch) {
                        side = self.reach(w, side);
                    }
                }
            }
        }
        side
    }

    /// Lets a side see a node; returns the one it is part of afterwards.
    #[inline]
    fn reach(&mut self, node: u32, side: u32) -> u32 {
        let spot = self.known.spot(node, self.index);
        match self.known.side_of[spot as usize] {
            0 => {
                self.see(spot, side);
                self.sides[side as usize].waiting.push(spot);
                side
            }
            other if other - 1 == side => side,
            other => self.meet(side, other - 1),
        }
    }

    /// Gives a side a spot that nobody has seen.
    #[inline]
    fn see(&mut self, spot: u32, side: u32) {
        self.known.side_of[spot as usize] = side + 1;
        self.known.seen.push(spot);
    }

    fn meet(&mut self, a: u32, b: u32) -> u32 {
        let b = self.sets.find(b);
        if a == b {
            return a;
        }
        // The lower one stays.
        let side = self.sets.join(a, b);
        let gone = std::mem::take(&mut self.sides[a.max(b) as usize]);
        let own = &mut self.sides[side as usize];
        own.take(gone);
        self.going[own.component as usize] -= 1;
        side
    }

    /// Makes components of the sides that have parted.
    pub(super) fn finish(mut self) {
        let mut new = 0;
        let numbers: Vec<Option<u32>> = (self.sides.iter())
            .map(|side| {
                let number = side.has_parted.then_some(new);
                new += u32::from(side.has_parted);
                number
            })
            .collect();
        if new > 0 {
            let sets = &mut self.sets;
            let parted = |side| numbers[sets.find(side) as usize];
            self.known.part(self.index, new as usize, parted);
        }
        for &spot in &self.known.seen {
            self.known.side_of[spot as usize] = 0;
        }
    }
}

impl Side {
    fn take(&mut self, mut other: Self) {
        if other.waiting.len() - other.next > self.waiting.len() - self.next {
            std::mem::swap(&mut self.waiting, &mut other.waiting);
            std::mem::swap(&mut self.next, &mut other.next);
        }
        self.waiting.extend_from_slice(&other.waiting[other.next..]);
        self.looked_at += other.looked_at;
    }
}
