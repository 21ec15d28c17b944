//! Small dense matrices, computed on the calling thread only: pieces are solved in parallel, and results must not depend on the
//! number of threads or on the machine.

use crate::eigen::basis::Block;
use crate::eigen::portable::{self, Entries, symmetric};
use crate::pieces::PieceError;

/// Error of solving a matrix, in the solver's words.
pub(crate) fn refused(reason: impl std::fmt::Debug) -> PieceError {
    PieceError::Factorization {
        reason: format!("{reason:?}"),
    }
}

frangible::widest! {
    /// Adds a · b.
    pub(crate) fn add_product(to: &mut Block, a: &Block, b: &Block) {
        let (rows, inner) = (a.rows, b.rows);
        let sizes = [rows, inner, b.columns()];
        let right = Entries {
            data: &b.data,
            down: 1,
            across: inner,
        };
        portable::add_product((&mut to.data, rows), (&a.data, rows), right, sizes, 1.0);
    }
}

/// a · b.
pub(crate) fn product(a: &Block, b: &Block) -> Block {
    let mut product = Block::zeros(a.rows, b.columns());
    add_product(&mut product, a, b);
    product
}

/// Rising eigenvalues of a symmetric matrix, from its lower triangle, and its eigenvectors.
///
/// # Errors
/// NaN in the matrix.
pub(crate) fn eigen(matrix: &Block) -> Result<(Vec<f64>, Block), PieceError> {
    symmetric(matrix).ok_or_else(|| refused("the matrix contains NaN"))
}
