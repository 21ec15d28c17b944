//! Connected components of the nodes over uncut edges `[G12 §6.1-6.2]`, kept from look to look.
//!
//! Cuts only part. So a look asks of each new cut whether its ends still hang together: the ends of the new cuts and the nodes around them form
//! *sides*, which are joined wherever an uncut edge joins them, and mostly one side is left, since the two sides of a growing crack hang together
//! around its rim. Where several sides are left of a component, each goes on to the nodes beyond, the side that has looked at least first. Sides that
//! meet are one; a side that has nowhere to go has parted and becomes a component. The last side keeps the component, and is not searched further, so that
//! a parting costs as much as the smaller sides. A patch of nodes that no cut touches hangs together, so a side takes all of it at once.
//!
//! Volumes of nodes are whole numbers, so the volume of what is left is exact.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::asset::{NOBODY, Portion};
use crate::body::MeshIndex;
use crate::mesh::DisjointSets;
use crate::state::{Cuts, EdgeCut};

/// Nodes that a side looks at before it is asked again whether it has looked at least.
const TURN: u32 = 32;

/// Mark in place of a component: a node of another piece.
const OUTSIDE: u32 = u32::MAX;

/// A connected component.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Component {
    /// Its lowest node.
    pub(super) lowest: u32,
    /// Sum of [`MeshIndex::volumes`] of its nodes.
    pub(super) volume: u64,
}

/// The components, and the nodes of each.
#[derive(Debug, Default)]
pub(crate) struct Components {
    /// The components, in the order in which they have parted.
    list: Vec<Component>,
    /// Place of each component by its lowest node.
    rank: Vec<u32>,
    /// Component of each node, or [`OUTSIDE`].
    of_node: Vec<u32>,
    /// True for patches with a node beside a cut, or one from which a search has started: their nodes are looked at one by one.
    is_touched: Vec<bool>,
    /// Number of cuts that were looked at.
    looked_at: usize,
    /// Number of nodes beside cuts that were looked at.
    touched: usize,
    /// Side plus one that saw each [spot](Self::spot) in a look, 0 for none; all 0 between looks.
    side_of: Vec<u32>,
    /// Spots that were seen in the last look.
    seen: Vec<u32>,
}

impl Components {
    /// One component of all nodes of the body, or of a portion of it, which settled cuts part from the rest.
    fn whole(index: &MeshIndex, portion: Option<&Portion>) -> Self {
        let nodes = index.nodes();
        let mut of_node = vec![0; nodes];
        if let Some(portion) = portion {
            of_node.fill(OUTSIDE);
            for &v in portion.nodes() {
                of_node[v as usize] = 0;
            }
        }
        let lowest = portion.and_then(|portion| portion.nodes().first()).copied();
        let lowest = lowest.unwrap_or(0);
        let volume = portion.map_or(index.whole, |portion| portion.whole());
        Self {
            list: vec![Component { lowest, volume }],
            rank: vec![0],
            of_node,
            is_touched: vec![false; index.patches.count()],
            looked_at: 0,
            touched: 0,
            side_of: vec![0; nodes + index.patches.count()],
            seen: Vec::new(),
        }
    }

    /// Follows the cuts since the last look; returns true if something has parted. The first look is at the whole body, or at a portion
    /// of it. `cut_by`: [the crack that has cut each edge](MeshIndex::cut_by).
    pub(super) fn follow(
        &mut self,
        cuts: &Cuts,
        cut_by: &[u32],
        index: &MeshIndex,
        portion: Option<&Portion>,
    ) -> bool {
        let mut starts = Vec::new();
        if self.of_node.is_empty() {
            *self = Self::whole(index, portion);
            // Parts that no edge joins have parted before the first cut.
            let first_nodes = portion.map_or(&index.first_nodes[..], |p| p.first_nodes());
            if first_nodes.len() > 1 {
                starts.extend_from_slice(first_nodes);
            }
        }
        for &v in starts.iter().chain(&cuts.nodes()[self.touched..]) {
            self.is_touched[index.patches.of_node(v) as usize] = true;
        }
        self.touched = cuts.nodes().len();
        let new = &cuts.list()[self.looked_at..];
        self.looked_at = cuts.list().len();
        starts.extend(new.iter().flat_map(|cut| cut.ends));
        starts.retain(|&v| self.of_node[v as usize] != OUTSIDE);
        // So that their neighbours are read one behind another.
        starts.sort_unstable();
        starts.dedup();
        let count = self.list.len();
        let mut search = Search::new(self, cut_by, index, starts);
        search.run();
        search.finish();
        self.list.len() > count
    }

