//! Ends of cracks in other cracks (beyond the paper).
//!
//! The paper lets a newcomer stop at the face of a fractured tetrahedron. That leaves a bridge: inside that
//! tetrahedron the newcomer's two sides stay joined through a node, and pieces hang together. So a crack also *ends
//! inside* what it meets: from the nodes of its last tetrahedron, in every tetrahedron n fractured by another crack
//! (or by an older part of itself), the edges among the nodes reachable over edges that the other did not cut are cut
//! where the newcomer's surface, continued linearly, changes sign. It goes on from the ends of the edges that it cuts: where another of the
//! crack's fronts has been before, it stops.

use glam::Vec3;

use super::fractured::{ALL, Fractured, Look, crossed, reachable};
use crate::body::MeshIndex;
use crate::crack::{CrackSystem, ElementCut, Known};
use crate::mesh::EDGES;
use crate::state::Cuts;

/// Distance from its last tetrahedron to which a newcomer is continued, in mean edges.
const REACH: f32 = 2.5;

/// State of the search for ends, kept from look to look.
#[derive(Debug, Default)]
pub(crate) struct Ends {
    /// State of each tetrahedron.
    looks: Vec<Look>,
    queue: Queue,
}

/// Ends every crack inside what it has met since the last look, cracks in order, junctions in the order they happened.
pub(crate) fn end_cracks(
    system: &CrackSystem,
    index: &MeshIndex,
    cuts: &mut Cuts,
    known: &mut Known,
    ends: &mut Ends,
) {
    let Known { cut_by, looked_at } = known;
    let cracks = || system.cracks.iter();
    if (cracks().zip(&*looked_at)).all(|(crack, [_, done])| crack.junctions.len() == *done) {
        return;
    }
    let mut fractured = Fractured::of(system, index, cut_by);
    if ends.looks.is_empty() {
        let mesh = &system.asset.fracture;
        ends.looks = vec![Look::default(); mesh.tets.len()];
        ends.queue = Queue::new(mesh.positions.len());
    }
    for (id, (crack, [_, done])) in (0..).zip(cracks().zip(looked_at)) {
        let first = std::mem::replace(done, crack.junctions.len());
        // A front that met several tetrahedra from one of its own ends the same way in all of them.
        let mut ended = vec![[false; 2]; crack.elements.len()];
        for junction in &crack.junctions[first..] {
            let ended = &mut ended[junction.from as usize][usize::from(junction.own)];
            if !std::mem::replace(ended, true) {
                let last = &crack.elements[junction.from as usize];
                let continued = Continued::new(system, id, last, junction.own);
                continued.cut(cuts, &mut fractured, ends);
            }
        }
    }
}

/// A newcomer continued beyond its last tetrahedron, as the plane it has there.
struct Continued<'a> {
    system: &'a CrackSystem<'a>,
    newcomer: u32,
    last: &'a ElementCut,
    /// True if it met an older part of itself.
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
        let centre = system.centroids[last.tet as usize];
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

    /// s at a node that is not one of the last tetrahedron's, m.
    fn value(&self, node: u32) -> f32 {
        self.level + (self.place(node) - self.centre).dot(self.last.direction)
    }

    fn cut(&self, cuts: &mut Cuts, fractured: &mut Fractured, ends: &mut Ends) {
        let Ends { looks, queue } = ends;
        queue.begin(&self.nodes, &self.last.values);
        while let Some(v) = queue.pop() {
            for &tet in fractured.around(v) {
                let Some(by) = fractured.by(tet) else {
                    continue;
                };
                let look = &mut looks[tet as usize];
                if look.round != queue.round {
                    let passed_over = tet == self.last.tet || (by == self.newcomer && !self.own);
                    (look.round, look.done) = (queue.round, if passed_over { ALL } else { 0 });
                }
                if look.done == ALL {
                    continue;
                }
                let corners = fractured.corners(tet);
                let corner = corners.iter().position(|&w| w == v).unwrap_or(0);
                if look.done & (1 << corner) == 0 {
                    look.done |= self.cut_tet(tet, corner, cuts, fractured, queue);
                }
            }
        }
    }

    /// Cuts a tetrahedron's edges among the corners that can be reached from one of them without crossing a cut. From each of those
    /// corners the same ones can be reached, but for what was cut since, so that all of them are done: they are returned, a bit each.
    fn cut_tet(
        &self,
        tet: u32,
        start: usize,
        cuts: &mut Cuts,
        fractured: &mut Fractured,
        queue: &mut Queue,
    ) -> u8 {
        let corners = fractured.corners(tet);
        let mut below = 0;
        for (k, &w) in corners.iter().enumerate() {
            below |= u8::from(queue.is_below(w, || self.value(w))) << k;
        }
        if below == 0 || below == ALL {
            return ALL;
        }
        let edges = fractured.edges(tet);
        let (cut, blocked) = fractured.cut_and_blocked(edges, self.newcomer, self.own);
        let whole = crossed(below) & !cut;
        if whole == 0 {
            return ALL;
        }
        let reachable = reachable(start, blocked);
        for (k, [i, j]) in EDGES.into_iter().enumerate() {
            let both = 1 << i | 1 << j;
            if whole & (1 << k) == 0 || reachable & both != both {
                continue;
            }
            let (a, b) = (corners[i], corners[j]);
            let [s, t] = [a, b].map(|end| queue.values[end as usize]);
            cuts.cut_whole(a, b, s, t, self.newcomer);
            fractured.cut(edges[k], self.newcomer);
            for end in [a, b] {
                let near = || self.place(end).distance(self.centre) < REACH * self.system.edge;
                if !queue.has(end) && near() {
                    queue.add(end);
                }
            }
        }
        reachable
    }
}

/// Nodes to look at, each once per round, and the newcomer's s at nodes.
#[derive(Debug, Default)]
struct Queue {
    nodes: Vec<u32>,
    next: usize,
    /// Latest round in which each node was added.
    added: Vec<u32>,
    /// Twice the latest round in which each node got its s, and one more where s is negative.
    sides: Vec<u32>,
    /// The newcomer's s at each node, m.
    values: Vec<f32>,
    /// Number of junctions so far.
    round: u32,
}

impl Queue {
    fn new(node_count: usize) -> Self {
        Self {
            nodes: Vec::new(),
            next: 0,
            added: vec![0; node_count],
            sides: vec![0; node_count],
            values: vec![0.0; node_count],
            round: 0,
        }
    }

    /// Begins the round of a newcomer whose s is known at these nodes, m.
    fn begin(&mut self, nodes: &[u32], values: &[f32]) {
        self.nodes.clear();
        self.next = 0;
        self.round += 1;
        for (&v, &s) in nodes.iter().zip(values) {
            self.add(v);
            self.set(v, s);
        }
    }

    fn set(&mut self, node: u32, s: f32) {
        self.sides[node as usize] = 2 * self.round + u32::from(s < 0.0);
        self.values[node as usize] = s;
    }

    /// Returns true if s, m, is negative at a node; it is worked out once.
    fn is_below(&mut self, node: u32, s: impl FnOnce() -> f32) -> bool {
        if self.sides[node as usize] / 2 != self.round {
            self.set(node, s());
        }
        self.sides[node as usize] % 2 == 1
    }

    fn has(&self, node: u32) -> bool {
        self.added[node as usize] == self.round
    }

    fn add(&mut self, node: u32) {
        if !self.has(node) {
            self.added[node as usize] = self.round;
            self.nodes.push(node);
        }
    }

    fn pop(&mut self) -> Option<u32> {
        let node = self.nodes.get(self.next).copied();
        self.next += 1;
        node
    }
}
