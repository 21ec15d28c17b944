//! Where a crack ends in another (beyond the paper).
//!
//! The paper lets a newcomer stop at the face of a fractured tetrahedron. That leaves a bridge: inside that
//! tetrahedron the newcomer's two sides stay joined through a node, and pieces hang together. So a crack also *ends
//! inside* what it meets: from the nodes of its last tetrahedron, in every tetrahedron n fractured by another crack
//! (or by an older part of itself), the edges among the nodes reachable over edges that the other did not cut are cut
//! where the newcomer's surface, continued linearly, changes sign.

use std::collections::{BTreeMap, VecDeque};

use super::cuts::Cuts;
use crate::crack::{CrackSystem, ElementCut};
use crate::mesh::EDGES;

/// How far from its last tetrahedron a newcomer is continued, in mean edges.
const REACH: f32 = 2.5;

/// Ends every crack inside what it met, cracks in order, junctions in the order they happened.
pub(crate) fn end_cracks(system: &CrackSystem, cuts: &mut Cuts, tets_of_node: &NodeTets) {
    for (id, crack) in system.cracks.iter().enumerate() {
        for junction in &crack.junctions {
            end_crack(
                system,
                cuts,
                tets_of_node,
                id as u32,
                &crack.elements[junction.from as usize],
                junction.own,
            );
        }
    }
}

fn end_crack(
    system: &CrackSystem,
    cuts: &mut Cuts,
    tets_of_node: &NodeTets,
    newcomer: u32,
    last: &ElementCut,
    own: bool,
) {
    let mesh = &system.asset.fracture;
    let nodes = mesh.tets[last.tet as usize];
    let centre = mesh.centroid(last.tet as usize);
    // The newcomer's surface, continued as the plane it has in its last tetrahedron.
    let level = nodes
        .iter()
        .zip(&last.values)
        .map(|(&v, s)| s - (mesh.positions[v as usize] - centre).dot(last.direction))
        .sum::<f32>()
        / 4.0;
    let mut values: BTreeMap<u32, f32> = nodes.iter().copied().zip(last.values).collect();
    let mut queue: VecDeque<u32> = nodes.into();
    let mut queued = nodes.to_vec();
    while let Some(v) = queue.pop_front() {
        for &n in tets_of_node.of(v) {
            let by = system.fractured_by[n as usize];
            if by == crate::crack::UNCUT || n == last.tet || (by == newcomer && !own) {
                continue;
            }
            let corners = mesh.tets[n as usize];
            for w in corners {
                values.entry(w).or_insert_with(|| {
                    level + (mesh.positions[w as usize] - centre).dot(last.direction)
                });
            }
            let reachable = reachable(&corners, v, |a, b| {
                cuts.get(a, b)
                    .is_some_and(|cut| cut.crack != newcomer || own)
            });
            for [i, j] in EDGES {
                let (a, b) = (corners[i], corners[j]);
                if reachable[i] && reachable[j] && cuts.cut(a, b, values[&a], values[&b], newcomer)
                {
                    for end in [a, b] {
                        let near =
                            mesh.positions[end as usize].distance(centre) < REACH * system.edge;
                        if near && !queued.contains(&end) {
                            queued.push(end);
                            queue.push_back(end);
                        }
                    }
                }
            }
        }
    }
}

/// Corners of a tetrahedron reachable from corner `start` over edges that are not `blocked`.
fn reachable(corners: &[u32; 4], start: u32, blocked: impl Fn(u32, u32) -> bool) -> [bool; 4] {
    let mut seen = corners.map(|v| v == start);
    loop {
        let mut grown = false;
        for [i, j] in EDGES {
            if seen[i] != seen[j] && !blocked(corners[i], corners[j]) {
                (seen[i], seen[j]) = (true, true);
                grown = true;
            }
        }
        if !grown {
            return seen;
        }
    }
}

/// Tetrahedra around each node, in compressed rows.
pub(crate) struct NodeTets {
    starts: Vec<u32>,
    tets: Vec<u32>,
}

impl NodeTets {
    pub(crate) fn new(node_count: usize, tets: &[[u32; 4]]) -> Self {
        let mut starts = vec![0_u32; node_count + 1];
        for &v in tets.iter().flatten() {
            starts[v as usize + 1] += 1;
        }
        for v in 0..node_count {
            starts[v + 1] += starts[v];
        }
        let mut next = starts.clone();
        let mut rows = vec![0; 4 * tets.len()];
        for (e, tet) in tets.iter().enumerate() {
            for &v in tet {
                rows[next[v as usize] as usize] = e as u32;
                next[v as usize] += 1;
            }
        }
        Self { starts, tets: rows }
    }

    pub(crate) fn of(&self, v: u32) -> &[u32] {
        &self.tets[self.starts[v as usize] as usize..self.starts[v as usize + 1] as usize]
    }
}
