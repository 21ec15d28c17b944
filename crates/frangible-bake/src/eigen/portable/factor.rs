//! The Cholesky factor of a sparse matrix, supernode by supernode.
//!
//! A supernode is factorised once all before it are done, and then takes its share out of those that come after it.

use faer::sparse::SparseColMat;
use faer::sparse::linalg::cholesky::supernodal::SymbolicSupernodalCholesky;

use crate::eigen::portable::{Entries, add_product};

/// Columns that are factorised before their products are taken from the rest all at once.
const BLOCK: usize = 32;

frangible::widest! {
    /// Factorises a lower triangle, its unknowns renumbered: `place` is where each comes. False where it is not positive definite.
    pub(crate) fn factorise(
        symbolic: &SymbolicSupernodalCholesky<usize>,
        place: &[usize],
        matrix: &SparseColMat<usize, f64>,
        values: &mut [f64],
    ) -> bool {
        let mut owner = vec![0; symbolic.nrows()];
        let bounds = symbolic
            .supernode_begin()
            .iter()
            .zip(symbolic.supernode_end());
        for (s, (&begin, &end)) in bounds.enumerate() {
            owner[begin..end].fill(s);
        }
        spread(symbolic, &owner, place, matrix, values);
        let (mut update, mut rows) = (Vec::new(), Vec::new());
        for s in 0..symbolic.n_supernodes() {
            let from = symbolic.col_ptr_for_val()[s];
            let width = symbolic.supernode_end()[s] - symbolic.supernode_begin()[s];
            let pattern = symbolic.supernode(s).pattern();
            let height = width + pattern.len();
            let (done, later) = values.split_at_mut(from + width * height);
            let panel = &mut done[from..];
            if !factorise_panel(panel, height, width) {
                return false;
            }
            outer(&mut update, &panel[width..], height, [pattern.len(), width]);
            let base = from + width * height;
            let mut first = 0;
            while first < pattern.len() {
                let target = owner[pattern[first]];
                let end = symbolic.supernode_end()[target];
                let columns = pattern[first..].partition_point(|&row| row < end);
                let into = &mut later[symbolic.col_ptr_for_val()[target] - base..];
                rows_in(symbolic, target, &pattern[first..], &mut rows);
                take(
                    into,
                    symbolic,
                    target,
                    &pattern[first..],
                    columns,
                    &rows,
                    |column| {
                        let from = (first + column) * pattern.len();
                        &update[from + first + column..from + pattern.len()]
                    },
                );
                first += columns;
            }
        }
        true
    }
}

/// Writes the matrix where its factor comes.
fn spread(
    symbolic: &SymbolicSupernodalCholesky<usize>,
    owner: &[usize],
    place: &[usize],
    matrix: &SparseColMat<usize, f64>,
    values: &mut [f64],
) {
    values.fill(0.0);
    let (pattern, entries) = matrix.parts();
    for j in 0..pattern.ncols() {
        for entry in pattern.col_range(j) {
            let (a, b) = (place[pattern.row_idx()[entry]], place[j]);
            let (row, column) = (a.max(b), a.min(b));
            let s = owner[column];
            let (begin, end) = (symbolic.supernode_begin()[s], symbolic.supernode_end()[s]);
            let below = symbolic.supernode(s).pattern();
            let height = end - begin + below.len();
            let local = match row < end {
                true => row - begin,
                false => end - begin + below.partition_point(|&other| other < row),
            };
            values[symbolic.col_ptr_for_val()[s] + (column - begin) * height + local] +=
                entries[entry];
        }
    }
}

/// Finds the places of these rows in a supernode that has them all.
#[inline(always)]
fn rows_in(
    symbolic: &SymbolicSupernodalCholesky<usize>,
    s: usize,
    pattern: &[usize],
    rows: &mut Vec<usize>,
) {
    let (begin, end) = (symbolic.supernode_begin()[s], symbolic.supernode_end()[s]);
    let below = symbolic.supernode(s).pattern();
    rows.clear();
    let mut next = 0;
    for &row in pattern {
        rows.push(match row < end {
            true => row - begin,
            false => {
                while below[next] < row {
                    next += 1;
                }
                end - begin + next
            }
        });
    }
}

/// Takes columns out of those of a supernode.
#[inline(always)]
fn take<'a>(
    into: &mut [f64],
    symbolic: &SymbolicSupernodalCholesky<usize>,
    s: usize,
    pattern: &[usize],
    columns: usize,
    rows: &[usize],
    update: impl Fn(usize) -> &'a [f64],
) {
    let (begin, end) = (symbolic.supernode_begin()[s], symbolic.supernode_end()[s]);
    let height = end - begin + symbolic.supernode(s).pattern().len();
    for (column, row) in pattern[..columns].iter().enumerate() {
        let to = &mut into[(row - begin) * height..][..height];
        for (&row, x) in rows[column..].iter().zip(update(column)) {
            to[row] -= x;
        }
    }
}

/// The lower triangle of B Bᵀ, column after column.
#[inline(always)]
fn outer(update: &mut Vec<f64>, b: &[f64], stride: usize, [rows, width]: [usize; 2]) {
    update.clear();
    update.resize(rows * rows, 0.0);
    for first in (0..rows).step_by(BLOCK) {
        let right = Entries {
            data: &b[first..],
            down: stride,
            across: 1,
        };
        let to = (&mut update[first * rows + first..], rows);
        let sizes = [rows - first, width, BLOCK.min(rows - first)];
        add_product(to, (&b[first..], stride), right, sizes, 1.0);
    }
}

/// Factorises a square of `width` columns and divides the rows below it, columns this far apart. False where a pivot is not positive.
#[inline(always)]
pub(crate) fn factorise_panel(panel: &mut [f64], height: usize, width: usize) -> bool {
    for first in (0..width).step_by(BLOCK) {
        let last = (first + BLOCK).min(width);
        for j in first..last {
            let (done, rest) = panel.split_at_mut(j * height);
            let column = &mut rest[j..height];
            for before in done.chunks_exact(height).skip(first) {
                let before = &before[j..];
                let factor = before[0];
                for (x, y) in column.iter_mut().zip(before) {
                    *x -= factor * y;
                }
            }
            let pivot = column[0];
            if !(pivot > 0.0 && pivot.is_finite()) {
                return false;
            }
            let root = pivot.sqrt();
            column[0] = root;
            let inverse = 1.0 / root;
            column[1..].iter_mut().for_each(|x| *x *= inverse);
        }
        let (done, rest) = panel.split_at_mut(last * height);
        let block = &done[first * height..];
        for j in (last..width).step_by(BLOCK) {
            let right = Entries {
                data: &block[j..],
                down: height,
                across: 1,
            };
            let to = (&mut rest[(j - last) * height + j..], height);
            let sizes = [height - j, last - first, BLOCK.min(width - j)];
            add_product(to, (&block[j..], height), right, sizes, -1.0);
        }
    }
    true
}
