//! Parts of the search for modes, by which its time is reported.

use std::fmt;

/// Parts of the search for modes, in the order in which they first run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Phase {
    /// Scaling, the order of elimination and the pattern of the factor.
    Ordering,
    /// Numbers of the Cholesky factor.
    Factorization,
    /// Solves with the factor; the whole of a dense eigenproblem.
    Solves,
    /// Products with the mass matrix.
    Mass,
    /// Making each block orthogonal to all before.
    Orthogonalisation,
    /// Eigenvalues of the projected matrix.
    Projected,
    /// Mode shapes from the basis.
    Shapes,
    /// The residual of every mode.
    ResidualCheck,
}

impl Phase {
    /// All of them, in order.
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
