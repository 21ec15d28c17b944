//! Phases of the modal analysis, for reporting its time.

use std::fmt;

/// Phases of the modal analysis, in the order of their first run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Phase {
    /// Scaling, elimination ordering and symbolic factorization.
    Ordering,
    /// Numerical Cholesky factorization.
    Factorization,
    /// Solves with the factor, or the whole solution of a dense eigenproblem.
    Solves,
    /// Products with the mass matrix.
    Mass,
    /// Orthogonalization of each block against all previous ones.
    Orthogonalisation,
    /// Eigenvalues of the projected matrix.
    Projected,
    /// Computation of the mode shapes from the basis.
    Shapes,
    /// Check of the residual of every mode.
    ResidualCheck,
}

impl Phase {
    /// All phases, in order.
    pub const ALL: [Self; 8] = [
        Self::Ordering,
        Self::Factorization,
        Self::Solves,
        Self::Mass,
        Self::Orthogonalisation,
        Self::Projected,
        Self::Shapes,
        Self::ResidualCheck,
    ];
}

impl fmt::Display for Phase {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Ordering => "ordering",
            Self::Factorization => "factorization",
            Self::Solves => "solves",
            Self::Mass => "mass products",
            Self::Orthogonalisation => "orthogonalisation",
            Self::Projected => "projected eigenproblem",
            Self::Shapes => "mode shapes",
            Self::ResidualCheck => "residual check",
        })
    }
}
