//! Lists of the nodes, tetrahedra, cuts and cracks that belong to a piece.

use crate::asset::FOREIGN;
use crate::body::Body;
use crate::fragment::Breakup;
use crate::mesh::{DisjointSets, EDGES};
use crate::state::{BodyState, EdgeCut, OldCrack};

/// Lists of a portion.
#[derive(Default)]
pub(super) struct Lists {
    pub(super) nodes: Vec<u32>,
    pub(super) tets: Vec<u32>,
    pub(super) cracked: Vec<u32>,
    pub(super) divided: Vec<u32>,
    pub(super) rim: Vec<(u32, u32)>,
    pub(super) next_foreign: u32,
    pub(super) cuts: Vec<EdgeCut>,
    pub(super) first_nodes: Vec<u32>,
    pub(super) state: BodyState,
}

impl Lists {
    /// The lists of the pieces with these labels.
    pub(super) fn of(body: &Body, breakup: &Breakup, labels: &[u32]) -> Vec<Self> {
        let mesh = &body.asset.fracture;
        let count = breakup.of_node.iter().filter(|&&l| l < FOREIGN).max();
        let count = count.map_or(0, |&l| l + 1);
        let mut slots = vec![usize::MAX; count as usize];
        for (slot, &label) in labels.iter().enumerate() {
            slots[label as usize] = slot;
        }
        let slot_of = |label: u32| slots.get(label as usize).copied().unwrap_or(usize::MAX);
        let mut lists: Vec<Self> = labels.iter().map(|_| Self::default()).collect();
        // Place of each node among its piece's.
        let mut places = vec![0; breakup.of_node.len()];
        for (v, &label) in (0..).zip(&breakup.of_node) {
            if let Some(list) = lists.get_mut(slot_of(label)) {
                places[v as usize] = list.nodes.len() as u32;
                list.nodes.push(v);
            }
        }
        let mut fractured = vec![false; mesh.tets.len()];
        let cracks = breakup.state.cracks.iter();
        for cut in cracks.flat_map(|crack| &crack.cuts) {
            fractured[cut.tet as usize] = true;
        }
        let label = |v: u32| breakup.of_node[v as usize];
        for (e, tet) in mesh.tets.iter().enumerate() {
            let l = tet.map(label);
            let whole = l == [l[0]; 4];
            for k in 0..if whole { 1 } else { 4 } {
                if l[..k].contains(&l[k]) {
                    continue;
                }
                if let Some(list) = lists.get_mut(slot_of(l[k])) {
                    match (whole, fractured[e]) {
                        (true, false) => list.tets.push(e as u32),
                        (true, true) => list.cracked.push(e as u32),
                        (false, _) => list.divided.push(e as u32),
                    }
                }
            }
        }
        let base = body.asset.portion.as_ref().map_or(0, |p| p.next_foreign);
        for (list, &own) in lists.iter_mut().zip(labels) {
            list.next_foreign = base + count;
            list.complete(body, breakup, &places, own, base);
        }
        lists
    }

    /// Fills in what follows from nodes and tetrahedra.
    fn complete(&mut self, body: &Body, breakup: &Breakup, places: &[u32], own: u32, base: u32) {
        let mesh = &body.asset.fracture;
        let label = |v: u32| breakup.of_node[v as usize];
        let mut numbers: Vec<u32> = Vec::new();
        for &e in &self.divided {
            let tet = mesh.tets[e as usize];
            for v in tet {
                match label(v) {
                    l if l == own => {}
                    l if l < FOREIGN => self.rim.push((v, FOREIGN | (base + l))),
                    l => self.rim.push((v, l)),
                }
            }
            for [i, j] in EDGES {
                let (a, b) = (tet[i].min(tet[j]), tet[i].max(tet[j]));
                numbers.extend(breakup.cuts.place(a, b));
            }
        }
        self.rim.sort_unstable();
        self.rim.dedup();
        for (number, cut) in (0..).zip(breakup.cuts.list()) {
            if cut.ends.map(label) == [own; 2] {
                numbers.push(number);
            }
        }
        numbers.sort_unstable();
        numbers.dedup();
        let local = |v: u32| (label(v) == own).then(|| places[v as usize]);
        let healed = self.heal(body, breakup, local);
        let keep = |cut: &EdgeCut| cut.ends.map(label) != [own; 2] || !healed.contains(&cut.ends);
        let cuts = numbers.iter().map(|&n| breakup.cuts.list()[n as usize]);
        self.cuts = cuts.filter(keep).collect();
        self.remember(breakup, |tet| {
            mesh.tets[tet as usize].map(label).contains(&own)
        });
    }

    /// Joins crumbs to this piece for good: returns the cuts between them and the rest, which are none any more.
    /// Finds the parts that are still loose, too.
    fn heal(
        &mut self,
        body: &Body,
        breakup: &Breakup,
        local: impl Fn(u32) -> Option<u32>,
    ) -> Vec<[u32; 2]> {
        let index = &body.root().index;
        let mut sets = DisjointSets::new(self.nodes.len());
        for (i, &v) in (0..).zip(&self.nodes) {
            for &w in index.neighbours(v).iter().filter(|&&w| w < v) {
                if let Some(j) = local(w)
                    && breakup.cuts.place(w, v).is_none()
                {
                    sets.join(i, j);
                }
            }
        }
        let mut healed = Vec::new();
        for cut in breakup.cuts.list() {
            if let [Some(a), Some(b)] = cut.ends.map(&local)
                && sets.find(a) != sets.find(b)
            {
                healed.push((cut.ends, [a, b]));
            }
        }
        for &(_, [a, b]) in &healed {
            sets.join(a, b);
        }
        let mut first = Vec::new();
        for (i, &v) in (0..).zip(&self.nodes) {
            if sets.find(i) == i {
                first.push(v);
            }
        }
        self.first_nodes = first;
        healed.into_iter().map(|(ends, _)| ends).collect()
    }

    /// Keeps those cuts of each crack that cut this piece; cuts name their cracks by the new numbers.
    fn remember(&mut self, breakup: &Breakup, own: impl Fn(u32) -> bool) {
        let mut number = vec![EdgeCut::FORGOTTEN; breakup.state.cracks.len()];
        for (crack, number) in breakup.state.cracks.iter().zip(&mut number) {
            let cuts: Vec<_> = crack.cuts.iter().filter(|c| own(c.tet)).copied().collect();
            if cuts.is_empty() {
                continue;
            }
            *number = self.state.cracks.len() as u32;
            self.state.cracks.push(OldCrack {
                start: crack.start,
                origin: crack.origin,
                normal: crack.normal,
                settled: cuts.len() as u32,
                cuts,
                junctions: Vec::new(),
            });
        }
        for cut in &mut self.cuts {
            let crack = number.get(cut.crack as usize);
            cut.crack = crack.copied().unwrap_or(EdgeCut::FORGOTTEN);
        }
    }
}
