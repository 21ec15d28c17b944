//! Errors of baking: each names the fault and how to mend it.

use frangible::InputError;
use frangible_mesh::{RepairError, SolidError, TetError, TetInputError};
use thiserror::Error;

/// Error of a bake.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum BakeError {
    /// A number that must be finite and above zero is not.
    #[error("{what} is {value}; it must be a finite number above zero")]
    NotPositive {
        /// The quantity, with its unit.
        what: &'static str,
        /// The value given.
        value: f64,
    },
    /// A number above the largest one that there can be.
    #[error("{what} is {value}; it must be at most {most}")]
    TooLarge {
        /// The quantity, with its unit.
        what: &'static str,
        /// The value given.
        value: f64,
        /// The largest that is allowed.
        most: f64,
    },
    /// A material or an asset the run time refuses.
    #[error(transparent)]
    Input(#[from] InputError),
    /// A mesh that cannot be mended to a surface.
    #[error(transparent)]
    Repair(#[from] RepairError),
    /// A surface that is no solid.
    #[error(transparent)]
    Solid(#[from] SolidError),
    /// A solid that could not be filled with tetrahedra.
    #[error(transparent)]
    Tetrahedra(TetError),
    /// Tetrahedra from a file that are no body.
    #[error(transparent)]
    TetInput(#[from] TetInputError),
    /// A profile that does not describe a body.
    #[error("profile station {station}: {problem}")]
    Profile {
        /// Index of the station at fault.
        station: usize,
        /// The fault, and how to mend it.
        problem: &'static str,
    },
    /// A mesh that would not fit in a sensible amount of memory.
    #[error(
        "an element edge of {edge} m asks for about {tets} tetrahedra, more than {limit}; use larger elements"
    )]
    TooFine {
        /// Edge length asked for, m.
        edge: f64,
        /// Estimated number of tetrahedra.
        tets: usize,
        /// The most that is allowed.
        limit: usize,
    },
    /// A tetrahedron without volume, or turned inside out.
    #[error(
        "tetrahedron {tet} has a volume of {volume} m³; make the walls thicker or the elements smaller"
    )]
    Inverted {
        /// Index of the tetrahedron.
        tet: usize,
        /// Its signed volume, m³.
        volume: f64,
    },
    /// A support that cannot be used.
    #[error("support {support} {problem}")]
    Support {
        /// Index of the support at fault.
        support: usize,
        /// The fault, and how to mend it.
        problem: &'static str,
    },
    /// A support names a group that the body does not have.
    #[error("there is no group `{name}`{known}")]
    UnknownGroup {
        /// Name asked for.
        name: String,
        /// The group that was probably meant, and the groups that there are.
        known: String,
    },
    /// Supports that leave nothing to move.
    #[error(
        "the supports hold the whole body, so that nothing is left to vibrate; make their regions smaller"
    )]
    AllHeld,
    /// More modes wanted than the analysis mesh has.
    #[error(
        "{wanted} modes wanted, but the analysis mesh has {available}; ask for 1 to {available}, or refine it"
    )]
    Modes {
        /// Number of modes asked for.
        wanted: usize,
        /// Number of elastic modes there are.
        available: usize,
    },
    /// More modes wanted than an asset keeps.
    #[error("{wanted} modes wanted, but an asset keeps at most {most}; ask for 1 to {most}")]
    TooManyModes {
        /// Number of modes asked for.
        wanted: usize,
        /// Most that there can be.
        most: usize,
    },
    /// No mode to follow, or more than there are.
    #[error(
        "{wanted} of {modes} modes are to be followed through time; follow 1 to {modes}, or leave the choice to the bake"
    )]
    Followed {
        /// Number asked for.
        wanted: usize,
        /// Modes that the asset keeps.
        modes: usize,
    },
    /// The shifted stiffness matrix could not be factorized.
    #[error(
        "the stiffness matrix could not be factorized ({reason}); check the mesh for slivers and loose parts"
    )]
    Factorization {
        /// Reason given by the solver.
        reason: String,
    },
    /// The eigenvalue iteration stopped short.
    #[error(
        "only {converged} of {wanted} modes converged within a basis of {basis} vectors; ask for fewer modes"
    )]
    NotConverged {
        /// Modes found.
        converged: usize,
        /// Modes wanted.
        wanted: usize,
        /// Size of the Krylov basis.
        basis: usize,
    },
    /// A mode that does not solve the eigenvalue problem well enough.
    #[error(
        "mode {mode} has a relative residual of {residual:.1e} (limit {limit:.1e}); check the mesh for slivers"
    )]
    Residual {
        /// Index of the mode.
        mode: usize,
        /// ‖Kφ − λMφ‖ / ‖Kφ‖.
        residual: f64,
        /// The most that is allowed.
        limit: f64,
    },
    /// The caller cancelled the bake.
    #[error("the bake was cancelled")]
    Cancelled,
    /// A point of the fracture mesh too far from the analysis mesh.
    #[error(
        "the point ({x:.5}, {y:.5}, {z:.5}) m lies farther from the analysis mesh than a quarter of its elements; \
         refine the analysis mesh"
    )]
    OutsideAnalysisMesh {
        /// Coordinate, m.
        x: f64,
        /// Coordinate, m.
        y: f64,
        /// Coordinate, m.
        z: f64,
    },
}

pub(crate) fn positive(what: &'static str, value: f64) -> Result<(), BakeError> {
    if value.is_finite() && value > 0.0 {
        Ok(())
    } else {
        Err(BakeError::NotPositive { what, value })
    }
}

impl From<TetError> for BakeError {
    fn from(error: TetError) -> Self {
        match error {
            TetError::Cancelled => Self::Cancelled,
            error => Self::Tetrahedra(error),
        }
    }
}
