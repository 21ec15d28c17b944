//! Fragments: labels of nodes, exact partition of tetrahedra, closed surfaces and masses `[G12 §6]`.

mod bearing;
mod build;
mod components;
mod draft;
mod finish;
mod foreign;
mod fractured;
mod index;
mod junction;
mod label;
mod partition;
mod points;
mod render;

#[cfg(test)]
mod junction_tests;
#[cfg(test)]
mod label_tests;
#[cfg(test)]
mod tests;

pub(crate) use bearing::Bearing;
pub(crate) use build::{Built, build};
pub use foreign::{CutEdge, interfaces_of_labels, pieces_of_cuts};
pub(crate) use index::MeshIndex;
pub(crate) use label::{Labels, label};
pub(crate) use partition::{Point, face_parts, interfaces};
pub(crate) use points::PointTable;
pub(crate) use render::{RenderIndex, draw};
