//! Real-time, physically based brittle fracture: contacts in, closed fragments with exact masses out.
//!
//! A tour, in the order of the data:
//! - [`Asset`]: what a bake (crate `frangible-bake`) makes of a shape and a [`Material`]: a fine mesh of linear
//!   tetrahedra for cracks, a coarse one of quadratic tetrahedra for the vibration modes, and how they fit together;
//! - [`Breakable`]: an asset made ready, shared by all bodies of a kind; [`Body`]: one of them, with its own seed and
//!   weak points;
//! - [`Contact`]: where, how hard and by what a body is hit, as a rigid-body engine knows it;
//! - [`impact()`]: the pipeline, after Glondu, Marchal, Dumont, *Real-Time Simulation of Brittle Fracture Using Modal
//!   Analysis*, IEEE TVCG 2012, cited as `[G12]`;
//! - [`Outcome`]: held, or broken into [`Fragment`]s, with an [`ImpactReport`].
//!
//! [`FractureConfig`] holds the switches; its default goes beyond the paper, [`FractureConfig::as_in_the_paper`] does not.
//! Everything is in SI units and in the body frame (origin at the centre of mass). The same input gives the same bits.

pub mod asset;
pub mod blow;
pub mod body;
pub mod config;
pub mod contact;
mod crack;
mod cracking;
pub mod error;
pub mod fields;
mod fragment;
pub mod impact;
pub mod loads;
pub mod material;
pub mod mesh;
pub mod modal;
pub mod near_field;
mod onset;
pub mod outcome;
pub mod piece;
mod presets;
mod rng;
pub mod state;
pub mod stress;
mod trace;
mod weak_clusters;
mod weak_rows;

pub use asset::{Asset, AssetFileError};
pub use body::{Body, Breakable};
pub use config::{CrackPath, CrackTiming, DurationModel, FractureConfig};
pub use contact::{Contact, Striker};
pub use crack::CrackFront;
pub use error::InputError;
pub use fields::{Channel, Factors, Fields, Paint, Patch, Zone};
#[doc(hidden)]
pub use fragment::{CutEdge, interfaces_of_labels, pieces_of_cuts};
pub use glam;
pub use impact::{Stage, Vibration, impact, impact_traced, is_harmless, would_break};
pub use loads::{Blast, Force, blast, follow, fracture_at, rest, rest_margin_at_least};
pub use material::Material;
pub use mesh::{MassProperties, RenderMesh, TetMesh, TriMesh, box_projection};
pub use onset::{Onset, OnsetSearch};
pub use outcome::{Fracture, Fragment, ImpactReport, LookedAt, Outcome, StageTimings};
pub use piece::{Elastic, PieceModel, Portion};
pub use presets::{Preset, RateLaw, UnknownMaterial};
pub use state::BodyState;
pub use trace::{CrackTrace, ElementTrace};
