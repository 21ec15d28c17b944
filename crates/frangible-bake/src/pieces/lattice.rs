//! Analysis elements of a piece: a covering lattice, integrated over the piece's tetrahedra.

use std::sync::Arc;

use crate::BodyMesh;
use crate::fem::{Cover, Elasticity, System, assemble_supported_cover};
use frangible::internals::asset::{AnalysisMesh, EmbeddedPoint};
use frangible::internals::piece::Portion;

use crate::pieces::PieceError;

/// Elements over a piece, its stiffness and mass.
pub(crate) struct Lattice {
    /// The elements, in the form that an asset stores.
    pub(crate) analysis: AnalysisMesh,
    /// Places of the centroids of the portion's uncut tetrahedra in the elements.
    pub(crate) tets: Vec<EmbeddedPoint>,
    /// Places of its nodes in the elements.
    pub(crate) nodes: Vec<EmbeddedPoint>,
    /// K and M, with the springs that hold it.
    pub(crate) system: System,
}

impl Lattice {
    /// About `elements` elements.
    ///
    /// # Errors
    /// A piece without volume.
    pub(crate) fn new(portion: &Arc<Portion>, elements: usize) -> Result<Self, PieceError> {
        let solid = portion.solid();
        let body = BodyMesh {
            cell_of_tet: vec![0; solid.tets.len()],
            cells: 1,
            positions: solid.positions,
            tets: solid.tets,
        };
        let cover = Cover::of_joined(&body, &solid.joined, elements)?;
        let mut held = vec![[false; 3]; body.positions.len()];
        for v in portion.supported() {
            if let Ok(place) = portion.nodes().binary_search(v) {
                held[place] = [true; 3];
            }
        }
        if portion.supported().is_empty() {
            held.clear();
        }
        let elasticity = Elasticity::from(portion.root().material());
        let system = assemble_supported_cover(&cover, &elasticity, &body, &held);
        let mut embedding = cover.embedding(&body);
        embedding.tets.truncate(portion.tets().len());
        embedding.nodes.truncate(portion.nodes().len());
        Ok(Self {
            analysis: cover.analysis_mesh(),
            tets: embedding.tets,
            nodes: embedding.nodes,
            system,
        })
    }
}
