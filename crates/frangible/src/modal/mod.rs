//! Vibration modes and their exact response to a force pulse.

mod basis;
mod field;
mod live;
mod response;

pub use basis::ModalBasis;
pub use field::ModeField;
pub use live::{LiveModes, SurfacePlace};
pub use response::{Motion, Oscillator, contact_energy_within, respond};
