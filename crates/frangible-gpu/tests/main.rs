//! Checks the GPU's results against the processor's.

mod common;
mod initiation;
mod outcomes;
