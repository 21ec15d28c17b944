//! Checks that elements, points in them and mode shapes on them can carry a motion: those of a baked body, and those of a piece.

use super::rows::{Check, all, below, finite, one_each};
use crate::asset::{AnalysisMesh, EmbeddedPoint};
use crate::modal::ModalBasis;

/// Checks that elements name nodes that are there, and that all their numbers are finite.
pub(crate) fn analysis(analysis: &AnalysisMesh) -> Check {
    let (nodes, elements) = (analysis.nodes.len(), analysis.elements.len());
    finite("analysis node", &analysis.nodes)?;
    below("analysis element", &analysis.elements, nodes, "node")?;
    let gradients = analysis.barycentric_gradients.len();
    one_each("analysis element", elements, "gradient row", gradients)?;
    all(
        &analysis.barycentric_gradients,
        |g| g.iter().all(|g| g.is_finite()),
        |e| format!("a barycentric gradient of analysis element {e} is not finite"),
    )
}

/// Checks that points lie in elements that are there, and that all their numbers are finite.
pub(crate) fn embedded(what: &str, points: &[EmbeddedPoint], elements: usize) -> Check {
    all(
        points,
        |p| (p.element as usize) < elements,
        |i| {
            format!(
                "embedded {what} {i} refers to an analysis element beyond the {elements} that exist"
            )
        },
    )?;
    let sound =
        |p: &EmbeddedPoint| p.barycentric.iter().all(|b| b.is_finite()) && p.offset.is_finite();
    all(points, sound, |i| {
        format!("embedded {what} {i} is not finite")
    })
}

/// Checks that mode shapes fit so many nodes, and that eigenvalues are positive and rise. Peak stresses are not checked.
pub(crate) fn modes(modes: &ModalBasis, nodes: usize) -> Check {
    let (count, rows) = (modes.count(), nodes.saturating_mul(3));
    if modes.shapes.len() != rows.saturating_mul(count) {
        return Err(format!(
            "mode shapes hold {} numbers, not {rows} × {count}",
            modes.shapes.len()
        ));
    }
    if modes.residual_modes > 0 && modes.residual_modes >= count {
        return Err(format!(
            "{} of its {count} modes respond statically, which leaves none to integrate through time; integrate at least one",
            modes.residual_modes
        ));
    }
    all(
        &modes.eigenvalues,
        |&l| l.is_finite() && l > 0.0,
        |i| format!("the eigenvalue of mode {i} is not a finite number above zero"),
    )?;
    if !modes.eigenvalues.is_sorted() {
        return Err("the modes are not sorted by rising frequency".into());
    }
    // A fold over a row has no early exit, so that the compiler can test many numbers at once.
    let mut shapes = modes.shapes.chunks(count.max(1));
    let bad = shapes.position(|row| !row.iter().fold(true, |ok, x| ok & x.is_finite()));
    bad.map_or(Ok(()), |row| {
        Err(format!("row {row} of the mode shapes is not finite"))
    })
}
