//! Any surface or signed distance in, sound tetrahedra out.
//!
//! A mesh file becomes an [`InputMesh`] (what is drawn, kept as it is), is repaired to a [`Surface`] (what is
//! solid), becomes a [`Solid`] by its generalised winding number, and is filled with tetrahedra.

mod input;
mod solid;
mod surface;
mod winding;

pub use glam;
pub use input::{InputMaterial, InputMesh};
pub use solid::{Solid, SurfacePoint};
pub use surface::Surface;
pub use winding::{MeshSolid, Nearest, SolidError, Thickness, wall_thickness};
