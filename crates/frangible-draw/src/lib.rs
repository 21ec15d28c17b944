//! Drawing with the graphics driver: frames of films, vibration mode shapes, and the stage in a window.
//!
//! [`Raster`] draws frames of a [`Recording`](frangible_recording::Recording) in a twentieth of the time that `frangible_photo` takes for
//! path tracing; [`mode_sheet`] draws mode shapes coloured by a quantity; [`LiveStage`] continuously draws the same stage into a window.
//!
//! Drawing requires a graphics driver but no display; a software driver such as Mesa's lavapipe suffices. [`has_adapter`] returns true if there is
//! one; without it, all functions return [`DrawError::NoAdapter`]. On the same machine the same recording gives the same picture. In a browser,
//! only the stage in a window is available.

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
