//! Small dense matrices on the calling thread alone: pieces are solved side by side, and their bits are not to depend on how
//! many threads there are.

use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatRef, Par};

use crate::eigen::dense::eigen_into;
use crate::pieces::PieceError;

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
    let mut vectors = Mat::zeros(matrix.nrows(), matrix.nrows());
    let values = eigen_into(matrix, vectors.as_mut()).map_err(refused)?;
    Ok((values, vectors))
}
