//! Forward and backward substitution with a supernodal Cholesky factor, eight right-hand sides at once.

use faer::sparse::linalg::cholesky::supernodal::SymbolicSupernodalCholesky;

use crate::eigen::panel::{Row, WIDTH, add_multiple};

/// Columns of the factor that are worked on at once.
const COLUMNS: usize = 4;

frangible::widest! {
    /// Replaces the rows of `x`, in the factor's order, by those of (L Lᵀ)⁻¹ x.
    pub(crate) fn solve(
        symbolic: &SymbolicSupernodalCholesky<usize>,
        values: &[f64],
        x: &mut [Row],
    ) {
        let mut others: Vec<Row> = Vec::new();
        for s in 0..symbolic.n_supernodes() {
            let (panel, pattern, own) = parts(symbolic, values, s, x);
            let width = own.len();
            let height = width + pattern.len();
            for j in 0..width {
                let column = &panel[j * height..][..width];
                let solved = quotient(&own[j], column[j]);
                own[j] = solved;
                for (x, factor) in own[j + 1..].iter_mut().zip(&column[j + 1..]) {
                    add_multiple(x, -factor, &solved);
                }
            }
            others.clear();
            others.resize(pattern.len(), [0.0; WIDTH]);
            for (columns, own) in panel.chunks(COLUMNS * height).zip(own.chunks(COLUMNS)) {
                match (below::<COLUMNS>(columns, height, width), own.first_chunk()) {
                    (Some(columns), Some(own)) => add_below(&mut others, columns, own),
                    _ => {
                        for (column, own) in columns.chunks_exact(height).zip(own) {
                            add_below(&mut others, [&column[width..]], &[*own]);
                        }
                    }
                }
            }
            for (&row, change) in pattern.iter().zip(&others) {
                add_multiple(&mut x[row], -1.0, change);
            }
        }
        for s in (0..symbolic.n_supernodes()).rev() {
            others.clear();
            others.extend(symbolic.supernode(s).pattern().iter().map(|&row| x[row]));
            let (panel, _, own) = parts(symbolic, values, s, x);
            let width = own.len();
            let height = width + others.len();
            for (columns, own) in panel.chunks(COLUMNS * height).zip(own.chunks_mut(COLUMNS)) {
                match (below(columns, height, width), own.first_chunk_mut()) {
                    (Some(columns), Some(own)) => take_along::<COLUMNS>(own, columns, &others),
                    _ => {
                        for (column, own) in columns.chunks_exact(height).zip(own) {
                            let own = std::array::from_mut(own);
                            take_along(own, [&column[width..]], &others);
                        }
                    }
                }
            }
            for j in (0..width).rev() {
                let column = &panel[j * height..][..width];
                let mut rest = own[j];
                for (x, factor) in own[j + 1..].iter().zip(&column[j + 1..]) {
                    add_multiple(&mut rest, -factor, x);
                }
                own[j] = quotient(&rest, column[j]);
            }
        }
    }
}

/// row / by.
#[inline(always)]
fn quotient(row: &Row, by: f64) -> Row {
    let mut quotient = *row;
    for x in &mut quotient {
        *x /= by;
    }
    quotient
}

/// N columns below the square of a supernode, if there are as many.
#[inline(always)]
fn below<const N: usize>(columns: &[f64], height: usize, width: usize) -> Option<[&[f64]; N]> {
    let all = columns.len() == N * height;
    all.then(|| std::array::from_fn(|k| &columns[k * height + width..(k + 1) * height]))
}

/// sums += columns × own rows.
#[inline(always)]
fn add_below<const N: usize>(sums: &mut [Row], columns: [&[f64]; N], own: &[Row; N]) {
    let columns = columns.map(|column| &column[..sums.len()]);
    for (i, sum) in sums.iter_mut().enumerate() {
        for k in 0..N {
            add_multiple(sum, columns[k][i], &own[k]);
        }
    }
}

/// own rows −= columnsᵀ × others.
#[inline(always)]
fn take_along<const N: usize>(own: &mut [Row; N], columns: [&[f64]; N], others: &[Row]) {
    let columns = columns.map(|column| &column[..others.len()]);
    let mut sums = [[0.0; WIDTH]; N];
    for (i, other) in others.iter().enumerate() {
        for k in 0..N {
            add_multiple(&mut sums[k], columns[k][i], other);
        }
    }
    for (x, sum) in own.iter_mut().zip(&sums) {
        add_multiple(x, -1.0, sum);
    }
}

/// A supernode's numbers, the rows below it, and its own rows of `x`.
#[inline(always)]
fn parts<'a, 'x>(
    symbolic: &'a SymbolicSupernodalCholesky<usize>,
    values: &'a [f64],
    s: usize,
    x: &'x mut [Row],
) -> (&'a [f64], &'a [usize], &'x mut [Row]) {
    let at = symbolic.col_ptr_for_val();
    let own = symbolic.supernode_begin()[s]..symbolic.supernode_end()[s];
    let pattern = symbolic.supernode(s).pattern();
    (&values[at[s]..at[s + 1]], pattern, &mut x[own])
}
