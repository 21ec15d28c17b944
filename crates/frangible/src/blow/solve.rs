//! Symmetric systems of a few dozen unknowns, row-major.

/// Cholesky's factor of a matrix, in its lower half, with the reciprocals of its pivots. If the matrix is not positive definite, one of these is
/// zero, as [`is_positive`] tells.
#[inline(always)]
pub(super) fn factor(matrix: Vec<f64>, n: usize) -> Vec<f64> {
    let mut factor = matrix;
    for k in 0..n {
        let (above, row) = factor.split_at_mut(k * n);
        for l in 0..k {
            let other = &above[l * n..l * n + n];
            row[l] = (row[l] - dot(&row[..l], &other[..l])) * other[l];
        }
        let sum = dot(&row[..k], &row[..k]);
        // The last digits of a pivot that all but vanishes are rounding errors.
        let left = row[k] - sum;
        row[k] = if left > 1e-10 * row[k] {
            left.sqrt().recip()
        } else {
            0.0
        };
    }
    factor
}

/// Σ a b of lists of any length, in a fixed order over eight lanes.
#[inline(always)]
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (a, rest_a) = a.as_chunks::<8>();
    let (b, rest_b) = b.as_chunks::<8>();
    let mut sums = [0.0; 8];
    for (a, b) in a.iter().zip(b) {
        for i in 0..8 {
            sums[i] += a[i] * b[i];
        }
    }
    let rest: f64 = rest_a.iter().zip(rest_b).map(|(a, b)| a * b).sum();
    sums.iter().sum::<f64>() + rest
}

/// Adds `times` × b to a.
#[inline(always)]
pub(super) fn add(a: &mut [f64], times: f64, b: &[f64]) {
    a.iter_mut().zip(b).for_each(|(a, b)| *a += times * b);
}

/// Rows that are multiplied at once; the number of rows is a multiple.
const ROWS: usize = 6;

/// Rows of a list of six. Written out, here and where they are used: `array::map` and its kind would be calls of their own, which are compiled for
/// the plain processor.
#[inline(always)]
fn six(rows: &[f64], width: usize) -> [&[f64]; ROWS] {
    [
        &rows[..width],
        &rows[width..2 * width],
        &rows[2 * width..3 * width],
        &rows[3 * width..4 * width],
        &rows[4 * width..5 * width],
        &rows[5 * width..6 * width],
    ]
}

/// Adds the products of a matrix's rows with x to a list.
#[inline(always)]
pub(super) fn add_products(sums: &mut [f64], rows: &[f64], x: &[f64]) {
    let (lanes, rest) = x.as_chunks::<4>();
    let (sums, _) = sums.as_chunks_mut::<ROWS>();
    let rows = rows.chunks_exact((ROWS * x.len()).max(1));
    for (sums, rows) in sums.iter_mut().zip(rows) {
        let rows = six(rows, x.len());
        let [a, b, c, d, e, f] = rows;
        let in_lanes = [
            &a.as_chunks::<4>().0[..lanes.len()],
            &b.as_chunks::<4>().0[..lanes.len()],
            &c.as_chunks::<4>().0[..lanes.len()],
            &d.as_chunks::<4>().0[..lanes.len()],
            &e.as_chunks::<4>().0[..lanes.len()],
            &f.as_chunks::<4>().0[..lanes.len()],
        ];
        let mut of_lanes = [[0.0; 4]; ROWS];
        for (i, x) in lanes.iter().enumerate() {
            for (sum, row) in of_lanes.iter_mut().zip(in_lanes) {
                for l in 0..4 {
                    sum[l] += row[i][l] * x[l];
                }
            }
        }
        for ((sum, lanes), row) in sums.iter_mut().zip(of_lanes).zip(rows) {
            let rest: f64 = row[x.len() - rest.len()..]
                .iter()
                .zip(rest)
                .map(|(a, b)| a * b)
                .sum();
            *sum += lanes.iter().sum::<f64>() + rest;
        }
    }
}

