//! Small dense matrices on the calling thread alone: pieces are solved side by side, and their bits are not to depend on how
//! many threads there are.

use faer::diag::DiagMut;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::evd::{ComputeEigenvectors, self_adjoint_evd, self_adjoint_evd_scratch};
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatRef, Par, Spec};

use crate::PieceError;

/// Why a matrix could not be solved, in the solver's words.
pub(crate) fn refused(reason: impl std::fmt::Debug) -> PieceError {
    PieceError::Factorization {
        reason: format!("{reason:?}"),
    }
}

/// Adds a · b.
pub(crate) fn add_product(to: &mut Mat<f64>, a: MatRef<'_, f64>, b: MatRef<'_, f64>) {
    matmul(to.as_mut(), Accum::Add, a, b, 1.0, Par::Seq);
}

/// a · b.
pub(crate) fn product(a: MatRef<'_, f64>, b: MatRef<'_, f64>) -> Mat<f64> {
    let mut product = Mat::zeros(a.nrows(), b.ncols());
    matmul(product.as_mut(), Accum::Replace, a, b, 1.0, Par::Seq);
    product
}

/// Rising eigenvalues of a symmetric matrix, from its lower triangle, and its eigenvectors.
///
/// # Errors
/// NaN in the matrix.
pub(crate) fn eigen(matrix: MatRef<'_, f64>) -> Result<(Vec<f64>, Mat<f64>), PieceError> {
    let n = matrix.nrows();
    // faer 0.24 loses digits on matrices of tiny norm.
    let scale = (0..n).flat_map(|j| (0..n).map(move |i| matrix[(i, j)].abs()));
    let scale = scale.fold(f64::MIN_POSITIVE, f64::max);
    let scaled = Mat::from_fn(n, n, |i, j| matrix[(i, j)] / scale);
    let mut values = vec![0.0; n];
    let mut vectors = Mat::zeros(n, n);
    let params = Spec::default();
    let mut memory = MemBuffer::new(self_adjoint_evd_scratch::<f64>(
        n,
        ComputeEigenvectors::Yes,
        Par::Seq,
        params,
    ));
    self_adjoint_evd(
        scaled.as_ref(),
        DiagMut::from_slice_mut(&mut values),
        Some(vectors.as_mut()),
        Par::Seq,
        MemStack::new(&mut memory),
        params,
    )
    .map_err(refused)?;
    values.iter_mut().for_each(|v| *v *= scale);
    Ok((values, vectors))
}
