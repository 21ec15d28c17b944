//! Fractured tetrahedra, for cracks that end inside them.

use crate::body::MeshIndex;
use crate::crack::{CrackSystem, ELSEWHERE, UNCUT};
use crate::mesh::EDGES;
use crate::state::EdgeCut;

/// All corners of a tetrahedron, a bit each.
pub(super) const ALL: u8 = 0b1111;

/// State of a tetrahedron in a round of looks.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Look {
    /// Latest round that was here.
    pub(super) round: u32,
    /// Corners that need no look any more in that round, a bit each.
    pub(super) done: u8,
}

/// The tetrahedra that cracks have fractured.
pub(super) struct Fractured<'a> {
    tets: &'a [[u32; 4]],
    by: &'a [u32],
    index: &'a MeshIndex,
    /// The crack that has cut each edge of the mesh.
    cut_by: &'a mut [u32],
}

impl<'a> Fractured<'a> {
    /// `cut_by`: the crack that has cut each edge of the mesh.
    pub(super) fn of(system: &'a CrackSystem, index: &'a MeshIndex, cut_by: &'a mut [u32]) -> Self {
        Self {
            tets: &system.asset.fracture.tets,
            by: &system.fractured_by,
            index,
            cut_by,
        }
    }

    /// All tetrahedra around a node.
    pub(super) fn around(&self, node: u32) -> &'a [u32] {
        self.index.tets.of(node)
    }

    /// The crack that has fractured a tetrahedron; none if it is whole or belongs to another piece.
    pub(super) fn by(&self, tet: u32) -> Option<u32> {
        Some(self.by[tet as usize]).filter(|&by| by != UNCUT && by != ELSEWHERE)
    }

    pub(super) fn corners(&self, tet: u32) -> [u32; 4] {
        self.tets[tet as usize]
    }

    /// Numbers of the edges of a tetrahedron.
    pub(super) fn edges(&self, tet: u32) -> [u32; 6] {
        self.index.edges.of_tet(tet)
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
