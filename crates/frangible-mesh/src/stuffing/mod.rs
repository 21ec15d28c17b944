//! Tetrahedra for any solid, by isosurface stuffing.

mod grid;
mod lattice;
mod stencil;
mod warp;

pub use grid::counted_volume;
pub(crate) use lattice::Lattice;
pub(crate) use stencil::cut;
pub(crate) use warp::warp;
