//! A triangle surface as a solid: inside is where its generalised winding number exceeds one half.
//!
//! J13: Jacobson, Kavan, Sorkine-Hornung 2013, "Robust inside-outside segmentation using generalized winding numbers".
//! B18: Barill, Dickson, Schmidt, Levin, Jacobson 2018, "Fast winding numbers for soups and clouds".

mod faces;
mod far;
mod mesh_solid;
mod moments;
mod nearest;
mod number;
mod packet;
mod segment;
mod skin_wall;
mod thickness;
mod tree;
mod welded;

pub(crate) use faces::FaceTree;
pub use mesh_solid::{MeshSolid, SolidError};
pub use nearest::Nearest;
pub use skin_wall::SkinWall;
pub use thickness::{Thickness, wall_thickness};
pub use welded::WeldedSolid;
