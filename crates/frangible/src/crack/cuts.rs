//! The mesh edges that the cracks of an impact have cut `[G12 §6.3]`.

use super::system::CrackSystem;
use crate::body::MeshIndex;
use crate::mesh::EDGES;
use crate::state::{Cuts, EdgeCut};

/// Record of the edges that have been cut: more are cut from look to look while cracks run.
#[derive(Debug, Default)]
pub(crate) struct Known {
    /// [The crack that has cut each edge](MeshIndex::cut_by).
    pub(crate) cut_by: Vec<u32>,
    /// Numbers of tetrahedra and junctions of each crack that have been looked at.
    pub(crate) looked_at: Vec<[usize; 2]>,
}

impl Cuts {
    /// Settled cuts: those that a piece has had since it came about.
    pub(crate) fn settled(system: &CrackSystem, index: &MeshIndex) -> (Self, Known) {
        let settled = system.asset.portion.as_ref().map_or(&[][..], |p| p.cuts());
        let cuts = Self::of_list(settled, system.asset.fracture.positions.len());
        let known = Known {
            cut_by: index.cut_by(settled),
            looked_at: Vec::new(),
        };
        (cuts, known)
    }

    /// Cuts the edges of all tetrahedra that were fractured since the last look, cracks in order of their start; the first crack places the
    /// point.
    pub(crate) fn follow(&mut self, system: &CrackSystem, index: &MeshIndex, known: &mut Known) {
        let mesh = &system.asset.fracture;
        let new = &system.cracks[known.looked_at.len()..];
        known.looked_at.extend(new.iter().map(|c| [c.settled, 0]));
        let cracks = system.cracks.iter().zip(&mut known.looked_at);
        for (id, (crack, [done, _])) in (0..).zip(cracks) {
            let first = std::mem::replace(done, crack.elements.len());
            for element in &crack.elements[first..] {
                let nodes = mesh.tets[element.tet as usize];
                let values = &element.values;
                for (edge, [i, j]) in index.edges.of_tet(element.tet).into_iter().zip(EDGES) {
                    let by = &mut known.cut_by[edge as usize];
                    if *by == EdgeCut::WHOLE && (values[i] < 0.0) != (values[j] < 0.0) {
                        *by = id;
                        self.cut_whole(nodes[i], nodes[j], values[i], values[j], id);
                    }
                }
            }
        }
    }
}
