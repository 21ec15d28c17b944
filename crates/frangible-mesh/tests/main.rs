//! Shapes, files and hard surfaces: results and refusals.

#[cfg(feature = "mesh-io")]
mod colors;
mod common;
mod gradient;
mod hard;
mod hard_bodies;
mod parts;
#[cfg(feature = "mesh-io")]
mod read;
mod repair;
mod shapes;
mod tetrahedra;
mod tets;
mod wall;
mod welded;
mod winding;
