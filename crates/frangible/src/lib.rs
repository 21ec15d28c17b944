//! Real-time, physically based brittle fracture: contacts in, closed fragments with exact masses out.
//!
//! The main types, in the order of the data:
//! - [`Asset`]: a shape and a [`Material`], baked by the crate `frangible-bake`: a fine mesh of linear tetrahedra for cracks, a
//!   coarse mesh of quadratic tetrahedra for the vibration modes, and the mapping between them;
//! - [`Breakable`]: a checked and prepared asset, shared by all bodies of a kind; [`Body`]: one such body, with its own seed and
//!   weak points;
//! - [`Contact`]: position, direction, strength and striker of a hit, as reported by a rigid-body engine;
//! - [`impact()`]: the pipeline, after Glondu, Marchal, Dumont, *Real-Time Simulation of Brittle Fracture Using Modal
//!   Analysis*, IEEE TVCG 2012, cited as `[G12]`;
//! - [`Outcome`]: the body held, or broke into [`Fragment`]s, with an [`ImpactReport`].
//!
//! [`FractureConfig`] holds the settings: its default extends the paper's model, [`FractureConfig::as_in_the_paper`] reproduces it.
//! [`internals`] exports everything else. Its names, and members that this documentation does not show, may change in any release.
//! All quantities are in SI units and in the body frame (origin at the centre of mass). The same input gives bit-identical results.

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

#[macro_use]
mod vectors;

mod asset;
mod blow;
mod body;
mod bounds;
mod config;
mod contact;
mod crack;
mod cracking;
mod dice;
mod error;
mod fields;
mod fragment;
mod impact;
pub mod internals;
mod loads;
mod modal;
mod motion;
mod near_field;
mod outcome;
mod piece;
mod refuse;
mod rigid;
mod rng;
mod state;
mod stress;
mod tips;
mod trace;

use frangible_geometry as mesh;
use frangible_material as material;

pub use asset::{Asset, AssetFileError, RescaleError};
pub use body::{Body, Breakable};
pub use config::FractureConfig;
pub use contact::{Contact, ContactReport, Striker};
pub use error::InputError;
pub use fields::{Factors, Fields};
pub use glam;
pub use impact::{impact, would_break};
pub use material::{Fatigue, Material, OutOfRange, Preset, UnknownMaterial};
pub use mesh::{MassProperties, RenderMesh, TriMesh};
pub use outcome::{Fracture, Fragment, ImpactReport, Outcome};
pub use state::BodyState;
