//! Shapes, files and hard surfaces: what is made of them, and what is refused.

#[cfg(feature = "mesh-io")]
mod colors;
mod common;
mod gradient;
mod hard;
mod hard_bodies;
#[cfg(feature = "mesh-io")]
mod read;
mod repair;
mod shapes;
mod tetrahedra;
mod tets;
mod winding;
