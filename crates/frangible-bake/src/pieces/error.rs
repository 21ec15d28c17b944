//! Errors of computing the modes of a piece.

use crate::BakeError;
use frangible::InputError;
use thiserror::Error;

/// Error of computing the modes of a piece, which then cannot break again.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PieceError {
    /// The finite elements of the piece are invalid.
    #[error(transparent)]
    Elements(#[from] BakeError),
    /// The computed modes do not match the piece.
    #[error(transparent)]
    Body(#[from] InputError),
    /// A piece that consists of parts of cut tetrahedra.
    #[error("a piece has no uncut tetrahedra, and so no modes; it cannot break again")]
    NoTetrahedra,
    /// A matrix that cannot be factored.
    #[error(
        "the stiffness matrix of a piece cannot be factorized ({reason}); the piece cannot break again"
    )]
    Factorization {
        /// Reason given by the solver.
        reason: String,
    },
}
