//! Vibration modes and their exact response to a force pulse.

mod basis;
mod energy;
mod oscillator;
mod project;
mod step;
mod tick;

pub use basis::ModalBasis;
pub(crate) use energy::ContactEnergy;
pub use oscillator::Oscillator;
#[doc(hidden)]
pub use tick::Tick;
