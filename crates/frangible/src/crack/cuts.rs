//! The mesh edges that the cracks of an impact have cut `[G12 §6.3]`.

use super::system::CrackSystem;
use crate::mesh::EDGES;
use crate::state::Cuts;

impl Cuts {
    /// Cuts that are settled, of a piece since it is one; then those of every fractured tetrahedron, cracks in order of
    /// their start; the first crack places the point.
    pub(crate) fn of_fractured_elements(system: &CrackSystem) -> Self {
        let mesh = &system.asset.fracture;
        let settled = system.asset.portion.as_ref().map_or(&[][..], |p| p.cuts());
        let mut cuts = Self::of_list(settled, mesh.positions.len());
        for (id, crack) in system.cracks.iter().enumerate() {
            for element in &crack.elements[crack.settled..] {
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
}
