//! Real-time, physically based brittle fracture: contacts in, closed fragments with exact masses out.
//!
//! A tour, in the order of the data:
//! - [`Asset`]: what a bake (crate `frangible-bake`) makes of a shape and a [`Material`]: a fine mesh of linear
//!   tetrahedra for cracks, a coarse one of quadratic tetrahedra for the vibration modes, and how they fit together;
//! - [`Breakable`]: an asset that has been checked and prepared, shared by all bodies of a kind; [`Body`]: one of them, with its own
//!   seed and weak points;
//! - [`Contact`]: where, how hard and by what a body is hit, as a rigid-body engine knows it;
//! - [`impact()`]: the pipeline, after Glondu, Marchal, Dumont, *Real-Time Simulation of Brittle Fracture Using Modal
//!   Analysis*, IEEE TVCG 2012, cited as `[G12]`;
//! - [`Outcome`]: held, or broken into [`Fragment`]s, with an [`ImpactReport`].
//!
//! [`FractureConfig`] holds the switches; its default goes beyond the paper, [`FractureConfig::as_in_the_paper`] does not.
//! [`internals`] has the rest; its names may change in any release.
//! Everything is in SI units and in the body frame (origin at the centre of mass). The same input gives the same bits.

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

mod asset;
mod blow;
mod body;
mod bounds;
mod config;
mod contact;
mod crack;
mod cracking;
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

pub use asset::Asset;
pub use body::{Body, Breakable};
pub use config::FractureConfig;
pub use contact::{Contact, Striker};
pub use error::InputError;
pub use glam;
pub use impact::{impact, would_break};
pub use material::Material;
pub use mesh::TriMesh;
pub use outcome::{Fracture, Fragment, ImpactReport, Outcome};
