//! Sparsity pattern of assembled matrices: lower triangles, three unknowns per node.

use faer::sparse::{SparseColMat, SymbolicSparseColMat};

/// Non-zero 3 × 3 blocks of the lower triangle, by node column.
#[derive(Clone, Debug)]
pub(crate) struct Pattern {
    nodes: usize,
    /// (column, row) of every node pair that shares an element, column ≤ row, sorted.
    pairs: Vec<(u32, u32)>,
    /// Blocks of node column c lie at `starts[c]..starts[c + 1]`, the diagonal one first.
    starts: Vec<usize>,
    /// First entry of each of the 3 × nodes columns.
    col_ptr: Vec<usize>,
}

impl Pattern {
    pub(crate) fn new<const N: usize>(nodes: usize, elements: &[[u32; N]]) -> Self {
        let mut pairs: Vec<(u32, u32)> = Vec::with_capacity(elements.len() * N * (N + 1) / 2);
        for element in elements {
            for (a, &row) in element.iter().enumerate() {
                pairs.extend(
                    element[..=a]
                        .iter()
                        .map(|&column| (row.min(column), row.max(column))),
                );
            }
        }
        pairs.sort_unstable();
        pairs.dedup();
        let mut starts = vec![0_usize; nodes + 1];
        for &(column, _) in &pairs {
            starts[column as usize + 1] += 1;
        }
        for c in 0..nodes {
            starts[c + 1] += starts[c];
        }
        let mut col_ptr = vec![0];
        let mut entries = 0_usize;
        for c in 0..nodes {
            for axis in 0..3 {
                // The diagonal block gives its lower triangle only.
                entries += (3 * (starts[c + 1] - starts[c])).saturating_sub(axis);
                col_ptr.push(entries);
            }
        }
        Self {
            nodes,
            pairs,
            starts,
            col_ptr,
        }
    }

    /// Number of entries of a matrix with three unknowns per node.
    pub(crate) fn entries(&self) -> usize {
        self.col_ptr[self.col_ptr.len() - 1]
    }

    /// Number of entries of a matrix with one unknown per node.
    pub(crate) fn blocks(&self) -> usize {
        self.pairs.len()
    }

    fn block(&self, row: u32, column: u32) -> usize {
        let c = column as usize;
        self.pairs[self.starts[c]..self.starts[c + 1]].partition_point(|p| p.1 < row)
    }

    /// Adds an element's 3 × 3 blocks of the node pairs (a, b), b ≤ a.
    pub(crate) fn add<const N: usize>(
        &self,
        values: &mut [f64],
        element: &[u32; N],
        k: &[[[[f64; 3]; 3]; N]; N],
    ) {
        for a in 0..N {
            for b in 0..=a {
                let (row, column) = (element[a].max(element[b]), element[a].min(element[b]));
                let c = column as usize;
                let block = self.block(row, column);
                for i in 0..3 {
                    for j in 0..3 {
                        // k holds (a, b); the stored block is (row, column), perhaps transposed.
                        let value = if element[a] == row {
                            k[a][b][i][j]
                        } else {
                            k[a][b][j][i]
                        };
                        if block == 0 {
                            if i >= j {
                                values[self.col_ptr[3 * c + j] + i - j] += value;
                            }
                        } else {
                            // The diagonal block takes 3 − j entries of column j, every other three.
                            values[self.col_ptr[3 * c + j] + 3 * block - j + i] += value;
                        }
                    }
                }
            }
        }
    }

    /// Adds an element's numbers of the node pairs (a, b), b ≤ a, times `factor`.
    pub(crate) fn add_scalars<const N: usize>(
        &self,
        values: &mut [f64],
        element: &[u32; N],
        m: &[[f64; N]; N],
        factor: f64,
    ) {
        for a in 0..N {
            for b in 0..=a {
                let (row, column) = (element[a].max(element[b]), element[a].min(element[b]));
                values[self.starts[column as usize] + self.block(row, column)] += factor * m[a][b];
            }
        }
    }

    /// Lower triangle with three unknowns per node.
    pub(crate) fn matrix(&self, values: Vec<f64>) -> SparseColMat<usize, f64> {
        let mut row_idx = Vec::with_capacity(values.len());
        for c in 0..self.nodes {
            for axis in 0..3 {
                for &(_, row) in &self.pairs[self.starts[c]..self.starts[c + 1]] {
                    let first = if row as usize == c { axis } else { 0 };
                    row_idx.extend((first..3).map(|i| 3 * row as usize + i));
                }
            }
        }
        let n = 3 * self.nodes;
        let symbolic = SymbolicSparseColMat::new_checked(n, n, self.col_ptr.clone(), None, row_idx);
        SparseColMat::new(symbolic, values)
    }

    /// Lower triangle with one unknown per node.
    pub(crate) fn scalar_matrix(&self, values: Vec<f64>) -> SparseColMat<usize, f64> {
        let row_idx = self.pairs.iter().map(|p| p.1 as usize).collect();
        let symbolic = SymbolicSparseColMat::new_checked(
            self.nodes,
            self.nodes,
            self.starts.clone(),
            None,
            row_idx,
        );
        SparseColMat::new(symbolic, values)
    }
}
