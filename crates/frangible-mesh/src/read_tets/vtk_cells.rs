//! Cells of VTK's unstructured grids, the same in both of its formats.

use super::builder::{Builder, other_cells};
use crate::read::ReadError;

/// Names of cell data that say which group a cell is of, in lower case: of meshio, Gmsh, TetGen, ParaView and others.
const GROUP_NAMES: [&str; 16] = [
    "gmsh:physical",
    "medit:ref",
    "cellentityids",
    "physicalids",
    "physical",
    "materialids",
    "material",
    "material_id",
    "region",
    "regionid",
    "marker",
    "markers",
    "cell_tags",
    "cell_markers",
    "attribute",
    "tetgen:ref",
];

/// Rank of a name of cell data as a source of groups; higher is better.
pub(super) fn rank(name: &str) -> Option<usize> {
    let name = name.to_ascii_lowercase();
    let at = GROUP_NAMES.iter().position(|&known| known == name)?;
    Some(GROUP_NAMES.len() - at)
}

/// Cells of one piece: type of each, and where its nodes end in `connectivity`.
#[derive(Default)]
pub(super) struct Cells {
    pub(super) kinds: Vec<i64>,
    pub(super) ends: Vec<u64>,
    pub(super) connectivity: Vec<u64>,
    /// Group of each cell, or empty.
    pub(super) groups: Vec<i64>,
}

impl Cells {
    /// Adds the cells whose nodes are counted from `first` on; `done` cells came before.
    pub(super) fn add_to(
        &self,
        builder: &mut Builder,
        first: u64,
        nodes: u64,
        done: u64,
    ) -> Result<(), ReadError> {
        if self.kinds.len() != self.ends.len() {
            let problem = format!(
                "{} cells have a type, but {} have nodes",
                self.kinds.len(),
                self.ends.len()
            );
            return Err(ReadError::malformed("the cells", problem));
        }
        let mut shifted = Vec::new();
        let mut start = 0;
        for (c, (&kind, &end)) in self.kinds.iter().zip(&self.ends).enumerate() {
            let number = done + c as u64;
            let wrong = |problem: String| ReadError::malformed(format!("cell {number}"), problem);
            let range = usize::try_from(start)
                .ok()
                .zip(usize::try_from(end).ok())
                .and_then(|(start, end)| self.connectivity.get(start..end));
            let Some(cell) = range else {
                return Err(wrong("its nodes lie outside the list of nodes".into()));
            };
            start = end;
            if let Some(&node) = cell.iter().find(|&&node| node >= nodes) {
                let problem = format!("it refers to node {node}, but there are only {nodes}");
                return Err(wrong(problem));
            }
            let group = self.groups.get(c).copied().filter(|&g| g != 0);
            shifted.clear();
            shifted.extend(cell.iter().map(|&node| first + node));
            let wanted = match kind {
                10 => 4,
                24 => 10,
                5 => 3,
                22 => 6,
                _ => shifted.len(),
            };
            if shifted.len() != wanted {
                let problem = format!("it has {} nodes, but its type has {wanted}", shifted.len());
                return Err(wrong(problem));
            }
            match kind {
                10 | 24 => builder.tet(number, &shifted, group.as_slice())?,
                5 | 22 => builder.face(&shifted, group.as_slice())?,
                // Points, lines, polygons of any order.
                0..=4 | 6..=9 | 21 | 23 | 28 | 30 | 34..=36 | 68..=70 => {}
                11 | 12 | 25 | 29 | 33 | 72 => return Err(other_cells("hexahedra")),
                13 | 15 | 16 | 26 | 31 | 32 | 73 => return Err(other_cells("prisms")),
                14 | 27 | 37 | 74 => return Err(other_cells("pyramids")),
                42 => return Err(other_cells("polyhedra")),
                _ => {
                    let needs = format!("cells of VTK type {kind}");
                    return Err(ReadError::Unsupported(needs));
                }
            }
        }
        Ok(())
    }
}
