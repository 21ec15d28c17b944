//! Record of a scene, as plain data.
//!
//! A [`Recording`] holds meshes, one rigid node per shard with a pose per
//! frame, materials, a camera and the frames worth looking at; besides, each
//! blow with its force over time and its cracks, and where pieces touched, for
//! films between two frames and for sound. It knows neither the solver nor the
//! renderer; both meet in it.
//!
//! [`write_atomically`] puts bytes on disk so that no reader ever finds half a
//! file under the final name; [`make_folder`] and [`try_file`] prove beforehand
//! that there is a place for it.
//!
//! The world is right-handed, y up, in metres, kilograms and seconds, as in
//! glTF.

mod atomic;
mod bounds;
mod error;
mod place;
mod recording;
mod validate;

pub use atomic::write_atomically;
pub use error::{RecordingError, WriteError};
pub use glam;
pub use place::{make_folder, try_file};
pub use recording::{
    Floor, Grain, MeshPart, Moments, Pose, Pulse, RecordedBlow, RecordedCrack, RecordedMesh,
    RecordedNode, RecordedSlide, RecordedTouch, Recording, SurfaceMaterial, View,
};
