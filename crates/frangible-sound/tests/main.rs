//! Sound of breaking bodies.

mod bad_input;
mod baked;
mod common;
mod level;
mod live;
mod radiation;
mod synth;
mod touch;
