//! How pieces of broken bodies vibrate, so that they break again: four ways, and [`Pieces`], which chooses.
//!
//! How right each way is, and what it costs, is measured by `frangible verify pieces` (`docs/recursive.md`).

mod dense;
mod error;
mod lattice;
mod model;
mod parent_modes;
mod proxy;
mod quasi_static;
mod reanalysis;

pub use error::PieceError;
pub use model::{Method, Pieces};
pub use parent_modes::parent_modes;
pub use proxy::ProxyLibrary;
pub use quasi_static::quasi_static;
pub use reanalysis::reanalysis;
