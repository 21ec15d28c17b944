//! Vibration of pieces of broken bodies, so that they break again: two ways, and [`Pieces`], which chooses.
//!
//! Accuracy and cost of each way are measured by `frangible-lab pieces` (`docs/recursive.md`).
//!
//! Every piece gets modes of its own. Pieces that react without inertia, and modes borrowed from similar shapes, were measured
//! to decide worse (`docs/recursive.md`).

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
