//! Pictures of a [`Recording`](frangible_recording::Recording), by following rays of light on the processor.
//!
//! [`contact_sheet`] shows the four moments of a break on one picture,
//! [`sheet_of_frames`] puts frames of any recordings side by side, and
//! [`render_frame`] draws a single one; all light the scene like a product
//! photograph. [`encode_png`] makes a small file of the result.
//! [`FilmWriter`] writes films, and [`SlowMotion`] says which frame a film shows when.
//!
//! There is no graphics driver, no display and no thread but rayon's: the same
//! recording gives the same picture on any number of threads.
//!
//! A photograph of glass lives by effects that rasters lack: light that is bent twice and shows the far side through the near one, cracks that gleam
//! because light cannot leave the glass there, shards that see each other. So stills are traced path by path, with as many paths per pixel as its
//! noise asks for. The floor's shadow is found exactly, with the light that glass gathers added, and costs nothing per path.

mod caption;
mod caustic;
mod encode;
mod error;
mod exposure;
mod ffmpeg;
mod film;
mod floor_shadow;
mod ground;
mod light;
mod look;
mod optics;
mod path;
mod photograph;
mod photon;
mod picture;
mod random;
mod set;
mod sheet;
mod slow_motion;
mod smooth;
mod stage;
mod studio;
#[cfg(test)]
mod tests;
mod tree;
#[cfg(feature = "webp")]
mod webp;

pub use encode::{encode_png, encode_png_within};
pub use error::PhotoError;
pub use film::{FilmFormat, FilmWriter};
pub use frangible_recording;
pub use picture::Picture;
pub use sheet::{SheetOptions, contact_sheet, sheet_of_frames};
pub use slow_motion::SlowMotion;
pub use studio::{Studio, render_frame};

/// The stage that the renderer of `frangible-draw` lights as these pictures do; its names may change in any release.
#[doc(hidden)]
pub mod internals {
    pub use crate::floor_shadow::{Caster, Casting, Fineness, FloorShadow};
    pub use crate::stage::{StageUnits, casters, clarity, key_light, stage_directions};
    pub use crate::studio::moment_between;
}
