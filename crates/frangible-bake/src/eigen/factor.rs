//! A = D K D with D = diag(M)^-½, and the sparse Cholesky factor of A + sB.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::SparseColMat;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::{Conj, MatMut, Par, Side, Spec};

use crate::eigen::basis::{Block, dot};
use crate::eigen::metric::{Basis, Metric};
use crate::error::BakeError;
use crate::fem::System;
use crate::random;

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
        Metric::Mass { matrix, axes } => {
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
    /// The shift s, 1/s².
    pub(crate) shift: f64,
}

impl Shifted {
    /// Factorizes with a shift a little below the lowest elastic eigenvalue: well above rounding, and
    /// near enough to the wanted end of the spectrum.
    pub(crate) fn near_zero(
        scaled: &SparseColMat<usize, f64>,
        metric: &Metric,
        rigid: &Basis,
    ) -> Result<Self, BakeError> {
        let n = rigid.vectors.rows;
        let symbolic = factorize_symbolic_cholesky(
            scaled.symbolic(),
            Side::Lower,
            SymmetricOrdering::Amd,
            CholeskySymbolicParams {
                supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
                ..Default::default()
            },
        )
        .map_err(|e| BakeError::Factorization {
            reason: format!("{e:?}"),
        })?;
        let largest = highest(scaled, metric);
        let values = vec![0.0; symbolic.len_val()];
        let mut factor = Self {
            symbolic,
            values,
            shift: 1e-10 * largest,
        };
        factor.refactorize(scaled, metric)?;
        // A few inverse iterations tell the order of the lowest elastic eigenvalue.
        let mut x = Block::zeros(n, 1);
        x.data
            .iter_mut()
            .enumerate()
            .for_each(|(i, v)| *v = random::symmetric(7, i as u64));
        let mut lowest = largest;
        for _ in 0..4 {
            rigid.project_out_all(&mut x);
            let length = dot(&x.data, &metric.image(&x).data).sqrt();
            x.data.iter_mut().for_each(|v| *v /= length);
            x = metric.image(&x).into_owned();
            factor.solve(&mut x);
            rigid.project_out_all(&mut x);
            lowest = 1.0 / dot(&x.data, &metric.image(&x).data).sqrt() - factor.shift;
        }
        // Measured on plates, bars and vessels: any shift from 1e-4 to 0.5 of the lowest works alike.
        if !(factor.shift > 1e-4 * lowest && factor.shift < 0.5 * lowest) {
            factor.shift = 0.05 * lowest.max(factor.shift * 1e-3);
            factor.refactorize(scaled, metric)?;
        }
        Ok(factor)
    }

    fn refactorize(
        &mut self,
        scaled: &SparseColMat<usize, f64>,
        metric: &Metric,
    ) -> Result<(), BakeError> {
        let shifted = add_shift(scaled, metric, self.shift);
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
            .map_err(|e| BakeError::Factorization {
                reason: format!("{e:?}"),
            })?;
        Ok(())
    }

    /// Replaces the columns of `x` by (A + sB)⁻¹ x. Columns are shared out in fixed groups, so the
    /// result does not depend on the number of threads.
    pub(crate) fn solve(&self, x: &mut Block) {
        /// Right-hand sides per group: enough to use the factor well each time it is read.
        const GROUP: usize = 8;
        let rows = x.rows;
        let solve_group = |group: &mut [f64]| {
            let columns = group.len() / rows;
            let mut memory = MemBuffer::new(
                self.symbolic
                    .solve_in_place_scratch::<f64>(columns, Par::Seq),
            );
            LltRef::new(&self.symbolic, &self.values).solve_in_place_with_conj(
                Conj::No,
                MatMut::from_column_major_slice_mut(group, rows, columns),
                Par::Seq,
                MemStack::new(&mut memory),
            );
        };
        let groups: Vec<&mut [f64]> = x.data.chunks_mut(GROUP * rows).collect();
        if groups.len() == 1 {
            groups.into_iter().for_each(solve_group);
        } else {
            std::thread::scope(|scope| {
                for group in groups {
                    scope.spawn(|| solve_group(group));
                }
            });
        }
    }
}
