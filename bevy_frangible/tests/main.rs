//! Bodies that break in Bevy, without a window.

#[cfg(feature = "avian")]
mod avian;
#[cfg(feature = "avian")]
mod common;
#[cfg(feature = "avian")]
mod debris;
#[cfg(feature = "avian")]
mod engines;
#[cfg(all(feature = "avian", feature = "gizmos"))]
mod gizmos;
#[cfg(feature = "avian")]
mod held;
#[cfg(feature = "avian")]
mod looks;
#[cfg(feature = "avian")]
mod pieces;
#[cfg(feature = "rapier")]
mod rapier;
#[cfg(feature = "avian")]
mod refusals;
#[cfg(feature = "avian")]
mod resting;
#[cfg(feature = "sound")]
mod sound;
