//! Crack initiation on a GPU.

mod common;
mod initiation;
mod outcomes;
