//! Connected components of the nodes over uncut edges `[G12 §6.1-6.2]`, at the cost of the smaller sides.
//!
//! Every component has a node beside a cut (or is a part of the mesh that was never joined to the rest). So the search
//! starts there, from all sides of the cuts at once, the side that has seen least going on. Sides that meet are one;
//! a side that has nowhere to go is a component. When one side is left, it has all that nobody has seen: it is
//! not searched further, and its volume is what the others leave of the whole. A patch of nodes that no cut touches hangs together, so a side
//! takes all of it at once and goes on from the nodes around it.
//!
//! Volumes of nodes are whole numbers, so the volume of the rest is exact.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::asset::{NOBODY, Portion};
use crate::body::MeshIndex;
use crate::mesh::DisjointSets;
use crate::state::{Cuts, EdgeCut};

/// Nodes that a side looks at before it is asked again whether it has seen least.
const TURN: u32 = 32;

/// Mark in place of a side: a node beside a cut that belongs to another piece.
const OUTSIDE: u32 = u32::MAX;

/// Flag in a list of nodes to look at: the other bits are the number of a patch.
const PATCH: u32 = 1 << 31;

/// A connected component.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Component {
    /// Its lowest node.
    pub(super) lowest: u32,
    /// Sum of [`MeshIndex::volumes`] of its nodes.
    pub(super) volume: u64,
}

/// The components, and the nodes of each.
pub(super) struct Components {
    /// The components, ordered by their lowest node.
    pub(super) list: Vec<Component>,
    /// Component of all nodes that were not seen.
    pub(super) rest: u32,
    /// Nodes that were seen.
    seen: Vec<u32>,
    /// Side plus one that saw each node, 0 for none.
    side_of_node: Vec<u32>,
    /// Component of each side.
    of_side: Vec<u32>,
}

impl Components {
    /// The components of the whole body, or of a portion of it, which cuts part from the rest.
    /// `cut_by`: [the crack that has cut each edge](MeshIndex::cut_by).
    pub(super) fn of(
        cuts: &Cuts,
        cut_by: &[u32],
        index: &MeshIndex,
        portion: Option<&Portion>,
    ) -> Self {
        let mut search = Search::new(cuts, cut_by, index, portion);
        search.run();
        search.finish()
    }

    /// Returns true if a node beside a cut belongs to another piece.
    pub(super) fn is_outside(&self, node: u32) -> bool {
        self.side_of_node[node as usize] == OUTSIDE
    }

    /// Component of a node that is not outside.
    pub(super) fn of_node(&self, node: u32) -> u32 {
        match self.side_of_node[node as usize] {
            0 => self.rest,
            side => self.of_side[side as usize - 1],
        }
    }

    /// Number of nodes that were seen.
    #[cfg(test)]
    pub(super) fn cost(&self) -> usize {
        self.seen.len()
    }

    /// A number for every node, given that of every component; those of a portion's neighbours keep the portion's labels.
    pub(super) fn spread(&self, number: &[u32], portion: Option<&Portion>) -> Vec<u32> {
        let rest = number[self.rest as usize];
        let mut of_node;
        match portion {
            None => of_node = vec![rest; self.side_of_node.len()],
            Some(portion) => {
                of_node = vec![NOBODY; self.side_of_node.len()];
                for &v in portion.nodes() {
                    of_node[v as usize] = rest;
                }
                for &(v, label) in portion.rim() {
                    of_node[v as usize] = label;
                }
            }
        }
        for &v in &self.seen {
            of_node[v as usize] = number[self.of_node(v) as usize];
        }
        of_node
    }
}

/// Nodes seen from one place beside the cuts.
#[derive(Clone, Debug)]
struct Side {
    /// Nodes and [patches](PATCH) seen and not looked at, from `next` on.
    waiting: Vec<u32>,
    next: usize,
    /// Number of nodes that were looked at.
    looked_at: u32,
    lowest: u32,
    volume: u64,
}

struct Search<'a> {
    cuts: &'a Cuts,
    index: &'a MeshIndex,
    portion: Option<&'a Portion>,
    side_of_node: Vec<u32>,
    seen: Vec<u32>,
    /// True for patches in which a side starts: their nodes are looked at one by one.
    is_started: Vec<bool>,
    sides: Vec<Side>,
    /// Sides that have met.
    sets: DisjointSets,
    /// Sides that may still go on, met ones counted once.
    going: usize,
}