    /// The components, by rising lowest node.
    pub(super) fn list(&self) -> Vec<Component> {
        let mut list = self.list.clone();
        list.sort_unstable_by_key(|component| component.lowest);
        list
    }

    /// Returns true if a node belongs to another piece.
    pub(super) fn is_outside(&self, node: u32) -> bool {
        self.of_node[node as usize] == OUTSIDE
    }

    /// Component of a node that is not outside, as a place in [`Components::list`].
    pub(super) fn of_node(&self, node: u32) -> u32 {
        self.rank[self.of_node[node as usize] as usize]
    }

    /// Spot that a search sees where it sees a node: the node itself, or the whole patch if no cut touches that. Patches are numbered after the nodes.
    #[inline]
    fn spot(&self, node: u32, index: &MeshIndex) -> u32 {
        let patch = index.patches.of_node(node);
        match self.is_touched[patch as usize] {
            true => node,
            false => index.nodes() as u32 + patch,
        }
    }

    /// Number of spots that were seen in the last look.
    #[cfg(test)]
    pub(super) fn cost(&self) -> usize {
        self.seen.len()
    }

    /// A number for every node, given that of every component; those of a portion's neighbours keep the portion's labels.
    pub(super) fn spread(&self, number: &[u32], portion: Option<&Portion>) -> Vec<u32> {
        let numbers: Vec<u32> = self
            .rank
            .iter()
            .map(|&rank| number[rank as usize])
            .collect();
        let number = |&component: &u32| numbers.get(component as usize).copied().unwrap_or(NOBODY);
        let mut of_node: Vec<u32> = self.of_node.iter().map(number).collect();
        for &(v, label) in portion.map_or(&[][..], |portion| portion.rim()) {
            of_node[v as usize] = label;
        }
        of_node
    }

    /// Adds the components that sides have parted from theirs; `parted` is the number of the new one for each node's side, if it has parted.
    fn part(&mut self, index: &MeshIndex, new: usize, mut parted: impl FnMut(u32) -> Option<u32>) {
        let before = self.list.len();
        let (lowest, volume) = (u32::MAX, 0);
        self.list.resize(before + new, Component { lowest, volume });
        for spot in &self.seen {
            let Some(number) = parted(self.side_of[*spot as usize] - 1) else {
                continue;
            };
            for &v in nodes_of(spot, index) {
                let own = std::mem::replace(&mut self.of_node[v as usize], before as u32 + number);
                let volume = index.volumes[v as usize];
                self.list[own as usize].volume -= volume;
                let component = &mut self.list[before + number as usize];
                component.lowest = component.lowest.min(v);
                component.volume += volume;
            }
        }
        for (component, number) in self.list[..before].iter_mut().zip(0..) {
            let mut from = component.lowest as usize..self.of_node.len();
            let lowest = from.find(|&v| self.of_node[v] == number);
            component.lowest = lowest.map_or(component.lowest, |lowest| lowest as u32);
        }
        let mut order: Vec<u32> = (0..self.list.len() as u32).collect();
        order.sort_unstable_by_key(|&c| self.list[c as usize].lowest);
        self.rank.resize(order.len(), 0);
        for (rank, component) in (0..).zip(order) {
            self.rank[component as usize] = rank;
        }
    }
}

/// Nodes of a [spot](Components::spot).
fn nodes_of<'a>(spot: &'a u32, index: &'a MeshIndex) -> &'a [u32] {
    match spot.checked_sub(index.nodes() as u32) {
        None => std::slice::from_ref(spot),
        Some(patch) => index.patches.nodes(patch),
    }
}

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

struct Search<'a> {
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
    fn new(
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

    fn run(&mut self) {
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
    fn finish(mut self) {
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
