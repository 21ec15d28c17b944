//! Lumped and consistent mass matrices. The three axes are uncoupled.

use faer::sparse::SparseColMat;

/// Mass matrix of the nodes, the same for each of the three axes.
#[derive(Clone, Debug)]
pub enum Mass {
    /// Mass of each node, kg.
    Lumped(Vec<f64>),
    /// Lower triangle of ∫ ρ N_a N_b over pairs of nodes, kg; rows ascend within a column.
    Consistent(SparseColMat<usize, f64>),
}

impl Mass {
    /// Returns the number of nodes.
    #[must_use]
    pub fn nodes(&self) -> usize {
        match self {
            Self::Lumped(mass) => mass.len(),
            Self::Consistent(matrix) => matrix.ncols(),
        }
    }

    /// Returns the diagonal of the matrix, kg.
    #[must_use]
    pub fn diagonal(&self) -> Vec<f64> {
        match self {
            Self::Lumped(mass) => mass.clone(),
            // Lower triangle with sorted rows: the diagonal comes first.
            Self::Consistent(matrix) => (0..matrix.ncols())
                .map(|j| matrix.val_of_col(j)[0])
                .collect(),
        }
    }

    /// Returns the sum of each row, kg: the part of the body's mass assigned to the node. It may be negative at corners.
    #[must_use]
    pub fn row_sums(&self) -> Vec<f64> {
        match self {
            Self::Lumped(mass) => mass.clone(),
            Self::Consistent(matrix) => {
                let mut sums = vec![0.0; matrix.ncols()];
                multiply_symmetric(matrix, 1, &vec![1.0; matrix.ncols()], &mut sums);
                sums
            }
        }
    }

    /// Returns M x for a vector of 3 × nodes numbers.
    #[must_use]
    pub fn multiply(&self, x: &[f64]) -> Vec<f64> {
        match self {
            Self::Lumped(mass) => x.iter().enumerate().map(|(i, x)| mass[i / 3] * x).collect(),
            Self::Consistent(matrix) => {
                let mut y = vec![0.0; x.len()];
                multiply_symmetric(matrix, 3, x, &mut y);
                y
            }
        }
    }
}

/// y += (S ⊗ I) x, where the lower triangle of S is given and I has `axes` rows.
pub(crate) fn multiply_symmetric(
    lower: &SparseColMat<usize, f64>,
    axes: usize,
    x: &[f64],
    y: &mut [f64],
) {
    let (pattern, values) = lower.parts();
    for j in 0..lower.ncols() {
        let range = pattern.col_range(j);
        for (&i, &value) in pattern.row_idx()[range.clone()].iter().zip(&values[range]) {
            for axis in 0..axes {
                y[axes * i + axis] += value * x[axes * j + axis];
                if i != j {
                    y[axes * j + axis] += value * x[axes * i + axis];
                }
            }
        }
    }
}
