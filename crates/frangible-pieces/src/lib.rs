//! How pieces of broken bodies vibrate, so that they break again.

mod error;
mod lattice;
mod parent_modes;
mod quasi_static;
mod proxy;
mod reanalysis;

pub use error::PieceError;
pub use parent_modes::parent_modes;
pub use quasi_static::quasi_static;
pub use proxy::ProxyLibrary;
pub use reanalysis::reanalysis;
