//! Data of a break that its pieces need.

use std::sync::Arc;

use super::Labels;
use crate::asset::{FixedPoints, Trace};
use crate::crack::CrackSystem;
use crate::state::{BodyState, Cuts};

/// Pieces of the nodes, and the cracks.
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
