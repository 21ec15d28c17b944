//! Pictures of a [`Recording`](frangible_export::Recording), without a window.
//!
//! [`contact_sheet`] shows the four moments of a break on one picture,
//! [`sheet_of_frames`] puts frames of any recordings side by side, and
//! [`render_frame`] draws a single one; all light the scene like a product
//! photograph. [`mode_sheet`] shows shapes of vibration, coloured by a number.
//! [`encode_png`] makes a small file of the result. [`LiveStage`] draws the same stage into a window, over and over.
//!
//! Drawing takes a graphics driver but no display: a software driver such as
//! Mesa's lavapipe will do. [`has_adapter`] tells whether there is one; without
//! it everything here returns [`DrawError::NoAdapter`]. On one machine the same
//! recording gives the same picture.

mod adapter;
mod backdrop;
mod camera;
mod color_map;
mod encode;
mod error;
mod field;
mod floor;
mod floor_shadow;
mod live;
mod mode_sheet;
mod renderer;
mod scale;
mod sheet;
mod stage;
mod studio;
mod traced;

pub use adapter::{has_adapter, is_software};
pub use camera::StillCamera;
pub use encode::{encode_png, encode_png_within};
pub use error::DrawError;
pub use image::RgbImage;
pub use kiss3d;
pub use live::{LiveMesh, LiveShadow, LiveStage, Looks, Place, ShadowCaster, value_color};
pub use mode_sheet::{ModeCell, ModeSheetOptions, mode_sheet};
pub use sheet::{SheetOptions, contact_sheet, sheet_of_frames};
pub use studio::{Studio, render_frame};
pub use traced::GoOn;
