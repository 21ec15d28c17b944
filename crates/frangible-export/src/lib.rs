//! Writes broken bodies to files for other programs.
//!
//! * [`write_glb`] turns a [`Recording`](frangible_recording::Recording) into one binary glTF 2.0 file that
//!   browsers, Blender and game engines play. The same recording gives the
//!   same bytes.
//! * [`write_vtu`] writes tetrahedra with fields at their nodes for ParaView.

mod error;
mod glb;
mod vtu;

pub use error::ExportError;
pub use frangible_recording;
pub use glb::{GlbOptions, write_glb, write_glb_with};
pub use vtu::{VtuCells, VtuField, VtuMesh, VtuValues, write_vtu};
