//! Where the time of the mode stage goes, how far it has come, and whether to go on.

use std::fmt;
use std::ops::ControlFlow;
use std::time::Instant;

use crate::error::BakeError;

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

/// Progress to the caller, and seconds by phase.
pub(crate) struct Watch<'a> {
    progress: &'a mut dyn FnMut(f64) -> ControlFlow<()>,
    told: f64,
    seconds: [f64; Phase::ALL.len()],
}

impl<'a> Watch<'a> {
    pub(crate) fn new(progress: &'a mut dyn FnMut(f64) -> ControlFlow<()>) -> Self {
        Self {
            progress,
            told: 0.0,
            seconds: [0.0; Phase::ALL.len()],
        }
    }

    /// Tells the caller that `share` of the work is done, never less than before.
    ///
    /// # Errors
    /// [`BakeError::Cancelled`] when the caller has had enough.
    pub(crate) fn tell(&mut self, share: f64) -> Result<(), BakeError> {
        self.told = self.told.max(share.clamp(0.0, 1.0));
        match (self.progress)(self.told) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(BakeError::Cancelled),
        }
    }

    /// Adds what `work` takes to a phase.
    pub(crate) fn time<R>(&mut self, phase: Phase, work: impl FnOnce() -> R) -> R {
        let started = Instant::now();
        let result = work();
        self.seconds[phase as usize] += started.elapsed().as_secs_f64();
        result
    }

    /// Wall-clock seconds of each phase.
    pub(crate) fn seconds(&self) -> Vec<(Phase, f64)> {
        Phase::ALL.into_iter().zip(self.seconds).collect()
    }
}
