//! The mesh edges that the cracks of an impact have cut `[G12 §6.3]`.

use super::system::CrackSystem;
use crate::body::MeshIndex;
use crate::mesh::EDGES;
use crate::state::{Cuts, EdgeCut};

impl Cuts {
    /// Cuts that are settled, of a piece since it is one; then those of every fractured tetrahedron, cracks in order of
    /// their start; the first crack places the point. Also [the crack that has cut each edge](MeshIndex::cut_by).
    pub(crate) fn of_fractured_elements(
        system: &CrackSystem,
        index: &MeshIndex,
    ) -> (Self, Vec<u32>) {
        let mesh = &system.asset.fracture;
        let settled = system.asset.portion.as_ref().map_or(&[][..], |p| p.cuts());
        let mut cuts = Self::of_list(settled, mesh.positions.len());
        let mut cut_by = index.cut_by(settled);
        for (id, crack) in (0..).zip(&system.cracks) {
            for element in &crack.elements[crack.settled..] {
                let nodes = mesh.tets[element.tet as usize];
                let values = &element.values;
                for (edge, [i, j]) in index.edges.of_tet(element.tet).into_iter().zip(EDGES) {
                    let by = &mut cut_by[edge as usize];
                    if *by == EdgeCut::WHOLE && (values[i] < 0.0) != (values[j] < 0.0) {
                        *by = id;
                        cuts.cut_whole(nodes[i], nodes[j], values[i], values[j], id);
                    }
                }
            }
        }
        (cuts, cut_by)
    }
}
