//! Groups of nodes of the fracture mesh that move together once pieces have parted.

use crate::asset::{Asset, FOREIGN};
use crate::body::MeshIndex;

/// Smallest share of the body's volume of pieces that move on their own. Smaller ones move with their parent group, unless a contact pushes them.
const SMALLEST: f64 = 2e-3;

/// Most pieces that move on their own.
const MOST: usize = 12;

/// Groups of nodes that move together.
#[derive(Clone, Debug)]
pub(crate) struct Groups {
    /// Group of each node of the fracture mesh; 0 is the reference.
    pub(super) of_node: Vec<u32>,
    /// For each group, the group that it was part of before.
    pub(super) parents: Vec<u32>,
}

impl Groups {
    /// Returns the group that continues group `before` of the last parting, if any does.
    pub(super) fn heir(&self, before: u32) -> Option<u32> {
        let heir = self.parents.iter().position(|&parent| parent == before);
        heir.map(|heir| heir as u32)
    }

    /// Returns the rest of the group that this one has just parted from; none if this one is that rest.
    pub(super) fn beside(&self, group: u32) -> Option<u32> {
        let heir = self.heir(self.parents[group as usize]);
        heir.filter(|&heir| heir != group)
    }

    /// Groups that these pieces make, none if no new one forms. Also, for each piece, false if it has parted but moves with its parent group.
    /// `piece_of_node` has labels from [`FOREIGN`] on for nodes of other bodies; `pushed` are the nodes under contacts.
    pub(crate) fn next(
        before: Option<&Self>,
        asset: &Asset,
        index: &MeshIndex,
        (piece_of_node, pieces): (&[u32], usize),
        pushed: &[u32],
    ) -> (Option<Self>, Vec<bool>) {
        let group_before = |node: usize| before.map_or(0, |groups| groups.of_node[node]);
        let count_before = before.map_or(1, |groups| groups.parents.len());
        let mut shares = vec![0_u64; pieces * count_before];
        for (node, &piece) in piece_of_node.iter().enumerate() {
            if piece < FOREIGN {
                let at = piece as usize * count_before + group_before(node) as usize;
                shares[at] += index.volumes[node];
            }
        }
        let rows: Vec<&[u64]> = shares.chunks_exact(count_before).collect();
        let volume = |piece: usize| rows[piece].iter().sum::<u64>();
        let first_largest = |values: &mut dyn Iterator<Item = (usize, u64)>| {
            values.reduce(|a, b| if b.1 > a.1 { b } else { a })
        };
        let parent = |piece: usize| {
            let row = rows[piece].iter().copied().enumerate();
            first_largest(&mut { row }).map_or(0, |(group, _)| group)
        };
        let parent_of: Vec<usize> = (0..pieces).map(parent).collect();
        let marked = |nodes: &[u32]| {
            let mut marks = vec![false; pieces];
            for &node in nodes {
                if let Some(mark) = marks.get_mut(piece_of_node[node as usize] as usize) {
                    *mark = true;
                }
            }
            marks
        };
        let (held, touched) = (marked(&asset.supported), marked(pushed));
        // The largest child continues its parent; the reference of a held body is continued by all that is still held.
        let heir = |group: usize| {
            if group == 0 && asset.is_supported() {
                return None;
            }
            let children = (0..pieces).filter(|&piece| parent_of[piece] == group);
            first_largest(&mut children.map(|piece| (piece, volume(piece)))).map(|(piece, _)| piece)
        };
        let heirs: Vec<Option<usize>> = (0..count_before).map(heir).collect();
        let all: u64 = (0..pieces).map(volume).sum();
        let mut parents: Vec<u32> = (0..count_before as u32).collect();
        let mut acts = vec![true; pieces];
        let mut group_of = vec![0_u32; pieces];
        // By falling volume, as pieces are numbered, those under contacts first.
        let order = (0..pieces)
            .filter(|&p| touched[p])
            .chain((0..pieces).filter(|&p| !touched[p]));
        for piece in order {
            let parent = parent_of[piece];
            group_of[piece] = parent as u32;
            if heirs[parent] == Some(piece) || held[piece] {
                continue;
            }
            let large = volume(piece) as f64 >= SMALLEST * all as f64;
            acts[piece] = (touched[piece] || large) && parents.len() <= MOST;
            if acts[piece] {
                group_of[piece] = parents.len() as u32;
                parents.push(parent as u32);
            }
        }
        if parents.len() == count_before {
            return (None, acts);
        }
        // A group may have vanished: its rest is too small by now, and part of a neighbour.
        let mut numbers = vec![u32::MAX; parents.len()];
        numbers[0] = 0;
        group_of
            .iter()
            .for_each(|&group| numbers[group as usize] = 0);
        let mut kept = Vec::with_capacity(parents.len());
        for (number, parent) in numbers.iter_mut().zip(parents) {
            if *number == 0 {
                *number = kept.len() as u32;
                kept.push(parent);
            }
        }
        let parents = kept;
        let group_of: Vec<u32> = group_of.iter().map(|&g| numbers[g as usize]).collect();
        let of_node = piece_of_node.iter();
        let of_node = of_node.map(|&piece| group_of.get(piece as usize).copied().unwrap_or(0));
        let of_node = of_node.collect();
        (Some(Self { of_node, parents }), acts)
    }
}
