//! Fragments: labels of nodes, exact partition of tetrahedra, closed surfaces and masses `[G12 §6]`.

mod build;
mod cuts;
mod junction;
mod label;
mod partition;
mod render;

#[cfg(test)]
mod tests;

pub(crate) use build::build;
pub(crate) use label::{Labels, label};
pub(crate) use render::RenderIndex;
