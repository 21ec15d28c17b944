//! Sound of breaking bodies.

mod bad_input;
mod baked;
mod common;
mod landing;
mod level;
mod live;
mod radiation;
mod synth;
mod touch;
