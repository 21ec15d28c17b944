//! Patches: nodes of a fracture mesh that hang together, so that a search passes a whole one at once where no crack is near.

use crate::mesh::Rows;

/// Most nodes of a patch: few enough that a crack touches few others with it, and many beside those around the patch.
pub(super) const MOST: usize = 96;

/// The nodes of a mesh in patches: each hangs together by edges of its own.
#[derive(Debug)]
pub(crate) struct Patches {
    of_node: Vec<u32>,
    nodes: Rows,
    rims: Rows,
}

impl Patches {
    /// Grows patches of so many nodes at most one after another, each about the lowest node that is in none.
    pub(super) fn new(neighbours: &Rows, most: usize) -> Self {
        const NONE: u32 = u32::MAX;
        let count = neighbours.count();
        let mut of_node = vec![NONE; count];
        let (mut nodes, mut own) = (Rows::default(), Vec::new());
        for first in 0..count as u32 {
            if of_node[first as usize] != NONE {
                continue;
            }
            let patch = nodes.count() as u32;
            of_node[first as usize] = patch;
            own.clear();
            own.push(first);
            let mut next = 0;
            while next < own.len() && own.len() < most {
                for &w in neighbours.of(own[next]) {
                    if of_node[w as usize] == NONE && own.len() < most {
                        of_node[w as usize] = patch;
                        own.push(w);
                    }
                }
                next += 1;
            }
            nodes.push(&mut own);
        }
        Self {
            rims: rims(&of_node, &nodes, neighbours),
            of_node,
            nodes: nodes.shrunk(),
        }
    }

    /// Number of patches.
    pub(crate) fn count(&self) -> usize {
        self.nodes.count()
    }

    /// The patch of a node.
    pub(crate) fn of_node(&self, node: u32) -> u32 {
        self.of_node[node as usize]
    }

    /// Nodes of a patch, rising.
    pub(crate) fn nodes(&self, patch: u32) -> &[u32] {
        self.nodes.of(patch)
    }

    /// Nodes of other patches that an edge joins to this one, rising.
    pub(crate) fn rim(&self, patch: u32) -> &[u32] {
        self.rims.of(patch)
    }
}

fn rims(of_node: &[u32], nodes: &Rows, neighbours: &Rows) -> Rows {
    let (mut rims, mut rim) = (Rows::default(), Vec::new());
    // Patch plus one whose rim each node was listed in last, 0 for none.
    let mut listed = vec![0; of_node.len()];
    for patch in 0..nodes.count() as u32 {
        rim.clear();
        let beside = nodes.of(patch).iter().flat_map(|&v| neighbours.of(v));
        rim.extend(beside.copied().filter(|&w| {
            of_node[w as usize] != patch
                && std::mem::replace(&mut listed[w as usize], patch + 1) != patch + 1
        }));
        rims.push(&mut rim);
    }
    rims.shrunk()
}
