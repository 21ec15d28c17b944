//! Meshes: tetrahedra of the body, triangles of the pieces, and exact mass properties.

mod along;
mod boxes;
mod by_node;
mod closest;
mod convex;
mod mass;
mod render;
mod rows;
mod smooth;
mod surface;
mod tet;
mod tree;

pub use along::AlongSurface;
pub(crate) use by_node::ByNode;
pub use closest::closest_on_triangle;
pub use convex::{merged_parts, thinned};
pub use mass::MassProperties;
pub use render::{RenderMesh, box_projection};
pub(crate) use rows::Rows;
pub(crate) use smooth::smooth_normals;
pub use surface::TriMesh;
pub(crate) use tet::{EDGES, FACES};
pub use tet::{NO_NEIGHBOUR, TetMesh};
#[doc(hidden)]
pub use tree::SurfacePoint;
pub(crate) use tree::TriangleTree;
