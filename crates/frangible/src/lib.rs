//! Real-time, physically based brittle fracture.

pub mod asset;
pub mod body;
pub mod config;
pub mod contact;
mod crack;
pub mod error;
mod fragment;
pub mod impact;
pub mod material;
pub mod mesh;
pub mod modal;
mod names;
pub mod outcome;
mod presets;
mod rng;
pub mod stress;

pub use asset::Asset;
pub use body::Body;
pub use config::{CrackPath, CrackTiming, DurationModel, FractureConfig};
pub use contact::{Contact, Striker};
pub use error::InputError;
pub use glam;
pub use impact::impact;
pub use material::Material;
pub use mesh::{MassProperties, TetMesh, TriMesh};
pub use names::nearest_name;
pub use outcome::{Fracture, Fragment, ImpactReport, Outcome, StageTimings};
pub use presets::{Preset, UnknownMaterial};
