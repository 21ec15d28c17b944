//! Where a crack ends in another (beyond the paper).
//!
//! The paper lets a newcomer stop at the face of a fractured tetrahedron. That leaves a bridge: inside that
//! tetrahedron the newcomer's two sides stay joined through a node, and pieces hang together. So a crack also *ends
//! inside* what it meets: from the nodes of its last tetrahedron, in every tetrahedron n fractured by another crack
//! (or by an older part of itself), the edges among the nodes reachable over edges that the other did not cut are cut
//! where the newcomer's surface, continued linearly, changes sign.

use glam::Vec3;

use super::cuts::Cuts;
use super::index::MeshIndex;
use crate::crack::{CrackSystem, ElementCut, UNCUT};
use crate::mesh::EDGES;

/// How far from its last tetrahedron a newcomer is continued, in mean edges.
const REACH: f32 = 2.5;

/// Ends every crack inside what it met, cracks in order, junctions in the order they happened.
pub(crate) fn end_cracks(system: &CrackSystem, cuts: &mut Cuts, index: &MeshIndex) {
    if system.cracks.iter().all(|crack| crack.junctions.is_empty()) {
        return;
    }
    let mut queue = Queue::new(index.nodes());
    for (id, crack) in system.cracks.iter().enumerate() {
        for junction in &crack.junctions {
            let last = &crack.elements[junction.from as usize];
            let end = Continued::new(system, id as u32, last, junction.own);
            end.cut(cuts, index, &mut queue);
        }
    }
}

/// A newcomer continued beyond its last tetrahedron, as the plane it has there.
struct Continued<'a> {
    system: &'a CrackSystem<'a>,
    newcomer: u32,
    last: &'a ElementCut,
    /// Whether it met an older part of itself.
    own: bool,
    nodes: [u32; 4],
    centre: Vec3,
    /// s at the centre, m.
    level: f32,
}

impl<'a> Continued<'a> {
    fn new(system: &'a CrackSystem, newcomer: u32, last: &'a ElementCut, own: bool) -> Self {
        let mesh = &system.asset.fracture;
        let nodes = mesh.tets[last.tet as usize];
        let centre = mesh.centroid(last.tet as usize);
        let level = nodes
            .iter()
            .zip(&last.values)
            .map(|(&v, s)| s - (mesh.positions[v as usize] - centre).dot(last.direction))
            .sum::<f32>()
            / 4.0;
        Self {
            system,
            newcomer,
            last,
            own,
            nodes,
            centre,
            level,
        }
    }

    fn place(&self, node: u32) -> Vec3 {
        self.system.asset.fracture.positions[node as usize]
    }

    /// s at a node, m.
    fn value(&self, node: u32) -> f32 {
        match self.nodes.iter().position(|&v| v == node) {
            Some(i) => self.last.values[i],
            None => self.level + (self.place(node) - self.centre).dot(self.last.direction),
        }
    }

    fn cut(&self, cuts: &mut Cuts, index: &MeshIndex, queue: &mut Queue) {
        queue.begin(&self.nodes);
        while let Some(v) = queue.pop() {
            for &n in index.tets.of(v) {
                let by = self.system.fractured_by[n as usize];
                let own_cut = by == self.newcomer && !self.own;
                if by != UNCUT && n != self.last.tet && !own_cut {
                    self.cut_tet(n, v, cuts, queue);
                }
            }
        }
    }

    /// Cuts a tetrahedron among the corners reachable from corner `start`.
    fn cut_tet(&self, n: u32, start: u32, cuts: &mut Cuts, queue: &mut Queue) {
        let corners = self.system.asset.fracture.tets[n as usize];
        let values = corners.map(|w| self.value(w));
        let below = values.map(|s| s < 0.0);
        if below == [below[0]; 4] {
            return;
        }
        let blocked = EDGES.map(|[i, j]| {
            cuts.get(corners[i], corners[j])
                .is_some_and(|cut| cut.crack != self.newcomer || self.own)
        });
        let reachable = reachable(corners.map(|v| v == start), &blocked);
        for [i, j] in EDGES {
            let (a, b) = (corners[i], corners[j]);
            if reachable[i] && reachable[j] && cuts.cut(a, b, values[i], values[j], self.newcomer) {
                for end in [a, b] {
                    if self.place(end).distance(self.centre) < REACH * self.system.edge {
                        queue.add(end);
                    }
                }
            }
        }
    }
}

/// Corners of a tetrahedron that hang together with the `seen` ones over edges that are not blocked.
fn reachable(mut seen: [bool; 4], blocked: &[bool; 6]) -> [bool; 4] {
    loop {
        let mut grown = false;
        for ([i, j], blocked) in EDGES.into_iter().zip(blocked) {
            if seen[i] != seen[j] && !blocked {
                (seen[i], seen[j]) = (true, true);
                grown = true;
            }
        }
        if !grown {
            return seen;
        }
    }
}

/// Nodes to look at, each once per round.
struct Queue {
    nodes: Vec<u32>,
    next: usize,
    /// Latest round in which each node was added.
    round_of_node: Vec<u32>,
    round: u32,
}

impl Queue {
    fn new(node_count: usize) -> Self {
        Self {
            nodes: Vec::new(),
            next: 0,
            round_of_node: vec![0; node_count],
            round: 0,
        }
    }

    fn begin(&mut self, nodes: &[u32]) {
        self.nodes.clear();
        self.next = 0;
        self.round += 1;
        nodes.iter().for_each(|&v| self.add(v));
    }

    fn add(&mut self, node: u32) {
        if std::mem::replace(&mut self.round_of_node[node as usize], self.round) != self.round {
            self.nodes.push(node);
        }
    }

    fn pop(&mut self) -> Option<u32> {
        let node = self.nodes.get(self.next).copied();
        self.next += 1;
        node
    }
}
