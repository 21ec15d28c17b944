//! The material of a brittle body: [`Material`], and materials by name as [`Preset`]s with their sources.
//!
//! It is a crate of its own because a table of published numbers is no part of the computation of a break.

mod error;
mod fatigue;
mod material;
mod presets;

pub use error::{OutOfRange, not_negative, positive};
pub use fatigue::Fatigue;
pub use material::Material;
pub use presets::{Preset, UnknownMaterial};
