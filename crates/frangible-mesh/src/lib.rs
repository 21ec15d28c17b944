//! Tetrahedral meshing of arbitrary surfaces and signed distance functions.
//!
//! A mesh file is read as an [`InputMesh`] (kept unchanged for rendering), repaired to a [`Surface`], converted to a [`Solid`] by its generalised
//! winding number, and filled with tetrahedra.
//!
//! A separate crate, because it needs no finite elements: its tests and fuzz targets build in seconds, and it is useful on its own.

pub mod distance;
mod error;
mod input;
mod mend_tets;
mod parts;
pub mod quality;
#[doc(hidden)]
pub mod random;
#[cfg(feature = "mesh-io")]
mod read;
#[cfg(feature = "mesh-io")]
mod read_tets;
mod repair;
pub mod shapes;
mod similarity;
mod slivers;
mod solid;
mod stuffing;
mod surface;
mod tet_input;
mod tetrahedralize;
mod tets;
mod wall;
mod watch;
mod winding;

pub use distance::DistanceSolid;
pub use error::TetError;
pub use frangible_geometry::{Blending, Image, ImageKind, Placement, Texture, TextureSlot, Wrap};
pub use glam;
pub use input::{InputGroup, InputMaterial, InputMesh};
pub use mend_tets::{MendedTets, NodeGroup, TetInputError, TetMend, mend_tets};
pub use parts::{ChosenBody, ChosenParts, Gap, Part, PartChoice, PartError, Parts};
#[cfg(feature = "mesh-io")]
pub use read::{
    MOST_BYTES, MOST_TRIANGLES, MeshFormat, ReadError, did_you_mean, is_address, nearest_file,
    nearest_name, parse_mesh, parse_mesh_named, read_mesh,
};
#[cfg(feature = "mesh-io")]
pub use read_tets::{TetFormat, parse_tetgen, parse_tets, read_tets};
pub use repair::{RepairError, RepairReport, repair, repair_skin};
pub use shapes::{READY_SHAPES, ready_shape};
pub use similarity::Similarity;
pub use solid::{Solid, SurfacePoint};
pub use stuffing::counted_volume;
pub use surface::Surface;
pub use tet_input::{TetGroup, TetInput};
pub use tetrahedralize::{
    CELLS_PER_WALL, Resolution, SMALLEST_ANGLE, TetOptions, TetReport, VolumeAim, tetrahedralize,
    tetrahedralize_watched,
};
pub use tets::TetBody;
pub use tets::features::Features;
pub use wall::{Wall, WallMesh};
pub use winding::{
    MeshSolid, Nearest, SkinWall, SolidError, Thickness, WeldedSolid, wall_thickness,
};
