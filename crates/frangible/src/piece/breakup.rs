//! What a break leaves behind for its pieces.

use std::sync::Arc;

use glam::DVec3;

use crate::crack::{CrackSystem, Cuts};
use crate::fragment::Labels;
use crate::state::BodyState;

/// Which node belongs to which piece, and where the cracks are.
#[derive(Debug)]
pub(crate) struct Breakup {
    /// Piece of each node of the fracture mesh.
    pub(crate) of_node: Vec<u32>,
    /// All cut edges.
    pub(crate) cuts: Cuts,
    /// All cracks.
    pub(crate) state: BodyState,
    /// Points that stay where they are.
    pub(crate) fixed: Arc<FixedPoints>,
    /// One per piece, in the order of the fragments.
    pub(crate) traces: Vec<Trace>,
}

/// Where a piece and its surface come from.
#[derive(Clone, Debug, Default)]
pub(crate) struct Trace {
    /// Label of its nodes.
    pub(crate) label: u32,
    /// Triangle of the baked body's surface that each of its outer triangles lies on, rising.
    pub(crate) outer_of: Vec<u32>,
    /// Tetrahedron in which each of its crack faces lies.
    pub(crate) inner_of: Vec<u32>,
    /// For each vertex of its surface a node of its own beside it.
    pub(crate) anchors: Vec<u32>,
}

impl Breakup {
    pub(crate) fn new(
        system: &CrackSystem,
        labels: Labels,
        traces: Vec<Trace>,
        fixed: Arc<FixedPoints>,
    ) -> Self {
        Self {
            of_node: labels.of_node,
            cuts: labels.cuts,
            state: BodyState::of(&system.cracks),
            fixed,
            traces,
        }
    }
}

/// Points of a partition within faces and tetrahedra, in the frame of the fracture mesh, m: later breaks must not move them.
#[derive(Clone, Debug, Default)]
pub(crate) struct FixedPoints {
    /// Points on faces, ordered by the nodes of the face, which rise.
    pub(crate) faces: Vec<([u32; 3], DVec3)>,
    /// Points in tetrahedra, ordered by the tetrahedron.
    pub(crate) centres: Vec<(u32, DVec3)>,
}

impl FixedPoints {
    pub(crate) fn sorted(mut self) -> Self {
        self.faces.sort_unstable_by_key(|f| f.0);
        self.centres.sort_unstable_by_key(|c| c.0);
        self
    }

    /// The point on a face with three labels.
    pub(crate) fn face(&self, nodes: [u32; 3]) -> Option<DVec3> {
        let found = self.faces.binary_search_by_key(&nodes, |f| f.0);
        found.ok().map(|i| self.faces[i].1)
    }

    /// The centre of a tetrahedron with three labels or more.
    pub(crate) fn centre(&self, tet: u32) -> Option<DVec3> {
        let found = self.centres.binary_search_by_key(&tet, |c| c.0);
        found.ok().map(|i| self.centres[i].1)
    }
}
