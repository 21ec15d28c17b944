//! Vibration modes and their exact response to a force pulse.

mod basis;
mod response;

pub use basis::ModalBasis;
pub use response::{Motion, Oscillator, peak_contact_energy, respond};
