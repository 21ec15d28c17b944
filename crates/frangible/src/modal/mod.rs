//! Vibration modes and their exact response to a force pulse.

mod basis;
mod energy;
mod project;
mod response;
mod step;
mod tick;

pub use basis::ModalBasis;
pub(crate) use energy::ContactEnergy;
pub use response::{Motion, Oscillator, respond};
#[doc(hidden)]
pub use tick::Tick;
