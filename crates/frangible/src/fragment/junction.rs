//! Where a crack ends in another (beyond the paper).
//!
//! The paper lets a newcomer stop at the face of a fractured tetrahedron. That leaves a bridge: inside that
//! tetrahedron the newcomer's two sides stay joined through a node, and pieces hang together. So a crack also *ends
//! inside* what it meets: from the nodes of its last tetrahedron, in every tetrahedron n fractured by another crack
//! (or by an older part of itself), the edges among the nodes reachable over edges that the other did not cut are cut
//! where the newcomer's surface, continued linearly, changes sign. It goes on from the ends of the edges that it cuts: where another of the
//! crack's fronts has been before, it stops.

use glam::Vec3;

use crate::crack::{CrackSystem, Cuts, ElementCut};
use crate::mesh::EDGES;

/// How far from its last tetrahedron a newcomer is continued, in mean edges.
const REACH: f32 = 2.5;

/// All corners of a tetrahedron, a bit each.
const ALL: u8 = 0b1111;

/// Ends every crack inside what it met, cracks in order, junctions in the order they happened.
pub(crate) fn end_cracks(system: &CrackSystem, cuts: &mut Cuts) {
    if system.cracks.iter().all(|crack| crack.junctions.is_empty()) {
        return;
    }
    let mut fractured = Fractured::of(system);
    for (id, crack) in (0..).zip(&system.cracks) {
        // A front that met several tetrahedra from one of its own ends the same way in all of them.
        let mut ended = vec![[false; 2]; crack.elements.len()];
        for junction in &crack.junctions {
            let ended = &mut ended[junction.from as usize][usize::from(junction.own)];
            if !std::mem::replace(ended, true) {
                let last = &crack.elements[junction.from as usize];
                Continued::new(system, id, last, junction.own).cut(cuts, &mut fractured);
            }
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

    /// s at a node that is not one of the last tetrahedron's, m.
    fn value(&self, node: u32) -> f32 {
        self.level + (self.place(node) - self.centre).dot(self.last.direction)
    }

    fn cut(&self, cuts: &mut Cuts, fractured: &mut Fractured) {
        let Fractured {
            tets,
            first,
            queue,
            round,
        } = fractured;
        *round += 1;
        queue.begin(*round, &self.nodes, &self.last.values);
        while let Some(v) = queue.pop() {
            let mut at = first[v as usize];
            while at != 0 {
                let tet = &mut tets[at as usize - 1];
                let corner = tet.corner(v);
                if tet.round != *round {
                    (tet.round, tet.done) = (*round, 0);
                    if tet.tet == self.last.tet || (tet.by == self.newcomer && !self.own) {
                        tet.done = ALL;
                    }
                }
                if tet.done & (1 << corner) == 0 {
                    self.cut_tet(tet, corner, cuts, queue);
                }
                at = tet.next[corner];
            }
        }
    }

    /// Cuts a tetrahedron's edges among the corners that can be reached from one of them without crossing a cut. From each of those
    /// corners the same ones can be reached, but for what was cut since, so that all of them are done.
    fn cut_tet(&self, tet: &mut FracturedTet, start: usize, cuts: &mut Cuts, queue: &mut Queue) {
        let values = tet.corners.map(|w| queue.value(w, || self.value(w)));
        let below = values.map(|s| s < 0.0);
        if below == [below[0]; 4] {
            tet.done = ALL;
            return;
        }
        let reachable = reachable(start, tet.blocked(self.newcomer, self.own, cuts));
        tet.done |= reachable;
        for (k, [i, j]) in EDGES.into_iter().enumerate() {
            let both = 1 << i | 1 << j;
            if reachable & both != both || below[i] == below[j] {
                continue;
            }
            let (a, b) = (tet.corners[i], tet.corners[j]);
            if tet.cut & (1 << k) != 0 {
                continue;
            }
            let known = cuts.list().len();
            cuts.cut(a, b, values[i], values[j], self.newcomer);
            tet.cut |= 1 << k;
            // Where it is cut already, an earlier junction has been.
            if cuts.list().len() == known {
                continue;
            }
            for end in [a, b] {
                let near = || self.place(end).distance(self.centre) < REACH * self.system.edge;
                if !queue.has(end) && near() {
                    queue.add(end);
                }
            }
        }
    }
}

/// Corners of a tetrahedron that hang together with one over edges that are not blocked, a bit each.
fn reachable(start: usize, blocked: u8) -> u8 {
    let mut seen = 1_u8 << start;
    loop {
        let before = seen;
        for (k, [i, j]) in EDGES.into_iter().enumerate() {
            let both = 1 << i | 1 << j;
            if blocked & (1 << k) == 0 && seen & both != 0 {
                seen |= both;
            }
        }
        if seen == before {
            return seen;
        }
    }
}

/// A fractured tetrahedron and what is known of it.
struct FracturedTet {
    tet: u32,
    /// Its crack.
    by: u32,
    corners: [u32; 4],
    /// For each corner the next fractured tetrahedron around it, plus one; 0 for none.
    next: [u32; 4],
    /// Edges known to be cut, a bit each.
    cut: u8,
    /// Edges that others than the newcomer below have cut, a bit each.
    blocked: u8,
    /// That newcomer plus one, 0 for none.
    blocked_for: u32,
    /// How many edges of the body were cut when this one's were looked at.
    cuts_then: u32,
    /// Corners that need no look any more in the round below, a bit each.
    done: u8,
    round: u32,
}

impl FracturedTet {
    fn corner(&self, node: u32) -> usize {
        let [a, b, c, _] = self.corners.map(|v| v == node);
        if a {
            0
        } else if b {
            1
        } else if c {
            2
        } else {
            3
        }
    }

    /// Edges that a newcomer does not pass, a bit each: those that others have cut, or for one that met itself any that are cut.
    fn blocked(&mut self, newcomer: u32, own: bool, cuts: &Cuts) -> u8 {
        let cuts_now = cuts.list().len();
        if self.blocked_for != newcomer + 1 {
            (self.blocked, self.blocked_for) = (0, newcomer + 1);
            self.look(0, newcomer, cuts);
        } else if own && self.cuts_then != cuts_now as u32 {
            // While one newcomer's junctions are looked at no other crack cuts anything.
            self.look(self.cut, newcomer, cuts);
        }
        self.cuts_then = cuts_now as u32;
        if own { self.cut } else { self.blocked }
    }

    /// Finds out which edges are cut, and by whom, but for those that are known.
    fn look(&mut self, known: u8, newcomer: u32, cuts: &Cuts) {
        for (k, [i, j]) in EDGES.into_iter().enumerate() {
            if known & (1 << k) == 0
                && let Some(cut) = cuts.get(self.corners[i], self.corners[j])
            {
                self.cut |= 1 << k;
                self.blocked |= u8::from(cut.crack != newcomer) << k;
            }
        }
    }
}

/// All fractured tetrahedra by their nodes.
struct Fractured {
    tets: Vec<FracturedTet>,
    /// For each node the first fractured tetrahedron around it, plus one; 0 for none. They rise along the chain.
    first: Vec<u32>,
    queue: Queue,
    /// Number of junctions so far.
    round: u32,
}

impl Fractured {
    fn of(system: &CrackSystem) -> Self {
        let mesh = &system.asset.fracture;
        let cracks = (0..).zip(&system.cracks);
        let mut order: Vec<(u32, u32)> = cracks
            .flat_map(|(id, crack)| crack.elements.iter().map(move |e| (e.tet, id)))
            .collect();
        order.sort_unstable_by(|a, b| b.cmp(a));
        let mut first = vec![0; mesh.positions.len()];
        let fractured = |(place, (tet, by)): (u32, (u32, u32))| {
            let corners = mesh.tets[tet as usize];
            FracturedTet {
                tet,
                by,
                corners,
                next: corners.map(|v| std::mem::replace(&mut first[v as usize], place)),
                cut: 0,
                blocked: 0,
                blocked_for: 0,
                cuts_then: 0,
                done: 0,
                round: 0,
            }
        };
        Self {
            tets: (1..).zip(order).map(fractured).collect(),
            queue: Queue::new(mesh.positions.len()),
            first,
            round: 0,
        }
    }
}

/// Nodes to look at, each once per round, and the newcomer's s at nodes.
struct Queue {
    nodes: Vec<u32>,
    next: usize,
    /// Latest round in which each node was added.
    added: Vec<u32>,
    /// Latest round in which each node got its s, and s, m.
    values: Vec<(u32, f32)>,
    round: u32,
}

impl Queue {
    fn new(node_count: usize) -> Self {
        Self {
            nodes: Vec::new(),
            next: 0,
            added: vec![0; node_count],
            values: vec![(0, 0.0); node_count],
            round: 0,
        }
    }

    fn begin(&mut self, round: u32, nodes: &[u32], values: &[f32]) {
        self.nodes.clear();
        self.next = 0;
        self.round = round;
        for (&v, &s) in nodes.iter().zip(values) {
            self.add(v);
            self.values[v as usize] = (round, s);
        }
    }

    /// s at a node, worked out once.
    fn value(&mut self, node: u32, s: impl FnOnce() -> f32) -> f32 {
        let value = &mut self.values[node as usize];
        if value.0 != self.round {
            *value = (self.round, s());
        }
        value.1
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
