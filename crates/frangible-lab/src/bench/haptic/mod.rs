//! A loop of 1 kHz that feels a body: force and displacement of the surface at every tick, and whether it breaks.
//!
//! The work of a tick is in [`touch`], the hand that holds the probe in [`hand`], the verdicts from another thread in [`judge`],
//! the vibration of the body from tick to tick in [`live`].
//! `examples/haptic.rs` is the loop by itself, [`measure`] the one that is timed.

pub mod hand;
pub mod judge;
pub mod live;
mod run;
pub mod touch;

pub use run::{Findings, Kept, Options, Taps, measure};
