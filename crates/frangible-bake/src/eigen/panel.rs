//! Panels of eight vectors in row-major order, so that every kernel works on whole rows.

use faer::linalg::matmul::matmul;
use faer::{Accum, MatMut, MatRef, Par};

use crate::eigen::portable::{self, Sums};

/// Vectors per panel. Reading the factor and the basis from memory takes most of the time, so that several at once are
/// much cheaper than one by one; but larger blocks need a larger basis. Processor seconds for 120 modes of a glass, a rabbit
/// and a slab, 15 000 to 33 000 unknowns: 8 takes 0.90, 1.20, 1.27; 16 takes 1.00, 1.53, 1.39; 32 takes 1.11, 1.85, 1.98.
pub(crate) const WIDTH: usize = 8;

/// One row of a panel: an entry of each of its vectors.
pub(crate) type Row = [f64; WIDTH];

/// Coefficients between two panels: row a holds what belongs to vector a of the first.
pub(crate) type Square = [Row; WIDTH];

/// to += factor × row.
#[inline(always)]
pub(crate) fn add_multiple(to: &mut Row, factor: f64, row: &Row) {
    for l in 0..WIDTH {
        to[l] += factor * row[l];
    }
}

/// The panel as a matrix with a row for each of its vectors.
pub(crate) fn across(panel: &[Row]) -> MatRef<'_, f64> {
    MatRef::from_column_major_slice(panel.as_flattened(), WIDTH, panel.len())
}

/// A panel as a matrix that is written to, its rows across.
pub(crate) fn across_mut(panel: &mut [Row]) -> MatMut<'_, f64> {
    let rows = panel.len();
    MatMut::from_column_major_slice_mut(panel.as_flattened_mut(), WIDTH, rows)
}

/// Vᵀ W.
pub(crate) fn inner(sums: Sums, v: &[Row], w: &[Row]) -> Square {
    if sums == Sums::Portable {
        return portable::inner(v, w);
    }
    let mut out = [[0.0; WIDTH]; WIDTH];
    matmul(
        across_mut(&mut out),
        Accum::Replace,
        across(w),
        across(v).transpose(),
        1.0,
        Par::Seq,
    );
    out
}

/// W −= V C.
pub(crate) fn subtract(sums: Sums, w: &mut [Row], v: &[Row], c: &Square) {
    if sums == Sums::Portable {
        return portable::subtract(w, v, c);
    }
    matmul(
        across_mut(w),
        Accum::Add,
        across(c),
        across(v),
        -1.0,
        Par::Seq,
    );
}

/// W ← W C.
pub(crate) fn multiply(sums: Sums, w: &mut [Row], c: &Square) {
    if sums == Sums::Portable {
        return portable::multiply(w, c);
    }
    /// Rows at a time.
    const PART: usize = 64;
    let mut copy = [[0.0; WIDTH]; PART];
    for part in w.chunks_mut(PART) {
        let copy = &mut copy[..part.len()];
        copy.copy_from_slice(part);
        matmul(
            across_mut(part),
            Accum::Replace,
            across(c),
            across(copy),
            1.0,
            Par::Seq,
        );
    }
}

/// Upper triangle R of a Gram matrix G = Rᵀ R and its inverse, and how much of a column was left at worst when the
/// ones before it were taken out, as a share of its length. `None` when nothing is left but rounding.
pub(crate) fn cholesky(gram: &Square) -> Option<(Square, Square, f64)> {
    let mut r = [[0.0; WIDTH]; WIDTH];
    let mut least = 1.0_f64;
    for j in 0..WIDTH {
        for i in 0..=j {
            let taken: f64 = (0..i).map(|k| r[k][i] * r[k][j]).sum();
            let rest = 0.5 * (gram[i][j] + gram[j][i]) - taken;
            if i < j {
                r[i][j] = rest / r[i][i];
            } else {
                let share = rest / gram[j][j];
                if !(share > 1e-12 && gram[j][j] > 0.0) {
                    return None;
                }
                least = least.min(share.sqrt());
                r[j][j] = rest.sqrt();
            }
        }
    }
    let mut inverse = [[0.0; WIDTH]; WIDTH];
    for j in 0..WIDTH {
        inverse[j][j] = 1.0 / r[j][j];
        for i in (0..j).rev() {
            let sum: f64 = (i + 1..=j).map(|k| r[i][k] * inverse[k][j]).sum();
            inverse[i][j] = -sum / r[i][i];
        }
    }
    Some((r, inverse, least))
}

/// A B.
pub(crate) fn product(a: &Square, b: &Square) -> Square {
    let mut out = [[0.0; WIDTH]; WIDTH];
    for i in 0..WIDTH {
        for k in 0..WIDTH {
            add_multiple(&mut out[i], a[i][k], &b[k]);
        }
    }
    out
}

pub(crate) fn transposed(a: &Square) -> Square {
    std::array::from_fn(|i| std::array::from_fn(|j| a[j][i]))
}

/// Columns `from..` of a matrix stored column after column, padded with zeros.
pub(crate) fn panel_of_columns(columns: &[f64], rows: usize) -> Vec<Row> {
    let mut panel = vec![[0.0; WIDTH]; rows];
    for (l, column) in columns.chunks_exact(rows).take(WIDTH).enumerate() {
        for (row, x) in panel.iter_mut().zip(column) {
            row[l] = *x;
        }
    }
    panel
}
