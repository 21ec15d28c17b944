//! Drawing by the graphics driver: frames of films, shapes of vibration, and the stage in a window.
//!
//! [`Raster`] draws frames of a [`Recording`](frangible_recording::Recording) in a twentieth of the time that
//! `frangible_photo` takes to follow light, [`mode_sheet`] shapes of vibration, coloured by a number.
//! [`LiveStage`] draws the same stage into a window, over and over.
//!
//! Drawing takes a graphics driver but no display: a software driver such as Mesa's lavapipe will do. [`has_adapter`] returns true if there is one;
//! without it everything here returns [`DrawError::NoAdapter`]. On one machine the same recording gives the same picture. In a browser there is only
//! the stage in a window.

// Code for pictures is unused on a page.
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
mod error;
mod field;
mod floor;
mod live;
#[cfg(not(target_family = "wasm"))]
mod mode_sheet;
#[cfg(not(target_family = "wasm"))]
mod raster;
#[cfg(not(target_family = "wasm"))]
mod renderer;
#[cfg(not(target_family = "wasm"))]
mod scale;
mod stage;

#[cfg(not(target_family = "wasm"))]
pub use adapter::{has_adapter, is_software, quiet_the_drivers};
pub use camera::StillCamera;
#[cfg(target_family = "wasm")]
pub use canvas::open_canvas;
#[cfg(not(target_family = "wasm"))]
pub use colored::ColoredSurface;
pub use error::DrawError;
pub use field::SurfaceLine;
pub use frangible_photo;
pub use kiss3d;
pub use live::{
    LiveCasting, LiveMesh, LiveShadow, LiveStage, Looks, Place, ShadowCaster, has_storage_buffers,
    value_color,
};
#[cfg(not(target_family = "wasm"))]
pub use mode_sheet::{ModeCell, ModeSheetOptions, mode_sheet};
#[cfg(not(target_family = "wasm"))]
pub use raster::Raster;
