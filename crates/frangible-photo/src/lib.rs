//! Path-traced pictures of a [`Recording`](frangible_recording::Recording), rendered on the CPU.
//!
//! [`contact_sheet`] shows the four moments of a break on one picture,
//! [`sheet_of_frames`] puts frames of any recordings side by side, and
//! [`render_frame`] draws a single one; all light the scene like a product
//! photograph. [`encode_png`] makes a small file of the result.
//! [`FilmWriter`] writes films, and [`SlowMotion`] says which frame a film shows when.
//!
//! It needs no graphics driver and no display. The same recording gives the same picture on any number of threads.
//!
//! Realistic glass needs effects that rasterization lacks: double refraction, total internal reflection at cracks, and reflections between shards.
//! So stills are path-traced, with an adaptive number of paths per pixel. The shadow of the floor is computed exactly, including caustics, at no
//! cost per path.

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
