//! Written files, read back by others.

mod glb;
mod looks;
mod vtu;
