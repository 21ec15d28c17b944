//! Bakes shapes for `frangible`: tetrahedra, quadratic finite elements, vibration modes.
//!
//! A bake runs once per kind of object, in f64, and gives the immutable [`frangible::Asset`] that the
//! run time shares among all bodies of that kind. [`bake()`] is the front door; its stages can be used on
//! their own: [`shapes`] gives tetrahedra, [`fem`] stiffness and mass, [`eigen`] the modes, [`embed`]
//! locates points in the analysis mesh, [`surface`] finds normals and curvature.
//!
//! Two meshes are made of every shape. The coarse one has quadratic elements and carries the modes;
//! the fine one has linear elements, irregular on purpose, and carries the cracks.

mod bake;
mod cells;
pub mod eigen;
pub mod embed;
mod error;
mod extrude;
pub mod fem;
mod mesh;
mod peak_stress;
mod random;
mod report;
pub mod shapes;
mod sheet;
pub mod surface;

pub use bake::{BakeSpec, bake};
pub use error::BakeError;
pub use mesh::BodyMesh;
pub use report::{BakeReport, MeshReport, Progress, Stage};
pub use shapes::{MeshSize, Shape, Station};
