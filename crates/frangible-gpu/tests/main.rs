//! What the GPU finds, checked against the processor.

mod common;
mod initiation;
mod outcomes;
