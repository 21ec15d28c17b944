//! A small modal analysis of the piece.

use std::sync::Arc;

use crate::eigen::{Constraints, quick_modes};
use frangible::internals::modal::ModalBasis;
use frangible::internals::piece::{Elastic, Portion};

use crate::pieces::PieceError;
use crate::pieces::lattice::Lattice;

/// Computes at most `modes` modes of the piece on about `elements` quadratic elements.
///
/// # Errors
/// The piece has no volume, or its modes cannot be computed.
pub fn reanalysis(
    portion: &Arc<Portion>,
    elements: usize,
    modes: usize,
) -> Result<Elastic, PieceError> {
    let lattice = Lattice::new(portion, elements)?;
    let unknowns = lattice.system.unknowns();
    let modes = modes.min(unknowns.saturating_sub(6) / 6).max(1);
    let places: Vec<_> = portion
        .nodes()
        .iter()
        .map(|&v| portion.root().fracture().positions[v as usize].as_dvec3())
        .collect();
    let held: Vec<[bool; 3]> = if portion.supported().is_empty() {
        Vec::new()
    } else {
        let supported = portion.supported();
        let nodes = portion.nodes().iter();
        nodes
            .map(|v| [supported.binary_search(v).is_ok(); 3])
            .collect()
    };
    let constraints = Constraints::of_places(&places, &held);
    let found = quick_modes(&lattice.system, &constraints, modes)?;
    let count = found.eigenvalues.len();
    let shapes = (0..unknowns)
        .flat_map(|row| (0..count).map(move |mode| (mode, row)))
        .map(|(mode, row)| found.shape(mode)[row] as f32)
        .collect();
    Ok(Elastic {
        analysis: lattice.analysis,
        tets: lattice.tets,
        nodes: lattice.nodes,
        modes: ModalBasis {
            shapes,
            peak_stress: Vec::new(),
            eigenvalues: found.eigenvalues,
            ..ModalBasis::default()
        },
    })
}
