//! Dense symmetric eigenproblems: small bodies, and the projected matrix of Lanczos.

use faer::diag::DiagMut;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::evd::{ComputeEigenvectors, self_adjoint_evd, self_adjoint_evd_scratch};
use faer::sparse::SparseColMat;
use faer::{Par, Spec};

use crate::eigen::basis::Block;
use crate::error::BakeError;

/// All eigenvalues, rising, and eigenvectors of a symmetric matrix (lower triangle used).
///
/// Divides by the largest entry first: faer 0.24 loses digits on matrices of tiny norm.
pub(crate) fn symmetric_eigen(matrix: &Block) -> Result<(Vec<f64>, Block), BakeError> {
    let n = matrix.rows;
    let scale = matrix
        .data
        .iter()
        .fold(0.0_f64, |m, x| m.max(x.abs()))
        .max(f64::MIN_POSITIVE);
    let scaled = Block {
        data: matrix.data.iter().map(|x| x / scale).collect(),
        rows: n,
    };
    let mut values = vec![0.0; n];
    let mut vectors = Block::zeros(n, n);
    let params = Spec::default();
    let mut memory = MemBuffer::new(self_adjoint_evd_scratch::<f64>(
        n,
        ComputeEigenvectors::Yes,
        Par::Seq,
        params,
    ));
    self_adjoint_evd(
        scaled.view(),
        DiagMut::from_slice_mut(&mut values),
        Some(vectors.view_mut()),
        Par::Seq,
        MemStack::new(&mut memory),
        params,
    )
    .map_err(|e| BakeError::Factorization {
        reason: format!("dense eigenvalues: {e:?}"),
    })?;
    values.iter_mut().for_each(|v| *v *= scale);
    Ok((values, vectors))
}

/// The `wanted` lowest elastic modes of a small system: rigid motions are lifted above the spectrum.
pub(crate) fn solve(
    scaled: &SparseColMat<usize, f64>,
    rigid: &Block,
    wanted: usize,
) -> Result<(Vec<f64>, Block), BakeError> {
    let n = rigid.rows;
    let mut matrix = Block::zeros(n, n);
    let mut trace = 0.0;
    for j in 0..n {
        let a = scaled.as_ref();
        for (&i, &value) in a.symbolic().row_idx()[a.symbolic().col_range(j)]
            .iter()
            .zip(a.val_of_col(j))
        {
            matrix.data[j * n + i] += value;
            trace += if i == j { value } else { 0.0 };
        }
    }
    // Above every elastic eigenvalue, since the trace is their sum; low enough not to drown the lowest.
    for r in 0..rigid.columns() {
        let x = rigid.column(r);
        for j in 0..n {
            for i in j..n {
                matrix.data[j * n + i] += trace * x[i] * x[j];
            }
        }
    }
    let (values, mut vectors) = symmetric_eigen(&matrix)?;
    vectors.data.truncate(n * wanted);
    Ok((values[..wanted].to_vec(), vectors))
}
