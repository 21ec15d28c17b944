//! Connected components of the nodes over uncut edges `[G12 §6.1-6.2]`, kept from look to look.
//!
//! Cuts only part. So a look asks of each new cut whether its ends still hang together: the ends of the new cuts and the nodes around them form
//! *sides*, which are joined wherever an uncut edge joins them, and mostly one side is left, since the two sides of a growing crack hang together
//! around its rim. Where several sides are left of a component, each goes on to the nodes beyond, the side that has looked at least first. Sides that
//! meet are one; a side that has nowhere to go has parted and becomes a component. The last side keeps the component, and is not searched further, so that
//! a parting costs as much as the smaller sides. A patch of nodes that no cut touches hangs together, so a side takes all of it at once.
//!
//! Volumes of nodes are whole numbers, so the volume of what is left is exact.

mod search;

use crate::asset::{NOBODY, Portion};
use crate::body::MeshIndex;
use crate::state::Cuts;
use search::Search;

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
