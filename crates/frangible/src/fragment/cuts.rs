//! Which mesh edges are cut, where, and by which crack `[G12 §6.3]`.

use std::collections::HashMap;

use crate::crack::CrackSystem;
use crate::mesh::EDGES;

/// Cut points stay this far (in edge lengths) from the nodes, so that no triangle has zero area.
const CUT_MARGIN: f64 = 0.02;

/// A cut edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct EdgeCut {
    /// Place along the edge, from its lower node (0) to its higher (1).
    pub(crate) at: f64,
    /// Crack that cut it first.
    pub(crate) crack: u32,
}

/// All cut edges. Looked up only, never iterated.
#[derive(Debug, Default)]
pub(crate) struct Cuts {
    edges: HashMap<(u32, u32), EdgeCut>,
    /// Nodes with a cut edge.
    pub(crate) touched: Vec<bool>,
}

impl Cuts {
    /// No cut edge.
    pub(crate) fn none(node_count: usize) -> Self {
        Self {
            edges: HashMap::new(),
            touched: vec![false; node_count],
        }
    }

    /// Cuts of every fractured tetrahedron, cracks in order of their start; the first crack places the point.
    pub(crate) fn of_fractured_elements(system: &CrackSystem) -> Self {
        let mesh = &system.asset.fracture;
        let mut cuts = Self::none(mesh.positions.len());
        for (id, crack) in system.cracks.iter().enumerate() {
            for element in &crack.elements {
                let nodes = mesh.tets[element.tet as usize];
                for [i, j] in EDGES {
                    cuts.cut(
                        nodes[i],
                        nodes[j],
                        element.values[i],
                        element.values[j],
                        id as u32,
                    );
                }
            }
        }
        cuts
    }

    /// Cuts the edge when the crack's values have opposite signs at its ends (zero counts as positive). True when they have.
    pub(crate) fn cut(&mut self, a: u32, b: u32, value_a: f32, value_b: f32, crack: u32) -> bool {
        if (value_a < 0.0) == (value_b < 0.0) {
            return false;
        }
        let (low, high, s, t) = if a < b {
            (a, b, value_a, value_b)
        } else {
            (b, a, value_b, value_a)
        };
        let (s, t) = (f64::from(s), f64::from(t));
        let at = (s / (s - t)).clamp(CUT_MARGIN, 1.0 - CUT_MARGIN);
        self.edges
            .entry((low, high))
            .or_insert(EdgeCut { at, crack });
        self.touched[a as usize] = true;
        self.touched[b as usize] = true;
        true
    }

    /// The cut of an edge, if any.
    pub(crate) fn get(&self, a: u32, b: u32) -> Option<EdgeCut> {
        if !(self.touched[a as usize] && self.touched[b as usize]) {
            return None;
        }
        self.edges.get(&(a.min(b), a.max(b))).copied()
    }
}
