//! A = D K D with D = diag(M)^-½, and the sparse Cholesky factor of A + sB.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::SparseColMat;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::supernodal::SupernodalLltRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::{Par, Side, Spec};

use crate::eigen::krylov::Krylov;
use crate::eigen::metric::Metric;
use crate::eigen::ordering;
use crate::eigen::panel::Row;
use crate::eigen::portable::{self, Sums};
use crate::eigen::substitution;
use crate::eigen::watch::Watch;
use crate::error::BakeError;
use crate::fem::System;
use crate::phase::Phase;

/// Lower triangle of D K D, 1/s².
pub(crate) fn scale(system: &System, inverse_root: &[f64]) -> SparseColMat<usize, f64> {
    let mut scaled = system.stiffness.clone();
    let (pattern, values) = scaled.parts_mut();
    for j in 0..inverse_root.len() {
        for entry in pattern.col_range(j) {
            values[entry] *= inverse_root[pattern.row_idx()[entry]] * inverse_root[j];
        }
    }
    scaled
}

/// Lower triangle of A + sB.
pub(crate) fn add_shift(
    scaled: &SparseColMat<usize, f64>,
    metric: &Metric,
    shift: f64,
) -> SparseColMat<usize, f64> {
    let mut shifted = scaled.clone();
    let (pattern, values) = shifted.parts_mut();
    match metric {
        Metric::Plain => {
            for &first in &pattern.col_ptr()[..pattern.ncols()] {
                // Lower triangle with sorted rows: the diagonal comes first.
                values[first] += shift;
            }
        }
        Metric::Mass { matrix, axes, .. } => {
            let (blocks, masses) = matrix.parts();
            for j in 0..pattern.ncols() {
                let mut block = blocks.col_range(j / axes).peekable();
                for entry in pattern.col_range(j) {
                    // Rows rise in both, and the stiffness has an entry wherever the mass has one.
                    let row = pattern.row_idx()[entry];
                    if row % axes == j % axes
                        && let Some(at) = block.next_if(|&at| blocks.row_idx()[at] == row / axes)
                    {
                        values[entry] += shift * masses[at];
                    }
                }
            }
        }
    }
    shifted
}

/// The order of the highest eigenvalues, 1/s²: the diagonal of A, since that of B is one. Where elements are
/// cut, the largest entry belongs to some sliver and says nothing, so there the median is taken.
fn highest(scaled: &SparseColMat<usize, f64>, metric: &Metric) -> f64 {
    let mut diagonal: Vec<f64> = (0..scaled.ncols())
        .map(|j| scaled.val_of_col(j)[0])
        .collect();
    match metric {
        Metric::Plain => diagonal.into_iter().fold(0.0, f64::max),
        Metric::Mass { .. } => {
            diagonal.sort_unstable_by(f64::total_cmp);
            diagonal[diagonal.len() / 2]
        }
    }
}

/// Cholesky factor of A + sB.
pub(crate) struct Shifted {
    symbolic: SymbolicCholesky<usize>,
    values: Vec<f64>,
    sums: Sums,
    /// The shift s, 1/s².
    pub(crate) shift: f64,
}

impl Shifted {
    /// Factorizes with a shift a little below the lowest elastic eigenvalue: well above rounding, and
    /// near enough to the wanted end of the spectrum. `node_of`: the node of each unknown, rising.
    pub(crate) fn near_zero(
        scaled: &SparseColMat<usize, f64>,
        node_of: &[usize],
        metric: &Metric,
        rigid: &Krylov<'_>,
        watch: &mut Watch<'_>,
    ) -> Result<Self, BakeError> {
        let symbolic = watch.time(Phase::Ordering, || symbolic(scaled, node_of))?;
        watch.tell(0.02)?;
        let largest = highest(scaled, metric);
        let values = vec![0.0; symbolic.len_val()];
        let mut factor = Self {
            symbolic,
            values,
            sums: rigid.sums,
            shift: 1e-10 * largest,
        };
        watch.time(Phase::Factorization, || factor.refactorize(scaled, metric))?;
        watch.tell(0.05)?;
        let lowest = rigid.lowest_guess(&factor, watch)?.unwrap_or(largest);
        // Measured on plates, bars and vessels: any shift from 1e-4 to 0.5 of the lowest works alike.
        if !(factor.shift > 1e-4 * lowest && factor.shift < 0.5 * lowest) {
            factor.shift = 0.05 * lowest.max(factor.shift * 1e-3);
            watch.time(Phase::Factorization, || factor.refactorize(scaled, metric))?;
        }
        Ok(factor)
    }

    fn refactorize(
        &mut self,
        scaled: &SparseColMat<usize, f64>,
        metric: &Metric,
    ) -> Result<(), BakeError> {
        let shifted = add_shift(scaled, metric, self.shift);
        if self.sums == Sums::Portable {
            let (_, place) = self.order();
            let place = place.to_vec();
            let SymbolicCholeskyRaw::Supernodal(symbolic) = self.symbolic.raw() else {
                unreachable!("a supernodal factor was asked for");
            };
            return match portable::factorise(symbolic, &place, &shifted, &mut self.values) {
                true => Ok(()),
                false => Err(failed("not positive definite")),
            };
        }
        let params = Spec::default();
        let mut memory = MemBuffer::new(
            self.symbolic
                .factorize_numeric_llt_scratch::<f64>(Par::Seq, params),
        );
        self.symbolic
            .factorize_numeric_llt(
                &mut self.values,
                shifted.as_ref(),
                Side::Lower,
                Default::default(),
                Par::Seq,
                MemStack::new(&mut memory),
                params,
            )
            .map_err(failed)?;
        Ok(())
    }

    /// Number of unknowns.
    pub(crate) fn rows(&self) -> usize {
        self.symbolic.nrows()
    }

    /// (A + sB)⁻¹ x.
    pub(crate) fn solve(&self, x: &[Row]) -> Vec<Row> {
        let SymbolicCholeskyRaw::Supernodal(symbolic) = self.symbolic.raw() else {
            unreachable!("a supernodal factor was asked for");
        };
        let (order, place) = self.order();
        let mut permuted: Vec<Row> = order.iter().map(|&i| x[i]).collect();
        match self.sums {
            Sums::Portable => portable::solve(symbolic, &self.values, &mut permuted),
            Sums::Fast => {
                substitution::solve(SupernodalLltRef::new(symbolic, &self.values), &mut permuted);
            }
        }
        place.iter().map(|&i| permuted[i]).collect()
    }

    /// The unknowns in the factor's order, and where each comes in it.
    fn order(&self) -> (&[usize], &[usize]) {
        let Some(order) = self.symbolic.perm() else {
            unreachable!("an order was given");
        };
        order.arrays()
    }
}

/// Pattern of the factor.
fn symbolic(
    scaled: &SparseColMat<usize, f64>,
    node_of: &[usize],
) -> Result<SymbolicCholesky<usize>, BakeError> {
    let order = ordering::by_nodes(scaled, node_of)?;
    factorize_symbolic_cholesky(
        scaled.symbolic(),
        Side::Lower,
        SymmetricOrdering::Custom(order.as_ref()),
        CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..Default::default()
        },
    )
    .map_err(failed)
}

fn failed(error: impl std::fmt::Debug) -> BakeError {
    BakeError::Factorization {
        reason: format!("{error:?}"),
    }
}
