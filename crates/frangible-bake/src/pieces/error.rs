//! Errors of finding the modes of a piece.

use crate::BakeError;
use frangible::InputError;
use thiserror::Error;

/// Error of finding the modes of a piece, which then does not break again.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PieceError {
    /// Its finite elements.
    #[error(transparent)]
    Elements(#[from] BakeError),
    /// The modes found do not fit the piece.
    #[error(transparent)]
    Body(#[from] InputError),
    /// A matrix that cannot be factored.
    #[error("the stiffness of a piece cannot be factored ({reason}); it does not break again")]
    Factorization {
        /// Reason given by the solver.
        reason: String,
    },
}
