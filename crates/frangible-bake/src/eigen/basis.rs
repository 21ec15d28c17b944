//! Columns of numbers, and the operations of Lanczos on them.

use std::ops::{Index, IndexMut};

use faer::{MatMut, MatRef};

/// A dense matrix stored column after column.
#[derive(Clone, Debug)]
pub(crate) struct Block {
    /// The numbers.
    pub(crate) data: Vec<f64>,
    /// Length of a column.
    pub(crate) rows: usize,
}

impl Block {
    pub(crate) fn zeros(rows: usize, columns: usize) -> Self {
        Self {
            data: vec![0.0; rows * columns],
            rows,
        }
    }

    /// A matrix of these numbers.
    pub(crate) fn from_fn(
        rows: usize,
        columns: usize,
        entry: impl Fn(usize, usize) -> f64,
    ) -> Self {
        let entry = &entry;
        Self {
            data: (0..columns)
                .flat_map(|j| (0..rows).map(move |i| entry(i, j)))
                .collect(),
            rows,
        }
    }

    pub(crate) fn transposed(&self) -> Self {
        Self::from_fn(self.columns(), self.rows, |i, j| self[(j, i)])
    }

    pub(crate) fn columns(&self) -> usize {
        self.data.len() / self.rows
    }

    pub(crate) fn column(&self, j: usize) -> &[f64] {
        &self.data[j * self.rows..(j + 1) * self.rows]
    }

    pub(crate) fn column_mut(&mut self, j: usize) -> &mut [f64] {
        &mut self.data[j * self.rows..(j + 1) * self.rows]
    }

    pub(crate) fn view(&self) -> MatRef<'_, f64> {
        MatRef::from_column_major_slice(&self.data, self.rows, self.columns())
    }

    pub(crate) fn view_mut(&mut self) -> MatMut<'_, f64> {
        let columns = self.columns();
        MatMut::from_column_major_slice_mut(&mut self.data, self.rows, columns)
    }
}

impl Index<(usize, usize)> for Block {
    type Output = f64;

    fn index(&self, (row, column): (usize, usize)) -> &f64 {
        &self.data[column * self.rows + row]
    }
}

impl IndexMut<(usize, usize)> for Block {
    fn index_mut(&mut self, (row, column): (usize, usize)) -> &mut f64 {
        &mut self.data[column * self.rows + row]
    }
}

#[inline(always)]
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    // Four running sums: fast, and in a fixed order.
    let mut sums = [0.0; 4];
    let (a4, b4) = (a.chunks_exact(4), b.chunks_exact(4));
    let rest: f64 = a4
        .remainder()
        .iter()
        .zip(b4.remainder())
        .map(|(x, y)| x * y)
        .sum();
    for (x, y) in a4.zip(b4) {
        for k in 0..4 {
            sums[k] += x[k] * y[k];
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

/// Makes the columns of `w` orthonormal (Gram–Schmidt, twice); gives the triangle R with w_before = w R,
/// stored by columns. `None` when a column depends on the others.
pub(crate) fn orthonormalise(w: &mut Block) -> Option<Block> {
    let (rows, b) = (w.rows, w.columns());
    let mut r = Block::zeros(b, b);
    for j in 0..b {
        let (done, rest) = w.data.split_at_mut(j * rows);
        let column = &mut rest[..rows];
        let before = dot(column, column).sqrt();
        for _ in 0..2 {
            for i in 0..j {
                let other = &done[i * rows..(i + 1) * rows];
                let c = dot(other, column);
                r.data[j * b + i] += c;
                for (x, y) in column.iter_mut().zip(other) {
                    *x -= c * y;
                }
            }
        }
        let after = dot(column, column).sqrt();
        if !(after > 1e-13 * before && after > 0.0) {
            return None;
        }
        r.data[j * b + j] = after;
        for x in column.iter_mut() {
            *x /= after;
        }
    }
    Some(r)
}
