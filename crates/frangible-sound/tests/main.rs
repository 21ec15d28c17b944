//! Sound of breaking bodies.

mod bad_input;
mod baked;
mod common;
mod live;
mod radiation;
mod synth;
mod touch;
