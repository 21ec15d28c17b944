//! Eigenvalues of small symmetric matrices: Householder's reflections to three diagonals, and the QL algorithm with implicit shifts
//! (Bowdler, Martin, Reinsch & Wilkinson 1968).

use crate::eigen::basis::{Block, dot};

/// Sweeps that an eigenvalue may take; two are usual.
const SWEEPS: usize = 60;

/// Rising eigenvalues of a symmetric matrix, from its lower triangle, and its eigenvectors. `None` if an entry is not a finite number.
pub(crate) fn symmetric(matrix: &Block) -> Option<(Vec<f64>, Block)> {
    let n = matrix.rows;
    let largest = matrix.data.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    if !matrix.data.iter().all(|x| x.is_finite()) {
        return None;
    }
    let scale = largest.max(f64::MIN_POSITIVE);
    let full = Block::from_fn(n, n, |i, j| matrix.data[i.min(j) * n + i.max(j)] / scale);
    let (values, vectors) = solve(full)?;
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
    let rising = order.iter().map(|&i| values[i] * scale).collect();
    let sorted = Block::from_fn(n, n, |i, j| vectors.column(order[j])[i]);
    Some((rising, sorted))
}

frangible::widest! {
    /// The search for a matrix whose largest entry is one.
    fn solve(full: Block) -> Option<(Vec<f64>, Block)> {
        let mut full = full;
        let n = full.rows;
        let (mut diagonal, mut beside, reflections) = three_diagonals(&mut full);
        let mut vectors = Block::from_fn(n, n, |i, j| f64::from(u8::from(i == j)));
        for k in (0..n.saturating_sub(2)).rev() {
            let mirror = &full.column(k)[k + 1..];
            for j in k + 1..n {
                let column = &mut vectors.column_mut(j)[k + 1..];
                let along = reflections[k] * dot(mirror, column);
                subtract(column, along, mirror);
            }
        }
        ql(&mut diagonal, &mut beside, &mut vectors).then_some((diagonal, vectors))
    }
}

#[inline(always)]
fn subtract(from: &mut [f64], factor: f64, what: &[f64]) {
    for (x, y) in from.iter_mut().zip(what) {
        *x -= factor * y;
    }
}

/// The diagonal, the numbers beside it, and the factors of the reflections, whose vectors take the place of the columns below the diagonal.
#[inline(always)]
fn three_diagonals(a: &mut Block) -> (Vec<f64>, Vec<f64>, Vec<f64>) {
    let n = a.rows;
    let (mut diagonal, mut beside, mut factors) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
    let mut p = vec![0.0; n];
    for k in 0..n {
        diagonal[k] = a.data[k * n + k];
        if k + 2 > n {
            break;
        }
        let (done, rest) = a.data.split_at_mut((k + 1) * n);
        let mirror = &mut done[k * n + k + 1..];
        let below = dot(&mirror[1..], &mirror[1..]);
        if below == 0.0 {
            beside[k] = mirror[0];
            continue;
        }
        let length = (mirror[0] * mirror[0] + below).sqrt();
        let onto = -length.copysign(mirror[0]);
        beside[k] = onto;
        mirror[0] -= onto;
        let factor = 2.0 / (mirror[0] * mirror[0] + below);
        factors[k] = factor;
        let p = &mut p[..n - k - 1];
        p.fill(0.0);
        for (x, column) in mirror.iter().zip(rest.chunks_exact(n)) {
            subtract(p, -factor * x, &column[k + 1..]);
        }
        let half = 0.5 * factor * dot(p, mirror);
        subtract(p, half, mirror);
        for (j, column) in rest.chunks_exact_mut(n).enumerate() {
            let (v, q) = (mirror[j], p[j]);
            for ((x, mirror), p) in column[k + 1..].iter_mut().zip(&*mirror).zip(&*p) {
                *x -= mirror * q + p * v;
            }
        }
    }
    (diagonal, beside, factors)
}

