//! A loop of 1 kHz that feels a body: force and displacement of the surface at every tick, and whether it breaks.
//!
//! What a tick does is in [`touch`]; who holds the probe in [`hand`]; what is waited for on another thread in [`judge`];
//! how the body vibrates from tick to tick in [`live`].
//! `examples/haptic.rs` is the loop by itself, [`measure`] the one that is timed.

pub mod hand;
pub mod judge;
pub mod live;
mod run;
pub mod touch;

pub use run::{Findings, Kept, Options, Taps, measure};
