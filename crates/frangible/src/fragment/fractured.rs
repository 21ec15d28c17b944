//! Fractured tetrahedra by their nodes and edges, for cracks that end inside them.
//!
//! Thousands of fronts end in a break, and each looks at all fractured tetrahedra about four nodes or more. So what most of these looks need
//! lies close together: the tetrahedron and the latest round that was there.

use crate::body::MeshIndex;
use crate::crack::{CrackSystem, ELSEWHERE, UNCUT};
use crate::mesh::EDGES;
use crate::state::EdgeCut;

/// All corners of a tetrahedron, a bit each.
pub(super) const ALL: u8 = 0b1111;

/// State of a fractured tetrahedron in a round of looks.
pub(super) struct Look {
    pub(super) tet: u32,
    /// Latest round that was here.
    pub(super) round: u32,
    /// Corners that need no look any more in that round, a bit each.
    pub(super) done: u8,
}

/// All fractured tetrahedra, by rising number.
pub(super) struct Fractured<'a> {
    pub(super) looks: Vec<Look>,
    /// Their corners.
    pub(super) corners: Vec<[u32; 4]>,
    /// Their cracks.
    pub(super) by: Vec<u32>,
    /// Start of the list of those around each node.
    starts: Vec<u32>,
    /// Those around each node: four times the place, plus the corner that the node is.
    around: Vec<u32>,
    /// Numbers of their edges.
    pub(super) edges: Vec<[u32; 6]>,
    /// The crack that has cut each edge of the mesh.
    cut_by: &'a mut [u32],
}

impl<'a> Fractured<'a> {
    /// `cut_by`: the crack that has cut each edge of the mesh.
    pub(super) fn of(system: &CrackSystem, index: &MeshIndex, cut_by: &'a mut [u32]) -> Self {
        let mesh = &system.asset.fracture;
        let nodes = mesh.positions.len();
        let (mut looks, mut corners, mut by) = (Vec::new(), Vec::new(), Vec::new());
        let mut edges = Vec::new();
        for (tet, &crack) in (0..).zip(&system.fractured_by) {
            if crack != UNCUT && crack != ELSEWHERE {
                let (round, done) = (0, 0);
                looks.push(Look { tet, round, done });
                corners.push(mesh.tets[tet as usize]);
                by.push(crack);
                edges.push(index.edges.of_tet(tet));
            }
        }
        let (starts, around) = around(nodes, &corners);
        Self {
            edges,
            looks,
            corners,
            by,
            starts,
            around,
            cut_by,
        }
    }

    /// Range of the fractured tetrahedra around a node in the list, rising.
    pub(super) fn around(&self, node: u32) -> std::ops::Range<usize> {
        let v = node as usize;
        self.starts[v] as usize..self.starts[v + 1] as usize
    }

    /// The place of a listed tetrahedron, and the corner that the node is.
    pub(super) fn at(&self, listed: usize) -> (usize, usize) {
        let listed = self.around[listed] as usize;
        (listed / 4, listed % 4)
    }

    /// A crack cuts an edge.
    pub(super) fn cut(&mut self, edge: u32, crack: u32) {
        self.cut_by[edge as usize] = crack;
    }

    /// Edges of a tetrahedron that are cut, and those that a newcomer does not pass, a bit each: the edges that others have cut, or for one
    /// that met itself all that are cut.
    pub(super) fn cut_and_blocked(&self, edges: [u32; 6], newcomer: u32, own: bool) -> (u8, u8) {
        let (mut cut, mut others) = (0, 0);
        for (k, edge) in edges.into_iter().enumerate() {
            let by = self.cut_by[edge as usize];
            cut |= u8::from(by != EdgeCut::WHOLE) << k;
            others |= u8::from(by != newcomer) << k;
        }
        (cut, if own { cut } else { cut & others })
    }
}

/// Tetrahedra of these corners around each node: the start of each node's list, and all lists.
fn around(nodes: usize, corners: &[[u32; 4]]) -> (Vec<u32>, Vec<u32>) {
    let mut starts = vec![0_u32; nodes + 1];
    for &v in corners.iter().flatten() {
        starts[v as usize + 1] += 1;
    }
    for v in 0..nodes {
        starts[v + 1] += starts[v];
    }
    let mut next = starts.clone();
    let mut around = vec![0; 4 * corners.len()];
    for (listed, &v) in (0..).zip(corners.iter().flatten()) {
        around[next[v as usize] as usize] = listed;
        next[v as usize] += 1;
    }
    (starts, around)
}

/// Edges of a tetrahedron between a corner of these, a bit each, and one that is none of them, a bit each.
pub(super) fn crossed(corners: u8) -> u8 {
    const OF: [u8; 16] = {
        let mut of = [0; 16];
        let mut k = 0;
        while k < 16 * EDGES.len() {
            let (corners, edge) = (k / EDGES.len(), k % EDGES.len());
            let [i, j] = EDGES[edge];
            of[corners] |= (((corners >> i ^ corners >> j) & 1) << edge) as u8;
            k += 1;
        }
        of
    };
    OF[usize::from(corners & ALL)]
}

/// Corners of a tetrahedron that hang together with one over edges that are not blocked, a bit each.
pub(super) fn reachable(start: usize, blocked: u8) -> u8 {
    const OF: [[u8; 64]; 4] = {
        let mut of = [[0; 64]; 4];
        let mut k = 0;
        while k < 4 * 64 {
            of[k / 64][k % 64] = flood(k / 64, (k % 64) as u8);
            k += 1;
        }
        of
    };
    OF[start % 4][usize::from(blocked % 64)]
}

const fn flood(start: usize, blocked: u8) -> u8 {
    let mut seen = 1_u8 << start;
    loop {
        let before = seen;
        let mut k = 0;
        while k < EDGES.len() {
            let both = 1 << EDGES[k][0] | 1 << EDGES[k][1];
            if blocked & (1 << k) == 0 && seen & both != 0 {
                seen |= both;
            }
            k += 1;
        }
        if seen == before {
            return seen;
        }
    }
}
