//! Block Lanczos on (A + sB)⁻¹ B with full reorthogonalisation, in the inner product xᵀ B y.
//!
//! Blocks are essential for speed: a sparse solve with eight right-hand sides takes little longer than with
//! one, since the time is dominated by reading the factor from memory.

use crate::eigen::basis::Block;
use crate::eigen::dense::symmetric_eigen;
use crate::eigen::factor::Shifted;
use crate::eigen::krylov::{Krylov, Pair};
use crate::eigen::panel::{Square, WIDTH, inner, subtract, transposed};
use crate::eigen::watch::Watch;
use crate::error::BakeError;
use crate::phase::Phase;

/// Modes found per vector of the basis, once the first are: 0.3 to 0.5 on plates, vessels and solids.
const FOUND_PER_VECTOR: f64 = 0.5;

/// The `wanted` lowest eigenpairs of A x = λ B x: eigenvalues rising, B-orthonormal vectors. `basis` holds the rigid
/// motions, and grows. `tolerance`: relative residual at which a Ritz pair of the inverse counts as found.
pub(crate) fn solve(
    shifted: &Shifted,
    mut basis: Krylov<'_>,
    wanted: usize,
    tolerance: f64,
    watch: &mut Watch<'_>,
) -> Result<(Vec<f64>, Block), BakeError> {
    let rows = shifted.rows();
    let limit = (rows - 6).min(5 * wanted + 200) / WIDTH * WIDTH;
    let breakdown = |basis: usize| BakeError::NotConverged {
        converged: 0,
        wanted,
        basis,
    };
    let mut next = basis.start(rows, watch).ok_or_else(|| breakdown(0))?;
    // Diagonal blocks of the projected matrix, and the triangles below them.
    let (mut diagonal, mut below): (Vec<Square>, Vec<Square>) = (Vec::new(), Vec::new());
    // The dense eigenproblem of a check costs about as much as the step of a block or two.
    let mut check_at = 2 * wanted + 4 * WIDTH;
    let mut converged = 0;
    loop {
        let mut w = watch.time(Phase::Solves, || shifted.solve(next.images()));
        // Three-term recurrence first, so that the full pass afterwards only removes rounding.
        diagonal.push(watch.time(Phase::Orthogonalisation, || {
            if let (Some(last), Some(triangle)) = (basis.blocks.last(), below.last()) {
                subtract(basis.sums, &mut w, &last.vectors, &transposed(triangle));
            }
            let along = inner(basis.sums, next.images(), &w);
            subtract(basis.sums, &mut w, &next.vectors, &along);
            along
        }));
        basis.blocks.push(next);
        let size = basis.blocks.len() * WIDTH;
        let (pair, triangle) = basis
            .orthonormalise(w, watch)
            .ok_or_else(|| breakdown(size))?;
        next = pair;
        if size >= check_at || size >= limit {
            let (values, vectors) = watch.time(Phase::Projected, || {
                symmetric_eigen(basis.sums, &projected(&diagonal, &below))
            })?;
            // The wanted end of the inverse's spectrum is the top.
            let found = |i: &usize| {
                let (tail, y) = (last_block(&triangle, vectors.column(*i)), values[*i]);
                tail.iter().map(|x| x * x).sum::<f64>().sqrt() <= tolerance * y
            };
            converged = (0..size).rev().take(wanted).take_while(found).count();
            log::debug!("Lanczos: {size} vectors, {converged} of {wanted} modes");
            if converged == wanted {
                return Ok(watch.time(Phase::Shapes, || {
                    ritz(
                        shifted.shift,
                        wanted,
                        &basis,
                        &next,
                        &values,
                        &vectors,
                        &triangle,
                    )
                }));
            }
            let missing = (wanted - converged) as f64 / FOUND_PER_VECTOR;
            check_at = size + (missing as usize).max(2 * WIDTH);
        }
        below.push(triangle);
        if size >= limit {
            return Err(BakeError::NotConverged {
                converged,
                wanted,
                basis: size,
            });
        }
        watch.tell(0.1 + 0.8 * (size as f64 / usual_size(wanted)).min(1.0))?;
    }
}

/// The size of the basis at which solids end; plates and vessels do a quarter sooner.
fn usual_size(wanted: usize) -> f64 {
    (4 * wanted + 6 * WIDTH) as f64
}

/// The block-tridiagonal projection of the inverse onto the basis.
fn projected(diagonal: &[Square], below: &[Square]) -> Block {
    let k = diagonal.len() * WIDTH;
    let mut t = Block::zeros(k, k);
    for (block, d) in diagonal.iter().enumerate() {
        for j in 0..WIDTH {
            for i in 0..WIDTH {
                let (row, column) = (block * WIDTH + i, block * WIDTH + j);
                t.data[column * k + row] = 0.5 * (d[i][j] + d[j][i]);
                if block + 1 < diagonal.len() {
                    t.data[column * k + row + WIDTH] = below[block][i][j];
                }
            }
        }
    }
    t
}

/// The coordinates along the next block that the inverse adds to a Ritz vector.
fn last_block(below: &Square, y: &[f64]) -> [f64; WIDTH] {
    let y = &y[y.len() - WIDTH..];
    std::array::from_fn(|i| below[i].iter().zip(y).map(|(b, y)| b * y).sum())
}

/// Ritz vectors, purified: one more application of the inverse, free of solves, is
/// x + V_next B y_last / θ; it damps what the vector still holds of the highest modes.
fn ritz(
    shift: f64,
    wanted: usize,
    basis: &Krylov<'_>,
    next: &Pair,
    values: &[f64],
    vectors: &Block,
    below: &Square,
) -> (Vec<f64>, Block) {
    let k = vectors.rows;
    let (mut chosen, mut tail) = (Block::zeros(k, wanted), Block::zeros(WIDTH, wanted));
    let mut eigenvalues = Vec::with_capacity(wanted);
    for i in 0..wanted {
        let (theta, y) = (values[k - 1 - i], vectors.column(k - 1 - i));
        chosen.column_mut(i).copy_from_slice(y);
        let along = last_block(below, y).map(|x| x / theta);
        tail.column_mut(i).copy_from_slice(&along);
        eigenvalues.push(1.0 / theta - shift);
    }
    (eigenvalues, basis.combine(&chosen, next, &tail))
}
