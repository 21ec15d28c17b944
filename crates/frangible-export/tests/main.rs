//! Written files, read back by others.

mod glb;
mod vtu;
