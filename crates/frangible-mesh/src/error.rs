//! Errors of meshing. Each message says what is wrong and how to fix it.

use thiserror::Error;

/// Error of meshing a solid.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum TetError {
    /// A number that must be finite and above zero is not.
    #[error("{what} is {value}; it must be a finite number above zero")]
    NotPositive {
        /// The quantity, with its unit.
        what: &'static str,
        /// The value given.
        value: f64,
    },
    /// More lattice points than fit in memory.
    #[error(
        "a lattice cell of {cell:.2e} m gives {points:.1e} lattice points in the body's bounding box, more than {limit:.0e}; request fewer tetrahedra"
    )]
    TooFine {
        /// Side of a lattice cube, m.
        cell: f64,
        /// Number of lattice points.
        points: f64,
        /// The most that are allowed.
        limit: f64,
    },
    /// No lattice point lies inside.
    #[error(
        "no part of the body is as thick as the lattice cell of {cell:.2e} m; request more tetrahedra"
    )]
    Nothing {
        /// Side of a lattice cube, m.
        cell: f64,
    },
    /// Walls too thin for the number of tetrahedra allowed.
    #[error(
        "walls of {wall:.2e} m need about {needed} tetrahedra, more than the {limit} allowed; request {needed} or make the walls thicker"
    )]
    TooThin {
        /// Thickness of the thin walls, m.
        wall: f64,
        /// Number of tetrahedra that they need.
        needed: usize,
        /// The most that are allowed.
        limit: usize,
    },
    /// A body in several pieces, none of them the main one.
    #[error(
        "the body consists of {pieces} separate pieces, the largest with {share:.0} % of the volume; join them, or put each in its own file"
    )]
    Pieces {
        /// Number of pieces.
        pieces: usize,
        /// Share of the largest in the volume, per cent.
        share: f64,
    },
    /// Parts joined only along edges, which repeated repairs did not resolve.
    #[error(
        "parts of the body are joined only along edges; request slightly more or fewer tetrahedra"
    )]
    Pinched,
    /// A tetrahedron flatter than promised.
    #[error(
        "the worst dihedral angle is {angle:.1}°, below {limit}°; request slightly more or fewer tetrahedra"
    )]
    Sliver {
        /// Smallest dihedral angle, degrees.
        angle: f64,
        /// Smallest allowed angle, degrees.
        limit: f64,
    },
    /// The caller cancelled the meshing.
    #[error("meshing was cancelled")]
    Cancelled,
}
