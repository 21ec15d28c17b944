//! Signed-distance bodies and the ready shapes.

mod forms;
mod grid;
mod primitives;
mod random;