impl<'a> Search<'a> {
    /// The sides: nodes with a cut edge, joined where an uncut edge joins them, and a node of each part of the mesh.
    fn new(
        cuts: &'a Cuts,
        cut_by: &[u32],
        index: &'a MeshIndex,
        portion: Option<&'a Portion>,
    ) -> Self {
        let mut side_of_node = vec![0_u32; index.nodes()];
        let mut starts = cuts.nodes().to_vec();
        // So that their neighbours are read one behind another.
        starts.sort_unstable();
        if let Some(portion) = portion {
            starts.retain(|&v| {
                let within = portion.has_node(v);
                if !within {
                    side_of_node[v as usize] = OUTSIDE;
                }
                within
            });
        }
        let first_nodes = portion.map_or(&index.first_nodes[..], |p| p.first_nodes());
        if first_nodes.len() > 1 {
            let untouched = first_nodes.iter().filter(|&&v| !cuts.touches(v));
            starts.extend(untouched);
        }
        let mut is_started = vec![false; index.patches.count()];
        for (place, &v) in (1..).zip(&starts) {
            side_of_node[v as usize] = place;
            is_started[index.patches.of_node(v) as usize] = true;
        }
        let mut sets = DisjointSets::new(starts.len());
        for &v in starts.iter().filter(|&&v| cuts.touches(v)) {
            for (w, edge) in index.edges_from(v) {
                let within = cuts.touches(w) && side_of_node[w as usize] != OUTSIDE;
                if within && cut_by[edge as usize] == EdgeCut::WHOLE {
                    sets.join(side_of_node[v as usize] - 1, side_of_node[w as usize] - 1);
                }
            }
        }
        let mut search = Self {
            cuts,
            index,
            portion,
            side_of_node,
            is_started,
            sets: DisjointSets::new(0),
            sides: Vec::new(),
            going: 0,
            seen: starts,
        };
        search.gather(&mut sets);
        search
    }

    /// A side for every set of starts.
    fn gather(&mut self, sets: &mut DisjointSets) {
        let mut side_of_set = vec![u32::MAX; self.seen.len()];
        for (place, &v) in self.seen.iter().enumerate() {
            let side = &mut side_of_set[sets.find(place as u32) as usize];
            if *side == u32::MAX {
                *side = self.sides.len() as u32;
                self.sides.push(Side::default());
            }
            self.side_of_node[v as usize] = *side + 1;
            self.sides[*side as usize].add(v, self.index);
        }
        self.sets = DisjointSets::new(self.sides.len());
        self.going = self.sides.len();
    }

    fn run(&mut self) {
        let mut order: BinaryHeap<Reverse<(u32, u32)>> = (0..self.sides.len() as u32)
            .map(|side| Reverse((0, side)))
            .collect();
        while self.going > 1 {
            let Some(Reverse((looked_at, side))) = order.pop() else {
                break;
            };
            // Entries of sides that have met another, or have gone on since, are out of date.
            if self.sets.find(side) != side || self.sides[side as usize].looked_at != looked_at {
                continue;
            }
            let side = self.turn(side);
            let s = &self.sides[side as usize];
            if s.next < s.waiting.len() {
                order.push(Reverse((s.looked_at, side)));
            } else {
                self.going -= 1;
            }
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
            let (beside, is_cut, nodes) = if at & PATCH == 0 {
                (index.neighbours.of(at), self.cuts.touches(at), 1)
            } else {
                let patch = at & !PATCH;
                let nodes = index.patches.nodes(patch).len();
                (index.patches.rim(patch), false, nodes as u32)
            };
            s.looked_at += nodes;
            left = left.saturating_sub(nodes);
            for &w in beside {
                match self.side_of_node[w as usize] {
                    // Not beside a cut, or it would be a start: the edge is whole.
                    0 => self.see(w, side),
                    OUTSIDE => {}
                    // Between two starts an uncut edge has joined them already.
                    _ if is_cut && self.cuts.touches(w) => {}
                    other => side = self.meet(side, other - 1),
                }
            }
        }
        side
    }

