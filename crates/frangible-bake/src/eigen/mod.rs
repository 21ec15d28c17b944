//! Computation of the lowest vibration modes of a free or supported body.
//!
//! K φ = λ M φ becomes A x = λ B x with A = D K D, B = D M D, φ = D x and D = diag(M)^-½; B = I if the
//! mass is lumped. A + sB is factorized once; block Lanczos on (A + sB)⁻¹ B, the six rigid motions
//! deflated analytically, finds the lowest modes: λ = 1/θ − s. Everything runs in a fixed order, so
//! the bits do not depend on the number of threads. Small systems are solved densely.
//!
//! Fixed unknowns of a supported body are eliminated, and only its remaining rigid-body modes are deflated; a clamped body has
//! none.

pub(crate) mod basis;
mod constraints;
pub(crate) mod dense;
mod factor;
mod krylov;
mod lanczos;
mod metric;
mod ordering;
mod panel;
pub(crate) mod portable;
mod reduce;
mod refine;
mod residual;
mod rigid;
mod substitution;
mod watch;

pub use crate::phase::Phase;
pub use constraints::Constraints;
pub use residual::residual;
pub use rigid::{remaining_motions, rigid_motions};

use std::ops::ControlFlow;

use crate::error::BakeError;
use crate::fem::System;
use basis::Block;
use factor::Shifted;
use krylov::Krylov;
use metric::Metric;
use portable::Sums;
use reduce::Reduction;
use watch::Watch;

/// Share of the work that is done when the modes are found and not yet checked.
const FIRST_ATTEMPT: f64 = 0.95;

/// Accuracy that modes must have.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Accuracy {
    /// Unknowns up to which the dense solver is used, which is exact.
    dense: usize,
    /// Requested modes per unknown above which the dense solver is also used.
    share: f64,
    /// Relative residual at which a Ritz pair of the inverse has converged.
    tolerance: f64,
    /// Required relative residual of every mode, unless rounding prevents it.
    residual: f64,
    /// Method of summation.
    sums: Sums,
}

impl Accuracy {
    /// The accuracy of a bake. A residual of A is as large after purification as the tolerance; this leaves a digit to the check in the
    /// plain norm, which weighs nodes differently.
    const BAKED: Self = Self {
        dense: 800,
        share: 0.2,
        tolerance: 1e-9,
        residual: 1e-8,
        sums: Sums::Fast,
    };

    /// The accuracy for a piece while others wait for it: frequencies to 1e-6 or so, since their error is the square of the residual.
    const QUICK: Self = Self {
        dense: 150,
        share: 0.4,
        tolerance: 1e-4,
        residual: 0.1,
        sums: Sums::Portable,
    };

    /// Returns true if the dense solver finds the modes of this number of unknowns.
    fn is_dense(&self, unknowns: usize, wanted: usize) -> bool {
        unknowns <= self.dense || wanted as f64 > unknowns as f64 * self.share
    }
}

/// Mass-normalized modes Φᵀ M Φ = I, in order of ascending frequency.
#[derive(Clone, Debug)]
pub struct Modes {
    /// Eigenvalues λ = ω², 1/s².
    pub eigenvalues: Vec<f64>,
    /// Mode shapes, 1/√kg, stored consecutively: entry `mode * unknowns + 3 * node + axis`.
    pub shapes: Vec<f64>,
    /// Number of unknowns, three per node.
    pub unknowns: usize,
    /// Largest relative residual ‖Kφ − λMφ‖ / ‖Kφ‖ of all modes.
    pub max_residual: f64,
    /// Number of rigid-body modes: six for a free body, none for a clamped one.
    pub rigid_motions: usize,
    /// Wall-clock time of each phase, s.
    pub seconds: Vec<(Phase, f64)>,
}

impl Modes {
    /// Returns the shape of mode `i`, one number per unknown.
    #[must_use]
    pub fn shape(&self, i: usize) -> &[f64] {
        &self.shapes[i * self.unknowns..(i + 1) * self.unknowns]
    }

    /// Returns the frequency of mode `i`, Hz.
    #[must_use]
    pub fn frequency(&self, i: usize) -> f64 {
        self.eigenvalues[i].sqrt() / std::f64::consts::TAU
    }
}

