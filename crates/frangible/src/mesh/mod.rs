//! Meshes: tetrahedra of the body, triangles of the pieces, and exact mass properties.

mod mass;
mod surface;
mod tet;

pub use mass::MassProperties;
pub use surface::TriMesh;
pub(crate) use tet::{EDGES, FACES};
pub use tet::{NO_NEIGHBOUR, TetMesh};
