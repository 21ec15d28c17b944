//! Bodies given by their tetrahedra.

use std::sync::Arc;

use frangible::internals::TetMesh;
use frangible_mesh::{NodeGroup, TetBody};

use crate::clusters::cluster;
use crate::error::BakeError;
use crate::groups::Group;
use crate::mesh::BodyMesh;
use crate::shapes::MeshSize;
use crate::shapes::solid::{CELLS, SHELL_ELEMENTS, estimate};

/// Elements of second order up to this number carry the modes themselves unless told otherwise: about 90 000 unknowns.
const MOST_OWN: usize = 20_000;

/// A body with less than this for 2 V / A, in cube roots of its volume V (A: its surface), has thin walls: a cube has
/// 0.33, a ball 0.41.
const THIN: f64 = 0.2;

/// Choice of the analysis mesh for a body given by tetrahedra.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum AnalysisChoice {
    /// Use up to 20 000 quadratic elements of the body; otherwise cover it with a lattice.
    #[default]
    Auto,
    /// Cover the body with a lattice of quadratic elements.
    Cover,
    /// Use the body's own elements, linear or quadratic. Linear elements are too stiff in bending.
    Own,
}

/// Tetrahedra from a file, used unchanged as the fracture mesh, and optionally as the analysis mesh.
#[derive(Clone, Debug)]
pub struct TetShape {
    /// The tetrahedra, m.
    pub body: Arc<TetBody>,
    /// True if they were quadratic elements in the file.
    pub quadratic: bool,
    /// Elements used for the modes.
    pub analysis: AnalysisChoice,
    /// Named parts, by their nodes in `body`.
    pub groups: Arc<Vec<NodeGroup>>,
}

impl TetShape {
    /// Creates a body of linear elements without groups.
    #[must_use]
    pub fn new(body: TetBody) -> Self {
        Self {
            body: Arc::new(body),
            quadratic: false,
            analysis: AnalysisChoice::Auto,
            groups: Arc::default(),
        }
    }

    /// Returns the nodes of the named part.
    #[must_use]
    pub fn group(&self, name: &str) -> Option<&[u32]> {
        let group = self.groups.iter().find(|g| g.name == name)?;
        Some(&group.nodes)
    }

    /// Returns the named parts for supports: their nodes and the outer faces with all three nodes in the part, including the mid-edge nodes.
    /// Parts with the same name are merged.
    #[must_use]
    pub fn named_parts(&self) -> Vec<Group> {
        let faces = self.body.boundary();
        let mut parts: Vec<Group> = Vec::new();
        let mut member = vec![false; self.body.positions.len()];
        for group in self.groups.iter() {
            let nodes = || group.nodes.iter().map(|&v| v as usize);
            nodes().for_each(|v| member[v] = true);
            let at = |v: u32| self.body.positions[v as usize];
            let inside = faces
                .iter()
                .filter(|(face, _)| face.iter().all(|&v| member[v as usize]))
                .map(|(face, _)| face.map(at));
            let points = group.nodes.iter().map(|&v| at(v));
            let known = parts.iter().position(|p| p.name == group.name);
            let place = known.unwrap_or_else(|| {
                parts.push(Group {
                    name: group.name.clone(),
                    ..Group::default()
                });
                parts.len() - 1
            });
            parts[place].triangles.extend(inside);
            parts[place].points.extend(points);
            nodes().for_each(|v| member[v] = false);
        }
        parts
    }

    /// Returns true if the body's own elements are used for the modes.
    #[must_use]
    pub fn carries_modes(&self) -> bool {
        match self.analysis {
            AnalysisChoice::Auto => self.quadratic && self.body.tets.len() <= MOST_OWN,
            AnalysisChoice::Cover => false,
            AnalysisChoice::Own => true,
        }
    }
}

/// Two are equal if they are one and the same list of tetrahedra: comparing large meshes takes as long as reading them.
impl PartialEq for TetShape {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.body, &other.body)
            && (self.quadratic, self.analysis) == (other.quadratic, other.analysis)
            && self.groups == other.groups
    }
}

/// The fracture mesh: the tetrahedra as they are.
pub(crate) fn mesh(shape: &TetShape) -> Result<BodyMesh, BakeError> {
    let body = &shape.body;
    let mesh = TetMesh::new(
        body.positions.iter().map(|p| p.as_vec3()).collect(),
        body.tets.clone(),
    );
    let (cell_of_tet, cells) = cluster(&mesh, CELLS);
    let mesh = BodyMesh {
        positions: body.positions.clone(),
        tets: body.tets.clone(),
        cell_of_tet,
        cells,
    };
    mesh.finish()
}

/// Elements of the lattice that carries the modes.
pub(crate) fn cover_elements(shape: &TetShape, size: Option<MeshSize>) -> usize {
    let volume = shape.body.volume();
    let area: f64 = shape
        .body
        .boundary()
        .iter()
        .map(|(face, _)| {
            let [a, b, c] = face.map(|v| shape.body.positions[v as usize]);
            0.5 * (b - a).cross(c - a).length()
        })
        .sum();
    let thin = 2.0 * volume / area < THIN * volume.cbrt();
    let elements = match size {
        Some(size) => estimate(volume, size),
        None if thin => SHELL_ELEMENTS,
        None => super::ANALYSIS_TETS,
    };
    elements as usize
}
