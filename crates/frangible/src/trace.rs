//! Trace of the cracks of one impact, element by element: a by-product for tests, off the way of [`crate::impact()`].

use crate::crack::CrackSystem;
use crate::motion::Motion;

/// Trace of the cracks of one impact.
#[derive(Clone, Debug, Default)]
pub struct CrackTrace {
    /// Fractured tetrahedra of each crack in the order they joined, cracks in the order they started.
    pub cracks: Vec<Vec<ElementTrace>>,
    /// Fragment of each node of the fracture mesh, 0 the largest; empty when no contact had an impulse.
    pub fragment_of_node: Vec<u32>,
    /// The motion that they ran under, as it became where they weakened what bore a contact; empty when no contact had an impulse.
    pub motion: Motion,
    /// Triangles of the surface that the contacts pressed on.
    pub pressed: Vec<u32>,
}

/// A tetrahedron fractured by a crack.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElementTrace {
    /// Number of the tetrahedron.
    pub tet: u32,
    /// The crack's s at its four nodes, m; zero counts as positive.
    pub values: [f32; 4],
    /// Time at which it joined, s after the contact began.
    pub time: f64,
}

impl CrackTrace {
    pub(crate) fn of(
        system: &CrackSystem,
        fragment_of_node: &[u32],
        motion: Motion,
        pressed: Vec<u32>,
    ) -> Self {
        let elements = |crack: &crate::crack::Crack| {
            let trace = |cut: &crate::crack::ElementCut| ElementTrace {
                tet: cut.tet,
                values: cut.values,
                time: cut.time,
            };
            crack.elements.iter().map(trace).collect()
        };
        Self {
            cracks: system.cracks.iter().map(elements).collect(),
            fragment_of_node: fragment_of_node.to_vec(),
            motion,
            pressed,
        }
    }
}
