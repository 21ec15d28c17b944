//! The meshes of bodies and of their pieces, and queries on them.
//!
//! - [`TetMesh`]: linear tetrahedra with their neighbours; [`TriMesh`]: the closed surface of a piece; [`RenderMesh`]: its render mesh;
//! - [`RenderSurface`]: the authored surface, and [`RenderIndex`], which divides it among the pieces;
//! - [`FineFaces`]: crack faces finer than the mesh, for pictures;
//! - [`TriangleTree`]: the closest point of a surface; [`AlongSurface`]: distances along one; [`MassProperties`]: mass, centre and inertia;
//! - [`symmetric_eigen`]: principal values and axes of a stress or an inertia;
//! - [`merged_parts`], [`ConvexHull`], [`thinned`], [`bounds`] and [`box_of`]: fewer and simpler convex parts for colliders;
//! - [`WallFaces`]: the two faces of a thin wall; [`PlaneCells`]: cells that divide a part of a plane; [`Grid`]: lists by the squares of a plane;
//! - [`footing`]: the corners with which a body stands on a plane;
//! - [`Rows`], [`ByNode`], [`DisjointSets`]: lists, tables and sets of indices.
//!
//! The core, the bake and the mesher share this crate. It contains neither physics nor file formats.

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

mod along;
mod boxes;
mod by_node;
mod cells;
mod closest;
mod convex;
mod disjoint;
mod drawn;
mod eigen;
mod fine;
mod footing;
mod hull;
mod hulls;
mod mass;
#[cfg(test)]
mod random;
mod render;
mod rows;
mod smooth;
mod surface;
mod tet;
mod threads;
mod tree;
mod wall;

pub use along::AlongSurface;
pub use by_node::ByNode;
pub use cells::PlaneCells;
pub use closest::closest_on_triangle;
pub use convex::{bounds, box_of, merged_parts, thinned};
pub use disjoint::DisjointSets;
pub use drawn::{
    Blending, Boundary, Division, Image, ImageKind, Part, Parts, Piece as DrawnPiece, Placement,
    RenderIndex, RenderMaterial, RenderSurface, Texture, TextureSlot, Wrap, linear_color,
};
pub use eigen::symmetric_eigen;
pub use fine::FineFaces;
pub use footing::{Corner, footing};
pub use glam;
pub use hull::ConvexHull;
pub use hulls::hulls_of_parts;
pub use mass::MassProperties;
pub use render::{RenderMesh, box_projection};
pub use rows::Rows;
pub use smooth::smooth_normals;
pub use surface::TriMesh;
pub use tet::{EDGES, FACES, NO_NEIGHBOUR, TetMesh};
pub use threads::{Pool, Threads};
pub use tree::{SurfacePoint, TriangleTree};
pub use wall::{Grid, WallFaces};
