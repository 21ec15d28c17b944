//! Writes what broke.
//!
//! A [`Recording`] is plain data: meshes, one rigid node per shard with a pose
//! per frame, materials, a camera and the frames worth looking at; besides, each
//! blow with its force over time and its cracks, and where pieces touched, for
//! films between two frames and for sound. It knows neither the solver nor the
//! renderer; both meet in it.
//!
//! * [`write_glb`] turns a recording into one binary glTF 2.0 file that
//!   browsers, Blender and game engines play. The same recording gives the
//!   same bytes.
//! * [`write_vtu`] writes tetrahedra with fields at their nodes for ParaView.
//! * [`write_atomically`] puts bytes on disk so that no reader ever finds half
//!   a file under the final name; [`make_folder`] and [`try_file`] prove
//!   beforehand that there is a place for it.
//!
//! The world is right-handed, y up, in metres, kilograms and seconds, as in
//! glTF.

mod atomic;
mod bounds;
mod error;
mod glb;
mod place;
mod recording;
mod validate;
mod vtu;

pub use atomic::write_atomically;
pub use error::{ExportError, RecordingError};
pub use glam;
pub use glb::write_glb;
pub use place::{make_folder, try_file};
pub use recording::{
    Floor, Grain, MeshPart, Moments, Pose, Pulse, RecordedBlow, RecordedCrack, RecordedMesh,
    RecordedNode, RecordedSlide, RecordedTouch, Recording, SurfaceMaterial, View,
};
pub use vtu::{VtuCells, VtuField, VtuMesh, VtuValues, write_vtu};