/// Turns the diagonal into eigenvalues, and the vectors with it. False where it does not end.
#[inline(always)]
fn ql(d: &mut [f64], e: &mut [f64], vectors: &mut Block) -> bool {
    let n = d.len();
    for l in 0..n {
        let mut sweeps = 0;
        loop {
            // The largest entry is one: an entry this small is nothing.
            let small = |m: usize| {
                let beside = d[m].abs() + d[m + 1].abs();
                e[m].abs() <= f64::EPSILON * beside.max(f64::EPSILON)
            };
            let m = (l..n - 1).find(|&m| small(m)).unwrap_or(n - 1);
            if m == l {
                break;
            }
            sweeps += 1;
            if sweeps > SWEEPS {
                return false;
            }
            let g = (d[l + 1] - d[l]) / (2.0 * e[l]);
            let r = (g * g + 1.0).sqrt();
            let mut g = d[m] - d[l] + e[l] / (g + r.copysign(g));
            let (mut sin, mut cos, mut p) = (1.0, 1.0, 0.0);
            let mut split = false;
            for i in (l..m).rev() {
                let (f, b) = (sin * e[i], cos * e[i]);
                let r = (f * f + g * g).sqrt();
                e[i + 1] = r;
                if r == 0.0 {
                    d[i + 1] -= p;
                    e[m] = 0.0;
                    split = true;
                    break;
                }
                (sin, cos) = (f / r, g / r);
                g = d[i + 1] - p;
                let r = (d[i] - g) * sin + 2.0 * cos * b;
                p = sin * r;
                d[i + 1] = g + p;
                g = cos * r - b;
                turn(vectors, i, sin, cos);
            }
            if !split {
                d[l] -= p;
                e[l] = g;
                e[m] = 0.0;
            }
        }
    }
    true
}

/// Turns two neighbouring columns in their plane.
#[inline(always)]
fn turn(vectors: &mut Block, i: usize, sin: f64, cos: f64) {
    let n = vectors.rows;
    let (left, right) = vectors.data[i * n..(i + 2) * n].split_at_mut(n);
    for (x, y) in left.iter_mut().zip(right) {
        let (a, b) = (*x, *y);
        *y = sin * a + cos * b;
        *x = cos * a - sin * b;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random;

    #[test]
    fn eigenvectors_are_orthonormal_and_belong_to_their_values() {
        // Full rank, rank three, equal eigenvalues, tiny numbers, diagonal, and an empty matrix.
        let cases: [(usize, usize, f64, f64); 7] = [
            (1, 1, 3.0, 0.0),
            (2, 2, 1.0, 0.0),
            (40, 40, 1.0, 0.0),
            (40, 3, 1.0, 0.0),
            (25, 2, 1e-90, 1e-90),
            (9, 0, 1.0, 2.0),
            (0, 0, 1.0, 0.0),
        ];
        for (n, rank, scale, shift) in cases {
            let entry = |k: usize, i: usize| random::symmetric(k as u64 + 1, i as u64);
            let a = Block::from_fn(n, n, |i, j| {
                let sum: f64 = (0..rank).map(|k| entry(k, i) * entry(k, j)).sum();
                scale * sum + if i == j { shift } else { 0.0 }
            });
            let largest = a.data.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
            let (values, vectors) = symmetric(&a).unwrap();
            assert!(values.is_sorted());
            for i in 0..n {
                let v = vectors.column(i);
                for j in 0..n {
                    let wanted = f64::from(u8::from(i == j));
                    assert!((dot(v, vectors.column(j)) - wanted).abs() < 1e-13);
                    // Rounding of a sum of n products.
                    let image = dot(a.column(j), v);
                    let error = (image - values[i] * v[j]).abs();
                    assert!(error < 1e-14 * n as f64 * largest, "{n} {rank}: {error:e}");
                }
            }
        }
    }

    #[test]
    fn what_is_no_number_is_refused() {
        let nan = Block::from_fn(2, 2, |_, _| f64::NAN);
        assert!(symmetric(&nan).is_none());
    }
}
