//! Materials of brittle bodies: [`Material`], and named [`Preset`]s with their sources.
//!
//! A separate crate, so that the table of published values is not part of the fracture model.

mod error;
mod fatigue;
mod laminate;
mod marks;
mod material;
mod presets;
mod temper;

pub use error::{OutOfRange, not_negative, positive};
pub use fatigue::Fatigue;
pub use laminate::{Bending, Laminate};
pub use material::Material;
pub use presets::{Preset, UnknownMaterial};
