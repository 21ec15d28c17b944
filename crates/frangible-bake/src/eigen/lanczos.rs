//! Block Lanczos on (A + sB)⁻¹ B with full reorthogonalisation, in the inner product xᵀ B y.
//!
//! Many right-hand sides at once are decisive: a sparse solve with eight costs little more than with one,
//! since reading the factor from memory is what takes the time.

use crate::eigen::basis::{Block, inner, subtract};
use crate::eigen::dense::symmetric_eigen;
use crate::eigen::factor::Shifted;
use crate::eigen::metric::{Basis, Metric};
use crate::error::BakeError;
use crate::random;

/// Columns per block.
const BLOCK: usize = 8;
/// Relative residual at which a Ritz pair counts as found. The residual of A is as large after
/// purification; 1e-10 leaves two digits to the check in the plain norm.
const TOLERANCE: f64 = 1e-10;

/// The `wanted` lowest eigenpairs of A x = λ B x: eigenvalues rising, B-orthonormal vectors.
pub(crate) fn solve(
    shifted: &Shifted,
    metric: &Metric,
    rigid: &Basis,
    wanted: usize,
    progress: &mut dyn FnMut(f64),
) -> Result<(Vec<f64>, Block), BakeError> {
    let n = rigid.vectors.rows;
    let limit = (n - 6).min(5 * wanted + 200) / BLOCK * BLOCK;
    // Basis: the rigid motions, then block after block.
    let skip = rigid.columns();
    let mut basis = rigid.clone();
    let mut start = Block::zeros(n, BLOCK);
    start
        .data
        .iter_mut()
        .enumerate()
        .for_each(|(i, x)| *x = random::symmetric(1, i as u64));
    rigid.project_out_all(&mut start);
    let breakdown = |basis: usize| BakeError::NotConverged {
        converged: 0,
        wanted,
        basis,
    };
    let (mut next, _) = metric.orthonormalise(start).ok_or_else(|| breakdown(0))?;
    // Diagonal blocks of the projected matrix, and the triangles below them.
    let (mut diagonal, mut below): (Vec<Block>, Vec<Block>) = (Vec::new(), Vec::new());
    let mut check_at = (wanted + wanted / 2 + 24).min(limit);
    let mut converged = 0;
    loop {
        basis.append(&next);
        let size = basis.columns();
        let mut w = next.into_images();
        shifted.solve(&mut w);
        rigid.project_out_all(&mut w);
        // Three-term recurrence first, so that the full pass afterwards only removes rounding.
        if let Some(triangle) = below.last() {
            let transposed = Block {
                data: transpose(triangle),
                rows: BLOCK,
            };
            subtract(
                &mut w,
                basis.vectors.part(size - 2 * BLOCK, size - BLOCK),
                transposed.view(),
            );
        }
        diagonal.push(basis.project_out(&mut w, size - BLOCK, size));
        let (once, first) = metric.orthonormalise(w).ok_or_else(|| breakdown(size))?;
        let mut w = once.vectors;
        basis.project_out_all(&mut w);
        let (twice, second) = metric.orthonormalise(w).ok_or_else(|| breakdown(size))?;
        let second = Block {
            data: transpose(&second),
            rows: BLOCK,
        };
        below.push(inner(second.view(), first.view()));
        next = twice;

        let k = size - skip;
        if k >= check_at || k >= limit {
            let (values, vectors) = symmetric_eigen(&projected(&diagonal, &below))?;
            // The wanted end of the inverse's spectrum is the top.
            let residuals: Vec<f64> = (0..wanted.min(k))
                .map(|i| {
                    last_block(&below[below.len() - 1], vectors.column(k - 1 - i)).0
                        / values[k - 1 - i]
                })
                .collect();
            converged = residuals.iter().take_while(|r| **r <= TOLERANCE).count();
            log::debug!("Lanczos: {k} vectors, {converged} of {wanted} modes");
            progress(converged as f64 / wanted as f64);
            if converged == wanted {
                return Ok(ritz(
                    shifted.shift,
                    wanted,
                    &basis.vectors,
                    skip,
                    &next.vectors,
                    &values,
                    &vectors,
                    &below[below.len() - 1],
                ));
            }
            check_at = k + (4 * BLOCK).max((wanted - converged) / 3);
        } else {
            progress(0.5 * k as f64 / check_at as f64);
        }
        if k >= limit {
            return Err(BakeError::NotConverged {
                converged,
                wanted,
                basis: k,
            });
        }
    }
}

fn transpose(b: &Block) -> Vec<f64> {
    let n = b.rows;
    (0..n * n).map(|i| b.data[(i % n) * n + i / n]).collect()
}

/// The block-tridiagonal projection of the inverse onto the basis.
fn projected(diagonal: &[Block], below: &[Block]) -> Block {
    let k = diagonal.len() * BLOCK;
    let mut t = Block::zeros(k, k);
    for (block, d) in diagonal.iter().enumerate() {
        for j in 0..BLOCK {
            for i in 0..BLOCK {
                let (row, column) = (block * BLOCK + i, block * BLOCK + j);
                t.data[column * k + row] = 0.5 * (d.data[j * BLOCK + i] + d.data[i * BLOCK + j]);
                if block + 1 < diagonal.len() {
                    t.data[column * k + row + BLOCK] = below[block].data[j * BLOCK + i];
                }
            }
        }
    }
    t
}

/// The coordinates along the next block that the inverse adds to a Ritz vector, and their length.
fn last_block(below: &Block, y: &[f64]) -> (f64, [f64; BLOCK]) {
    let mut out = [0.0; BLOCK];
    for (j, y) in y[y.len() - BLOCK..].iter().enumerate() {
        for i in 0..BLOCK {
            out[i] += below.data[j * BLOCK + i] * y;
        }
    }
    (out.iter().map(|x| x * x).sum::<f64>().sqrt(), out)
}

/// Ritz vectors, purified: one more application of the inverse, free of solves, is
/// x + V_next B y_last / θ; it damps what the vector still holds of the highest modes.
fn ritz(
    shift: f64,
    wanted: usize,
    basis: &Block,
    skip: usize,
    next: &Block,
    values: &[f64],
    vectors: &Block,
    below: &Block,
) -> (Vec<f64>, Block) {
    let k = vectors.rows;
    let (mut chosen, mut tail) = (Block::zeros(k, wanted), Block::zeros(BLOCK, wanted));
    let mut eigenvalues = Vec::with_capacity(wanted);
    for i in 0..wanted {
        let (theta, y) = (values[k - 1 - i], vectors.column(k - 1 - i));
        // `subtract` below takes the negative.
        chosen
            .column_mut(i)
            .iter_mut()
            .zip(y)
            .for_each(|(to, from)| *to = -from);
        tail.column_mut(i)
            .iter_mut()
            .zip(last_block(below, y).1)
            .for_each(|(to, from)| *to = -from / theta);
        eigenvalues.push(1.0 / theta - shift);
    }
    let mut out = Block::zeros(basis.rows, wanted);
    subtract(&mut out, basis.part(skip, skip + k), chosen.view());
    subtract(&mut out, next.view(), tail.view());
    (eigenvalues, out)
}
