//! Errors of baking. Each message says what is wrong and how to fix it.

use std::path::PathBuf;

use frangible::InputError;
use frangible_mesh::{PartError, RepairError, SolidError, TetError, TetInputError};
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
    /// A number above its upper limit.
    #[error("{what} is {value}; it must be at most {most}")]
    TooLarge {
        /// The quantity, with its unit.
        what: &'static str,
        /// The value given.
        value: f64,
        /// The largest that is allowed.
        most: f64,
    },
    /// A material or an asset that the core crate rejects.
    #[error(transparent)]
    Input(#[from] InputError),
    /// A mesh file that cannot be read.
    #[error("{problem}: {}", path.display())]
    File {
        /// Path of the file.
        path: PathBuf,
        /// Reason, in words.
        problem: String,
    },
    /// A mesh that cannot be repaired.
    #[error(transparent)]
    Repair(#[from] RepairError),
    /// Parts of a mesh that cannot be chosen as asked for.
    #[error(transparent)]
    Parts(#[from] PartError),
    /// Several bodies where one is wanted.
    #[error(
        "the mesh has several bodies, but one is wanted ({found}); make a body of each part, or choose `largest` or `weld` for its parts"
    )]
    SeveralParts {
        /// What was found.
        found: String,
    },
    /// Parts chosen of a wall.
    #[error(
        "the parts of a wall cannot be chosen: all its sheets are one body; leave the choice or the thickness of the wall out"
    )]
    PartsOfWall,
    /// A surface that does not enclose a solid.
    #[error(transparent)]
    Solid(#[from] SolidError),
    /// A solid that could not be filled with tetrahedra.
    #[error(transparent)]
    Tetrahedra(TetError),
    /// Tetrahedra from a file that do not form a body.
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
    /// A mesh with too many elements to fit in memory.
    #[error(
        "an element edge of {edge} m takes about {tets} tetrahedra, more than the limit of {limit}; use larger elements"
    )]
    TooFine {
        /// Requested edge length, m.
        edge: f64,
        /// Estimated number of tetrahedra.
        tets: usize,
        /// Largest allowed number.
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
    /// A wall that bends so sharply that its elements would cross.
    #[error(
        "a wall of {thickness:.2e} m bends too sharply for elements of {edge:.2e} m; make it thinner, or request more tetrahedra"
    )]
    Fold {
        /// Thickness of the wall, m.
        thickness: f64,
        /// Edge length of the elements, m.
        edge: f64,
    },
    /// An open sheet without thickness.
    #[error(
        "the surface is an open sheet that encloses no body; give it a thickness with `--wall METRES` (in Rust, `ImportOptions::wall`), or close it"
    )]
    OpenSheet,
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
        /// Requested name.
        name: String,
        /// The most similar name, and the names of all groups.
        known: String,
    },
    /// Supports that fix the whole body.
    #[error("the supports fix the whole body, so nothing can vibrate; make their regions smaller")]
    AllHeld,
    /// More modes requested than the analysis mesh has.
    #[error(
        "{wanted} modes requested, but the analysis mesh has {available}; request 1 to {available}, or refine the mesh"
    )]
    Modes {
        /// Requested number of modes.
        wanted: usize,
        /// Number of elastic modes of the mesh.
        available: usize,
    },
    /// More modes requested than an asset keeps.
    #[error("{wanted} modes requested, but an asset keeps at most {most}; request 1 to {most}")]
    TooManyModes {
        /// Requested number of modes.
        wanted: usize,
        /// Largest allowed number.
        most: usize,
    },
    /// No mode to integrate through time, or more than the asset keeps.
    #[error(
        "cannot integrate {wanted} of {modes} modes through time; choose 1 to {modes}, or let the bake choose"
    )]
    Followed {
        /// Requested number.
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
    /// The eigenvalue iteration did not converge.
    #[error(
        "only {converged} of {wanted} modes converged within a basis of {basis} vectors; request fewer modes"
    )]
    NotConverged {
        /// Number of modes that converged.
        converged: usize,
        /// Requested number of modes.
        wanted: usize,
        /// Size of the Krylov basis.
        basis: usize,
    },
    /// A mode whose residual is too large.
    #[error(
        "mode {mode} has a relative residual of {residual:.1e} (limit {limit:.1e}); check the mesh for slivers"
    )]
    Residual {
        /// Index of the mode.
        mode: usize,
        /// ‖Kφ − λMφ‖ / ‖Kφ‖.
        residual: f64,
        /// Largest allowed residual.
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