/// Adds the rows of a matrix to a list, each times its own factor.
#[inline(always)]
pub(super) fn add_rows(sum: &mut [f64], times: &[f64], rows: &[f64]) {
    let width = sum.len();
    let (times, _) = times.as_chunks::<ROWS>();
    let rows = rows.chunks_exact((ROWS * width).max(1));
    for (times, rows) in times.iter().zip(rows) {
        let rows = six(rows, width);
        let [a, b, c, d, e, f] = *times;
        for (i, sum) in sum.iter_mut().enumerate() {
            let pairs = (a * rows[0][i] + b * rows[1][i]) + (c * rows[2][i] + d * rows[3][i]);
            *sum += pairs + (e * rows[4][i] + f * rows[5][i]);
        }
    }
}

widest! {
    /// R diag(w) Rᵀ for a matrix R of n rows, of which the blocks up to the diagonal are computed: [`mirror`] fills in the rest.
    pub(super) fn squares(rows: &[f64], n: usize, weights: &[f64]) -> Vec<f64> {
        let width = weights.len();
        let mut squares = vec![0.0; n * n];
        let mut weighted = vec![0.0; width];
        for j in 0..n {
            let row = &rows[j * width..(j + 1) * width];
            for ((to, x), weight) in weighted.iter_mut().zip(row).zip(weights) {
                *to = x * weight;
            }
            add_products(&mut squares[j * n..j * n + lower(j)], rows, &weighted);
        }
        squares
    }

    /// Inverse of a symmetric, positive definite matrix.
    pub(super) fn inverse(matrix: Vec<f64>, n: usize) -> Vec<f64> {
        inverse_of_factor(&factor(matrix, n), n)
    }
}

/// Inverse of the matrix of this Cholesky factor.
#[inline(always)]
fn inverse_of_factor(factor: &[f64], n: usize) -> Vec<f64> {
    let mut inverse = vec![0.0; n * n];
    for (k, column) in inverse.chunks_exact_mut(n.max(1)).enumerate() {
        column[k] = 1.0;
        solve(factor, column);
    }
    inverse
}

/// Returns true if the matrix of this factor is positive definite.
pub(super) fn is_positive(factor: &[f64], n: usize) -> bool {
    (0..n).all(|k| factor[k * n + k] > 0.0)
}

/// Solves a system with the matrix of this factor, in place.
#[inline(always)]
pub(super) fn solve(factor: &[f64], x: &mut [f64]) {
    let n = x.len();
    for k in 0..n {
        let row = &factor[k * n..k * n + n];
        x[k] = (x[k] - dot(&row[..k], &x[..k])) * row[k];
    }
    for k in (0..n).rev() {
        let row = &factor[k * n..k * n + n];
        x[k] *= row[k];
        let value = x[k];
        for (x, a) in x[..k].iter_mut().zip(row) {
            *x -= a * value;
        }
    }
}

/// End of the part of a symmetric matrix's row that is computed.
#[inline(always)]
fn lower(row: usize) -> usize {
    ROWS * (row / ROWS + 1)
}

/// Copies the lower half of a matrix onto the upper one.
pub(super) fn mirror(matrix: &mut [f64], n: usize) {
    for j in 0..n {
        for k in 0..j {
            matrix[k * n + j] = matrix[j * n + k];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_solution_solves_and_a_matrix_that_is_not_positive_is_told() {
        let n = 18;
        let root = |i: usize, j: usize| ((i * 7 + j * 3) % 11) as f64 - 4.0;
        let entry = |i: usize, j: usize| (0..n).map(|k| root(i, k) * root(j, k)).sum::<f64>();
        let mut matrix: Vec<f64> = (0..n * n).map(|at| entry(at / n, at % n)).collect();
        (0..n).for_each(|k| matrix[k * n + k] += 1.0);
        let b: Vec<f64> = (0..n).map(|i| (i as f64).sin()).collect();
        let l = factor(matrix.clone(), n);
        assert!(is_positive(&l, n));
        let mut x = b.clone();
        solve(&l, &mut x);
        let mut products = vec![0.0; n];
        add_products(&mut products, &matrix, &x);
        let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12);
        assert!(near(&products, &b));
        let mut again = vec![0.0; n];
        add_rows(&mut again, &b, &inverse_of_factor(&l, n));
        assert!(near(&again, &x));
        matrix[3 * n + 3] = -1.0;
        assert!(!is_positive(&factor(matrix.clone(), n), n));
    }
}
