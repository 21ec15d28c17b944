//! Elimination of fixed unknowns, and expansion of shapes to all unknowns.

use faer::sparse::{SparseColMat, SymbolicSparseColMat};

use crate::eigen::basis::Block;
use crate::eigen::metric::Metric;

/// Unknowns that are left, and their numbers among those.
pub(crate) struct Reduction {
    /// Rising.
    free: Vec<usize>,
    number: Vec<Option<usize>>,
}

impl Reduction {
    /// `None` when no unknown is held. `held`: rising, below `unknowns`.
    pub(crate) fn new(unknowns: usize, held: &[usize]) -> Option<Self> {
        if held.is_empty() {
            return None;
        }
        let mut is_free = vec![true; unknowns];
        for &unknown in held {
            if let Some(free) = is_free.get_mut(unknown) {
                *free = false;
            }
        }
        let free: Vec<usize> = (0..unknowns).filter(|&u| is_free[u]).collect();
        let mut number = vec![None; unknowns];
        for (i, &unknown) in free.iter().enumerate() {
            number[unknown] = Some(i);
        }
        Some(Self { free, number })
    }

    /// Number of unknowns that are left.
    pub(crate) fn unknowns(&self) -> usize {
        self.free.len()
    }

    /// The node of each unknown that is left.
    pub(crate) fn nodes(&self) -> Vec<usize> {
        self.free.iter().map(|unknown| unknown / 3).collect()
    }

    pub(crate) fn is_free(&self, unknown: usize) -> bool {
        self.number[unknown].is_some()
    }

    /// The rows and columns that are left of a lower triangle, of which each entry stands for the `axes` diagonal ones
    /// of a block.
    pub(crate) fn matrix(
        &self,
        lower: &SparseColMat<usize, f64>,
        axes: usize,
    ) -> SparseColMat<usize, f64> {
        let (pattern, all) = lower.parts();
        let (mut starts, mut rows, mut values) = (vec![0], Vec::new(), Vec::new());
        for &unknown in &self.free {
            for entry in pattern.col_range(unknown / axes) {
                let row = axes * pattern.row_idx()[entry] + unknown % axes;
                if let Some(row) = self.number[row] {
                    rows.push(row);
                    values.push(all[entry]);
                }
            }
            starts.push(rows.len());
        }
        let n = self.free.len();
        let symbolic = SymbolicSparseColMat::new_checked(n, n, starts, None, rows);
        SparseColMat::new(symbolic, values)
    }

    pub(crate) fn metric(&self, metric: &Metric) -> Metric {
        match metric {
            Metric::Plain => Metric::Plain,
            Metric::Mass { matrix, axes, .. } => Metric::of_matrix(self.matrix(matrix, *axes), 1),
        }
    }

    /// The numbers of the unknowns that are left, of each column.
    pub(crate) fn columns(&self, all: &Block) -> Block {
        let mut left = Block::zeros(self.free.len(), all.columns());
        for j in 0..all.columns() {
            let from = all.column(j);
            for (to, &unknown) in left.column_mut(j).iter_mut().zip(&self.free) {
                *to = from[unknown];
            }
        }
        left
    }

    /// Columns over all unknowns, zero where they are held.
    pub(crate) fn scatter(&self, left: &Block) -> Block {
        let mut all = Block::zeros(self.number.len(), left.columns());
        for j in 0..left.columns() {
            let to = all.column_mut(j);
            for (from, &unknown) in left.column(j).iter().zip(&self.free) {
                to[unknown] = *from;
            }
        }
        all
    }
}
