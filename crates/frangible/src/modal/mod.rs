//! Vibration modes and their exact response to a force pulse.

mod basis;
mod energy;
mod live;
mod reach;
mod response;
mod step;
mod tick;

pub use basis::ModalBasis;
pub(crate) use energy::ContactEnergy;
pub use energy::contact_energy_within;
pub use live::{LiveModes, SurfacePlace};
pub(crate) use reach::Reaches;
pub use response::{Motion, Oscillator, respond};
pub(crate) use tick::Tick;
