//! How pieces of broken bodies vibrate, so that they break again.

mod error;
mod lattice;
mod reanalysis;

pub use error::PieceError;
pub use reanalysis::reanalysis;
