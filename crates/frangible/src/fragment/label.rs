//! Labels: fragments are the connected components of nodes over uncut edges `[G12 §6.1-6.2]`.

use super::components::{Component, Components};
use super::junction::{Ends, end_cracks};
use crate::asset::Portion;
use crate::body::MeshIndex;
use crate::crack::{CrackSystem, Known};
use crate::mesh::DisjointSets;
use crate::state::Cuts;

/// A fragment number for every node.
#[derive(Debug)]
pub(crate) struct Labels {
    /// Fragment of each node, 0 the largest.
    pub(crate) of_node: Vec<u32>,
    /// Number of fragments.
    pub(crate) count: usize,
    /// Cut edges; an edge between two fragments is always one of them.
    pub(crate) cuts: Cuts,
    /// State that the next look goes on from.
    pub(crate) known: Known,
    /// True if something has parted between the last two looks.
    pub(crate) has_parted: bool,
    pub(super) ends: Ends,
    pub(super) components: Components,
}

/// Cuts, flood fill, crumbs: components smaller than `crumb_share` of the volume of the body as it was baked join the
/// neighbour they share most with. `before`: the labels of an earlier look at the same cracks, whose cuts stay.
pub(crate) fn label(
    system: &CrackSystem,
    index: &MeshIndex,
    crumb_share: f64,
    before: Option<Labels>,
) -> Labels {
    let mut labels = before.unwrap_or_else(|| {
        let (cuts, known) = Cuts::settled(system, index);
        Labels::new(cuts, known)
    });
    let Labels {
        cuts, known, ends, ..
    } = &mut labels;
    cuts.follow(system, index, known);
    if !system.config.is_paper() {
        end_cracks(system, index, cuts, known, ends);
    }
    let portion = system.asset.portion.as_deref();
    labels.follow(&system.asset.fracture.tets, index, portion, crumb_share);
    labels
}

impl Labels {
    /// Labels that have not [followed](Self::follow) these cuts yet.
    pub(super) fn new(cuts: Cuts, known: Known) -> Self {
        Self {
            of_node: Vec::new(),
            count: 0,
            cuts,
            known,
            has_parted: false,
            ends: Ends::default(),
            components: Components::default(),
        }
    }

    /// The labels that the cuts leave, of the whole body or of a portion of it. Nodes of other pieces have labels from
    /// [`FOREIGN`](crate::asset::FOREIGN) on.
    pub(super) fn follow(
        &mut self,
        tets: &[[u32; 4]],
        index: &MeshIndex,
        portion: Option<&Portion>,
        crumb_share: f64,
    ) {
        let components = &mut self.components;
        self.has_parted = components.follow(&self.cuts, &self.known.cut_by, index, portion);
        if !self.has_parted && self.count > 0 {
            return;
        }
        let list = components.list();
        let (number, count) = match list.len() {
            1 => (vec![0], 1),
            _ => {
                let joined = absorb_crumbs(&list, components, &self.cuts, tets, index, crumb_share);
                number(&list, &joined)
            }
        };
        self.of_node = components.spread(&number, portion);
        self.count = count;
    }
}

/// A place where two components meet: the two, and the number of pairs of a tetrahedron and its edge that run from one to the other.
type Meeting = (u32, u32, u32);

/// The component that each component is part of after crumbs have joined a neighbour: the lowest of them.
fn absorb_crumbs(
    list: &[Component],
    components: &Components,
    cuts: &Cuts,
    tets: &[[u32; 4]],
    index: &MeshIndex,
    crumb_share: f64,
) -> Vec<u32> {
    let count = list.len();
    let limit = crumb_share * index.whole as f64;
    let crumb = |volume: u64| (volume as f64) < limit;
    let mut sets = DisjointSets::new(count);
    let mut root: Vec<u32> = (0..count as u32).collect();
    if !list.iter().any(|c| crumb(c.volume)) {
        return root;
    }
    let is_crumb: Vec<bool> = list.iter().map(|c| crumb(c.volume)).collect();
    let meetings = meetings(components, cuts, tets, index, &is_crumb);
    // Each pass joins every crumb to its best neighbour; a crumb among crumbs needs several.
    for _ in 0..16 {
        let mut volume = vec![0_u64; count];
        for (component, &r) in list.iter().zip(&root) {
            volume[r as usize] += component.volume;
        }
        let mut contacts: Vec<Meeting> = Vec::new();
        for &(a, b, pairs) in &meetings {
            let (a, b) = (root[a as usize], root[b as usize]);
            for (a, b) in [(a, b), (b, a)] {
                if a != b && crumb(volume[a as usize]) {
                    contacts.push((a, b, pairs));
                }
            }
        }
        if contacts.is_empty() {
            break;
        }
        for (a, b) in best_neighbours(contacts) {
            sets.join(a, b);
        }
        for r in &mut root {
            *r = sets.find(*r);
        }
    }
    root
}

/// Meetings of crumbs with other components.
fn meetings(
    components: &Components,
    cuts: &Cuts,
    tets: &[[u32; 4]],
    index: &MeshIndex,
    is_crumb: &[bool],
) -> Vec<Meeting> {
    let mut meetings = Vec::new();
    for cut in cuts.list() {
        let [low, high] = cut.ends;
        if components.is_outside(low) || components.is_outside(high) {
            continue;
        }
        let (a, b) = (components.of_node(low), components.of_node(high));
        if a != b && (is_crumb[a as usize] || is_crumb[b as usize]) {
            let around = index.tets.of(low).iter();
            let pairs = around.filter(|&&e| tets[e as usize].contains(&high));
            meetings.push((a, b, pairs.count() as u32));
        }
    }
    meetings
}

/// For each first component the one it shares most with, the lowest of equals.
fn best_neighbours(mut contacts: Vec<Meeting>) -> Vec<(u32, u32)> {
    contacts.sort_unstable();
    let mut best: Vec<Meeting> = Vec::new();
    for group in contacts.chunk_by(|x, y| (x.0, x.1) == (y.0, y.1)) {
        let (a, b, _) = group[0];
        let pairs = group.iter().map(|c| c.2).sum();
        match best.last_mut().filter(|last| last.0 == a) {
            None => best.push((a, b, pairs)),
            Some(last) if pairs > last.2 => *last = (a, b, pairs),
            Some(_) => {}
        }
    }
    best.into_iter().map(|(a, b, _)| (a, b)).collect()
}

/// Numbers the components by falling volume, then by lowest node; returns the number of labels, too.
fn number(list: &[Component], root: &[u32]) -> (Vec<u32>, usize) {
    let mut volume = vec![0_u64; list.len()];
    for (component, &r) in list.iter().zip(root) {
        volume[r as usize] += component.volume;
    }
    let roots = 0..list.len() as u32;
    let mut order: Vec<u32> = roots.filter(|&r| root[r as usize] == r).collect();
    // Components are listed by rising lowest node.
    order.sort_by_key(|&r| (std::cmp::Reverse(volume[r as usize]), r));
    let mut label = vec![0; list.len()];
    for (i, &r) in order.iter().enumerate() {
        label[r as usize] = i as u32;
    }
    (
        root.iter().map(|&r| label[r as usize]).collect(),
        order.len(),
    )
}
