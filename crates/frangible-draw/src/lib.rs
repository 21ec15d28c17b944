//! Pictures of a [`Recording`](frangible_export::Recording), without a window.
//!
//! [`contact_sheet`] shows the four moments of a break on one picture,
//! [`sheet_of_frames`] puts frames of any recordings side by side, and
//! [`render_frame`] draws a single one; all light the scene like a product
//! photograph. [`mode_sheet`] shows shapes of vibration, coloured by a number.
//! [`encode_png`] makes a small file of the result. [`LiveStage`] draws the same stage into a window, over and over.
//!
//! Stills follow rays of light on the processor; films and windows are drawn by the
//! graphics driver, in a fraction of the time.
//!
//! Drawing takes a graphics driver but no display: a software driver such as
//! Mesa's lavapipe will do. [`has_adapter`] tells whether there is one; without
//! it everything here returns [`DrawError::NoAdapter`]. On one machine the same
//! recording gives the same picture. In a browser there is only the stage in a window.

// What only pictures use.
#![cfg_attr(target_family = "wasm", allow(dead_code))]

#[cfg(not(target_family = "wasm"))]
mod adapter;
mod backdrop;
mod camera;
#[cfg(target_family = "wasm")]
mod canvas;
mod color_map;
#[cfg(not(target_family = "wasm"))]
mod colored;
mod encode;
mod error;
#[cfg(not(target_family = "wasm"))]
mod ffmpeg;
mod field;
#[cfg(not(target_family = "wasm"))]
mod film;
mod floor;
mod floor_shadow;
mod live;
#[cfg(not(target_family = "wasm"))]
mod mode_sheet;
#[cfg(not(target_family = "wasm"))]
mod photo;
#[cfg(not(target_family = "wasm"))]
mod renderer;
#[cfg(not(target_family = "wasm"))]
mod scale;
#[cfg(not(target_family = "wasm"))]
mod sheet;
#[cfg(not(target_family = "wasm"))]
mod slow_motion;
mod stage;
#[cfg(not(target_family = "wasm"))]
mod studio;
#[cfg(not(target_family = "wasm"))]
mod webp;

#[cfg(not(target_family = "wasm"))]
pub use adapter::{has_adapter, is_software, quiet_the_drivers};
pub use camera::StillCamera;
#[cfg(target_family = "wasm")]
pub use canvas::open_canvas;
#[cfg(not(target_family = "wasm"))]
pub use colored::ColoredSurface;
pub use encode::{encode_png, encode_png_within};
pub use error::DrawError;
pub use field::SurfaceLine;
#[cfg(not(target_family = "wasm"))]
pub use film::{FilmFormat, FilmWriter};
pub use image::RgbImage;
pub use kiss3d;
pub use live::{
    LiveCasting, LiveMesh, LiveShadow, LiveStage, Looks, Place, ShadowCaster, has_storage_buffers,
    value_color,
};
#[cfg(not(target_family = "wasm"))]
pub use mode_sheet::{ModeCell, ModeSheetOptions, mode_sheet};
#[cfg(not(target_family = "wasm"))]
pub use sheet::{SheetOptions, contact_sheet, sheet_of_frames};
#[cfg(not(target_family = "wasm"))]
pub use slow_motion::SlowMotion;
#[cfg(not(target_family = "wasm"))]
pub use studio::{GoOn, Studio, render_frame};