    /// Gives a side a node that nobody has seen, and with it the whole patch where no side starts in that.
    #[inline]
    fn see(&mut self, node: u32, side: u32) {
        let index = self.index;
        let patch = index.patches.of_node(node);
        let own = &mut self.sides[side as usize];
        if self.is_started[patch as usize] {
            self.side_of_node[node as usize] = side + 1;
            self.seen.push(node);
            own.add(node, index);
            return;
        }
        let nodes = index.patches.nodes(patch);
        for &v in nodes {
            self.side_of_node[v as usize] = side + 1;
        }
        self.seen.extend_from_slice(nodes);
        own.lowest = own.lowest.min(nodes[0]);
        own.volume += index.volume_of(nodes);
        own.waiting.push(PATCH | patch);
    }

    fn meet(&mut self, a: u32, b: u32) -> u32 {
        let b = self.sets.find(b);
        if a == b {
            return a;
        }
        // The lower one stays.
        let side = self.sets.join(a, b);
        let gone = std::mem::take(&mut self.sides[a.max(b) as usize]);
        self.sides[side as usize].take(gone);
        self.going -= 1;
        side
    }

    fn finish(mut self) -> Components {
        let ends: Vec<u32> = (0..self.sides.len() as u32)
            .filter(|&side| self.sets.find(side) == side)
            .collect();
        let unfinished = ends.iter().copied().find(|&side| {
            let s = &self.sides[side as usize];
            s.next < s.waiting.len()
        });
        if let Some(rest) = unfinished {
            self.complete(rest, &ends);
        }
        let mut order = ends;
        order.sort_unstable_by_key(|&side| self.sides[side as usize].lowest);
        let component = |&side: &u32| {
            let Side { lowest, volume, .. } = self.sides[side as usize];
            Component { lowest, volume }
        };
        let mut list: Vec<Component> = order.iter().map(component).collect();
        if list.is_empty() {
            list.push(Component {
                lowest: 0,
                volume: self.whole(),
            });
        }
        let mut component_of_end = vec![0; self.sides.len()];
        for (component, &side) in order.iter().enumerate() {
            component_of_end[side as usize] = component as u32;
        }
        let of_side: Vec<u32> = (0..self.sides.len() as u32)
            .map(|side| component_of_end[self.sets.find(side) as usize])
            .collect();
        let rest = unfinished.map_or(0, |side| component_of_end[side as usize]);
        Components {
            list,
            rest,
            seen: self.seen,
            side_of_node: self.side_of_node,
            of_side,
        }
    }

    /// Gives a side all that nobody has seen.
    fn complete(&mut self, rest: u32, ends: &[u32]) {
        let others = ends.iter().filter(|&&side| side != rest);
        let elsewhere: u64 = others.map(|&s| self.sides[s as usize].volume).sum();
        let sides = &self.side_of_node;
        let sets = &mut self.sets;
        let mut is_rest = |v: &u32| match sides[*v as usize] {
            0 => true,
            side => sets.find(side - 1) == rest,
        };
        let lowest = match self.portion {
            Some(portion) => portion.nodes().iter().copied().find(is_rest),
            None => (0..self.index.nodes() as u32).find(&mut is_rest),
        };
        let whole = self.whole();
        let side = &mut self.sides[rest as usize];
        side.volume = whole - elsewhere;
        side.lowest = lowest.unwrap_or(0);
    }

    /// Volume of all nodes that there are.
    fn whole(&self) -> u64 {
        self.portion
            .map_or(self.index.whole, |portion| portion.whole())
    }
}

impl Default for Side {
    fn default() -> Self {
        Self {
            waiting: Vec::new(),
            next: 0,
            looked_at: 0,
            lowest: u32::MAX,
            volume: 0,
        }
    }
}

impl Side {
    fn add(&mut self, node: u32, index: &MeshIndex) {
        self.waiting.push(node);
        self.lowest = self.lowest.min(node);
        self.volume += index.volumes[node as usize];
    }

    fn take(&mut self, mut other: Self) {
        if other.waiting.len() - other.next > self.waiting.len() - self.next {
            std::mem::swap(&mut self.waiting, &mut other.waiting);
            std::mem::swap(&mut self.next, &mut other.next);
        }
        self.waiting.extend_from_slice(&other.waiting[other.next..]);
        self.looked_at += other.looked_at;
        self.lowest = self.lowest.min(other.lowest);
        self.volume += other.volume;
    }
}
