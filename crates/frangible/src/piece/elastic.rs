//! Vibration of a piece, and creation of a body for it.

use std::sync::Arc;

use super::Portion;
use crate::asset::{self, AnalysisMesh, Asset, EmbeddedPoint, Embedding, StressBounds};
use crate::body::Body;
use crate::error::InputError;
use crate::modal::ModalBasis;
use crate::stress::Search;

/// Elastic model of a [`Portion`]: its analysis elements and the modes of the piece.
///
/// Everything is in the frame of the fracture mesh.
#[derive(Clone, Debug)]
pub struct Elastic {
    /// Quadratic elements.
    pub analysis: AnalysisMesh,
    /// Centroids of [`Portion::tets`], located in these elements, one each.
    pub tets: Vec<EmbeddedPoint>,
    /// [`Portion::nodes`], located in these elements, one each.
    pub nodes: Vec<EmbeddedPoint>,
    /// Modes of the piece, without its rigid motions. [`ModalBasis::peak_stress`] may be empty.
    pub modes: ModalBasis,
}

impl Elastic {
    /// Checks its numbers; the error says, as a clause, what is wrong.
    fn check(&self) -> Result<(), String> {
        asset::analysis(&self.analysis)?;
        let elements = self.analysis.elements.len();
        asset::embedded("centroid", &self.tets, elements)?;
        asset::embedded("node", &self.nodes, elements)?;
        asset::modes(&self.modes, self.analysis.nodes.len())
    }
}

/// Method of computing the modes of pieces.
pub trait PieceModel: Send + Sync {
    /// Elastic body that serves from the break on; `None` if the piece is not to break, or not yet. `parent`: the body that broke.
    fn at_once(&self, portion: &Arc<Portion>, parent: &Body) -> Option<Elastic>;

    /// Elastic body that takes its place some steps later, made by a worker meanwhile; `None` if nothing does.
    fn later(&self, portion: &Arc<Portion>) -> Option<Elastic>;

    /// Expected times of one thread for [`PieceModel::at_once`] and for [`PieceModel::later`], s, for a piece of so many tetrahedra: a
    /// rule that gives the same number on every machine. A world that paces its work goes by it.
    fn expected_times(&self, _tets: usize) -> [f64; 2] {
        [0.0; 2]
    }
}

impl Body {
    /// Creates a body for a piece of this body, or this body again with other modes.
    ///
    /// It has the piece's share of the weak points, strengths and cracks, the same seed, and its own [asset](Body::asset), which
    /// shares the fracture mesh.
    ///
    /// # Errors
    /// The portion belongs to another body, or the elastic model does not match the portion.
    #[doc(hidden)]
    pub fn piece(&self, portion: &Arc<Portion>, elastic: Elastic) -> Result<Self, InputError> {
        let root = portion.root();
        let (tets, nodes) = (portion.tets(), portion.nodes());
        let misfit = |problem: &str| InputError::Asset {
            asset: root.name.clone(),
            problem: format!("the elastic body of a piece is invalid: {problem}"),
        };
        if !Arc::ptr_eq(&self.asset.fracture, &root.fracture) {
            return Err(InputError::Asset {
                asset: root.name.clone(),
                problem: "the portion belongs to another body; pass it to the body that broke"
                    .into(),
            });
        }
        if elastic.tets.len() != tets.len() || elastic.nodes.len() != nodes.len() {
            return Err(misfit(
                "it does not have one point for each tetrahedron and node",
            ));
        }
        elastic.check().map_err(|problem| misfit(&problem))?;
        let modes = elastic.modes;
        let search = Search::new(&elastic.analysis);
        let origin = portion.origin();
        let vertices = portion.positions.iter().zip(&portion.trace.anchors);
        let on_surface = vertices.map(|(&p, anchor)| {
            let beside = match nodes.binary_search(anchor) {
                Ok(place) | Err(place) => &elastic.nodes[place.min(nodes.len() - 1)],
            };
            search.embed((p.as_dvec3() + origin).as_vec3(), beside.element)
        });
        let embedding = Embedding {
            nodes: on_surface.collect(),
            tets: elastic.tets,
        };
        let asset = Asset {
            name: root.name.clone(),
            material: root.material.clone(),
            fracture: Arc::clone(&root.fracture),
            surface: portion.surface.clone(),
            analysis: elastic.analysis,
            embedding,
            modes,
            bounds: StressBounds::default(),
            mass: *portion.mass(),
            cells: Vec::new(),
            cell_of_tet: Vec::new(),
            supported: portion.supported().to_vec(),
            render: None,
            portion: Some(Arc::clone(portion)),
        };
        let own = self.weak_tets().iter().copied();
        let weak_tets = own.filter(|e| tets.binary_search(e).is_ok()).collect();
        Ok(self.part(asset, weak_tets, portion.state.clone()))
    }
}
