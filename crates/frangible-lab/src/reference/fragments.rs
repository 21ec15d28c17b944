//! Fragments are sets of nodes, by flood fill `[G12 §6.1, §6.2]`.

use std::collections::BTreeSet;

use crate::reference::body::Solid;
use crate::reference::options::Marks;
use crate::reference::propagation::Crack;

/// Fragment of each node, numbered by first node.
pub(crate) fn fragments(solid: &Solid, cracks: &[Crack], rule: Marks) -> Vec<u32> {
    let tets = &solid.asset.fracture().tets;
    let mut joined: Vec<BTreeSet<u32>> = vec![BTreeSet::new(); solid.nodes.len()];
    for tet in tets {
        for &a in tet {
            for &b in tet {
                if a != b {
                    joined[a as usize].insert(b);
                }
            }
        }
    }
    // "Each node that is on the positive side of the implicit fracture surface is marked (h, 1), and (h, 0) if it is on
    // the negative side".
    let mut marks: Vec<Vec<(usize, bool)>> = vec![Vec::new(); solid.nodes.len()];
    for (h, crack) in cracks.iter().enumerate() {
        for element in &crack.elements {
            let nodes = tets[element.tet as usize];
            for i in 0..4 {
                marks[nodes[i] as usize].push((h, element.values[i] >= 0.0));
                for j in 0..4 {
                    let parted = (element.values[i] < 0.0) != (element.values[j] < 0.0);
                    if rule == Marks::Elements && parted {
                        joined[nodes[i] as usize].remove(&nodes[j]);
                    }
                }
            }
        }
    }
    if rule == Marks::Nodes {
        for v in 0..joined.len() {
            let own = &marks[v];
            joined[v].retain(|&w| {
                let other = &marks[w as usize];
                !own.iter().any(|&(h, side)| other.contains(&(h, !side)))
            });
        }
    }
    // "we start from one node, and recursively add its neighbors".
    let mut fragment = vec![u32::MAX; joined.len()];
    let mut count = 0;
    for first in 0..joined.len() {
        if fragment[first] != u32::MAX {
            continue;
        }
        let mut open = vec![first as u32];
        while let Some(v) = open.pop() {
            if fragment[v as usize] == u32::MAX {
                fragment[v as usize] = count;
                open.extend(&joined[v as usize]);
            }
        }
        count += 1;
    }
    fragment
}
