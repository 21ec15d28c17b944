//! Why a piece has no modes.

use crate::BakeError;
use frangible::InputError;
use thiserror::Error;

/// Why a piece cannot be made to vibrate: it stays in one piece then.
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
