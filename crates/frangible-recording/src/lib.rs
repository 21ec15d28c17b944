//! Recordings of scenes, as plain data.
//!
//! A [`Recording`] contains meshes, one rigid node per piece with a pose per frame, materials, a camera and the key frames; also each blow with
//! its force history and cracks, and the contacts of pieces, for slow-motion films and for sound. It is the interface between the solver and
//! the renderers, and depends on neither.
//!
//! [`write_atomically`] writes a file so that readers never see a partial one; [`make_folder`] and [`try_file`] check beforehand that it can be
//! written.
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
pub use frangible_geometry::{Blending, Image, ImageKind, Placement, Texture, TextureSlot, Wrap};
pub use glam;
pub use place::{make_folder, try_file};
pub use recording::{
    Floor, Grain, MeshPart, Moments, Pose, RecordedBlow, RecordedCrack, RecordedMesh, RecordedNode,
    RecordedPulse, RecordedSlide, RecordedTouch, Recording, SurfaceMaterial, View,
};