/// Computes the `wanted` lowest elastic modes.
///
/// `progress` receives the completed fraction, 0..=1 and non-decreasing, at least once every eight solves; returning
/// [`ControlFlow::Break`] cancels the computation.
///
/// # Errors
/// [`BakeError::Cancelled`] if `progress` cancels.
/// More modes are requested than exist, the stiffness cannot be factorized, or the residual of a mode
/// stays above max(1e-8 ‖Kφ‖, 10 ε ‖|K||φ|‖).
pub fn lowest_modes(
    system: &System,
    wanted: usize,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Modes, BakeError> {
    lowest_supported_modes(system, &Constraints::default(), wanted, progress)
}

/// Computes the lowest modes of a supported body. Shapes have an entry for every unknown, zero for fixed ones.
///
/// # Errors
/// Errors of [`lowest_modes`], and [`BakeError::AllHeld`] if all unknowns are fixed.
pub fn lowest_supported_modes(
    system: &System,
    constraints: &Constraints,
    wanted: usize,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Modes, BakeError> {
    search(system, constraints, wanted, Accuracy::BAKED, progress)
}

/// Computes the lowest modes quickly at reduced accuracy, for use at run time: frequencies are accurate to six digits, residuals of
/// shapes may be a few per cent. The result is bit-identical on every machine.
///
/// # Errors
/// Errors of [`lowest_supported_modes`], but the limit of the relative residual is 0.1.
pub fn quick_modes(
    system: &System,
    constraints: &Constraints,
    wanted: usize,
) -> Result<Modes, BakeError> {
    let flow = &mut |_| ControlFlow::Continue(());
    search(system, constraints, wanted, Accuracy::QUICK, flow)
}

/// The lowest modes. Where one of them is not exact enough in the end, all are sought once more to a tenth of the tolerance: the check weighs
/// nodes otherwise than the search does, which tells on meshes of very different elements. The dense solver has no tolerance and is not asked again.
fn search(
    system: &System,
    constraints: &Constraints,
    wanted: usize,
    accuracy: Accuracy,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Modes, BakeError> {
    let left = system
        .unknowns()
        .saturating_sub(constraints.unknowns().len());
    match attempt(system, constraints, wanted, accuracy, progress) {
        Err(BakeError::Residual { .. }) if !accuracy.is_dense(left, wanted) => {
            let finer = Accuracy {
                tolerance: 0.1 * accuracy.tolerance,
                ..accuracy
            };
            let progress = &mut |share| progress(FIRST_ATTEMPT + (1.0 - FIRST_ATTEMPT) * share);
            attempt(system, constraints, wanted, finer, progress)
        }
        found => found,
    }
}

fn attempt(
    system: &System,
    constraints: &Constraints,
    wanted: usize,
    accuracy: Accuracy,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Modes, BakeError> {
    let reduction = Reduction::new(system.unknowns(), constraints.unknowns());
    let reduction = reduction.as_ref();
    let n = reduction.map_or(system.unknowns(), Reduction::unknowns);
    if n == 0 {
        return Err(BakeError::AllHeld);
    }
    let remaining = remaining_motions(system, constraints);
    let available = n.saturating_sub(remaining.len());
    if wanted == 0 || wanted > available {
        return Err(BakeError::Modes { wanted, available });
    }
    let mut watch = Watch::new(progress);
    watch.tell(0.0)?;
    let diagonal = system.mass.diagonal();
    let inverse_root: Vec<f64> = (0..system.unknowns())
        .map(|i| 1.0 / diagonal[i / 3].sqrt())
        .collect();
    let (scaled, metric) = watch.time(Phase::Ordering, || {
        let metric = Metric::new(&system.mass, &inverse_root);
        let scaled = factor::scale(system, &inverse_root);
        match reduction {
            Some(reduction) => (reduction.matrix(&scaled, 1), reduction.metric(&metric)),
            None => (scaled, metric),
        }
    });
    let rigid = rigid::deflation_basis(system, &remaining, reduction, &metric)?;
    let node_of = reduction.map_or_else(|| (0..n).map(|i| i / 3).collect(), Reduction::nodes);
    let basis = Krylov::new(&metric, &rigid, accuracy.sums);
    let shifted = Shifted::near_zero(&scaled, &node_of, &metric, &basis, &mut watch)?;
    watch.tell(0.1)?;
    let (mut eigenvalues, mut vectors) = if accuracy.is_dense(n, wanted) {
        let matrix = factor::add_shift(&scaled, &metric, shifted.shift);
        watch.time(Phase::Solves, || {
            dense::solve_shifted(
                &matrix,
                shifted.shift,
                &metric,
                &rigid,
                wanted,
                accuracy.sums,
            )
        })?
    } else {
        lanczos::solve(&shifted, basis, wanted, accuracy.tolerance, &mut watch)?
    };
    watch.tell(FIRST_ATTEMPT)?;
    let found = |eigenvalues: &[f64], vectors: &Block| {
        let vectors = match reduction {
            Some(reduction) => reduction.scatter(vectors),
            None => vectors.clone(),
        };
        let mut modes = finish(eigenvalues.to_vec(), vectors, &inverse_root);
        modes.rigid_motions = remaining.len();
        modes
    };
    let mut modes = found(&eigenvalues, &vectors);
    let mut checked = watch.time(Phase::ResidualCheck, || {
        residual::check(system, reduction, &modes, accuracy.residual)
    });
    if matches!(checked, Err(BakeError::Residual { .. })) {
        watch.time(Phase::Solves, || {
            refine::refine(
                &scaled,
                &metric,
                &rigid,
                &shifted,
                &mut eigenvalues,
                &mut vectors,
            );
        });
        modes = found(&eigenvalues, &vectors);
        checked = watch.time(Phase::ResidualCheck, || {
            residual::check(system, reduction, &modes, accuracy.residual)
        });
    }
    modes.max_residual = checked?;
    watch.tell(1.0)?;
    modes.seconds = watch.seconds();
    Ok(modes)
}

/// Back to displacements, each shape's largest component positive.
fn finish(eigenvalues: Vec<f64>, vectors: Block, inverse_root: &[f64]) -> Modes {
    let unknowns = inverse_root.len();
    let mut shapes = vectors.data;
    for shape in shapes.chunks_exact_mut(unknowns) {
        for (x, scale) in shape.iter_mut().zip(inverse_root) {
            *x *= scale;
        }
        let largest = shape.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        // Symmetric bodies have several largest components; the first of them decides, rounding aside.
        let first = shape.iter().find(|x| x.abs() > largest * (1.0 - 1e-6));
        if first.is_some_and(|x| *x < 0.0) {
            shape.iter_mut().for_each(|x| *x = -*x);
        }
    }
    Modes {
        eigenvalues,
        shapes,
        unknowns,
        max_residual: 0.0,
        rigid_motions: 0,
        seconds: Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;

    use super::{Accuracy, Constraints, Sums, attempt, search};
    use crate::error::BakeError;
    use crate::fem::{Elasticity, Elements, QuadraticMesh, System, assemble};
    use crate::{MeshSize, Shape};

    /// A plate whose elements grow from one end to the other, so that the check and the search weigh nodes differently.
    fn graded_plate() -> System {
        let (length, edge) = (0.12, 0.008);
        let size = MeshSize { edge, layers: 1 };
        let plate = Shape::plate(length, 0.07, 0.004);
        let mut mesh = plate.analysis_mesh(size).unwrap();
        for position in &mut mesh.positions {
            position[0] = length * (position[0] / length + 0.5).powi(2);
        }
        let mesh = QuadraticMesh::new(&mesh);
        let glass = Elasticity {
            youngs_modulus: 70e9,
            poisson_ratio: 0.23,
            density: 2500.0,
        };
        assemble(&mesh.positions, Elements::Quadratic(&mesh.elements), &glass)
    }

    #[test]
    fn modes_that_are_not_exact_enough_are_sought_once_more() {
        let (system, free) = (graded_plate(), Constraints::default());
        // Eight modes: 1.8e-8 at this tolerance, 1.3e-9 at a tenth of it.
        let loose = Accuracy {
            dense: 0,
            share: 1.0,
            tolerance: 1e-4,
            residual: 5e-9,
            sums: Sums::Fast,
        };
        let mut shares = Vec::new();
        let mut hear = |share| {
            shares.push(share);
            ControlFlow::Continue(())
        };
        let once = attempt(&system, &free, 8, loose, &mut |_| ControlFlow::Continue(()));
        assert!(matches!(once, Err(BakeError::Residual { .. })));
        let modes = search(&system, &free, 8, loose, &mut hear).unwrap();
        println!("{:e}", modes.max_residual);
        assert!(modes.max_residual <= loose.residual);
        assert!(shares.is_sorted() && shares.last() == Some(&1.0));
    }

    #[test]
    fn portable_sums_find_the_same_modes() {
        let plate = |edge: f64| {
            let mesh = Shape::plate(0.12, 0.07, 0.004);
            let mesh = mesh.analysis_mesh(MeshSize { edge, layers: 1 }).unwrap();
            let mesh = QuadraticMesh::new(&mesh);
            let glass = Elasticity {
                youngs_modulus: 70e9,
                poisson_ratio: 0.23,
                density: 2500.0,
            };
            assemble(&mesh.positions, Elements::Quadratic(&mesh.elements), &glass)
        };
        // The second is small enough for the dense solver.
        for (edge, wanted) in [(0.008, 30), (0.08, 5)] {
            let (system, free) = (plate(edge), Constraints::default());
            let [fast, portable] = [Sums::Fast, Sums::Portable].map(|sums| {
                let accuracy = Accuracy {
                    sums,
                    ..Accuracy::QUICK
                };
                let flow = &mut |_| ControlFlow::Continue(());
                search(&system, &free, wanted, accuracy, flow).unwrap()
            });
            println!("{} unknowns", system.unknowns());
            for ((phase, fast), (_, portable)) in fast.seconds.iter().zip(&portable.seconds) {
                println!("{phase}: {:.2} ms, {:.2} ms", 1e3 * fast, 1e3 * portable);
            }
            for (a, b) in fast.eigenvalues.iter().zip(&portable.eigenvalues) {
                // Both stop at residuals of 1e-4, whose square the eigenvalues are off by.
                assert!((a / b - 1.0).abs() < 1e-6, "{a} {b}");
            }
        }
    }
}
