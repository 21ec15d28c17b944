//! The viewer without its window.

mod common;
#[cfg(feature = "window")]
mod film;
mod hammer;
mod host;
mod meshes;
mod session;
mod sound;
mod wire;
mod worker;
