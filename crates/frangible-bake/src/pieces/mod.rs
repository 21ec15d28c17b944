//! Vibration of pieces of broken bodies, so that they can break again: two methods, and [`Pieces`], which chooses between them.
//!
//! `frangible-lab pieces` measures the accuracy and cost of each method (`docs/recursive.md`).
//!
//! Every piece gets its own modes. Quasi-static pieces and modes of similar shapes were measured to predict fracture less
//! accurately (`docs/recursive.md`).

#[cfg(feature = "solver")]
mod dense;
#[cfg(feature = "solver")]
mod error;
#[cfg(feature = "solver")]
mod lattice;
mod method;
#[cfg(feature = "solver")]
mod model;
#[cfg(feature = "solver")]
mod parent_modes;
#[cfg(feature = "solver")]
mod reanalysis;

#[cfg(feature = "solver")]
pub use error::PieceError;
pub use method::Method;
#[cfg(feature = "solver")]
pub use model::Pieces;
#[cfg(feature = "solver")]
pub use parent_modes::parent_modes;
#[cfg(feature = "solver")]
pub use reanalysis::reanalysis;
