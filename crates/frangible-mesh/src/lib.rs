//! Any surface or signed distance in, sound tetrahedra out.
//!
//! A mesh file becomes an [`InputMesh`] (what is drawn, kept as it is), is repaired to a [`Surface`] (what is
//! solid), becomes a [`Solid`] by its generalised winding number, and is filled with tetrahedra.

pub mod distance;
mod input;
pub mod shapes;
mod solid;
mod surface;

pub use distance::DistanceSolid;
pub use glam;
pub use input::{InputMaterial, InputMesh};
pub use shapes::{READY_SHAPES, ready_shape};
pub use solid::{Solid, SurfacePoint};
pub use surface::Surface;
