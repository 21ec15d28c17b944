//! Validation of the physics: cases with known answers, run by `frangible-lab verify` and by the tests.
//!
//! A [`Case`] computes a quantity with the production code and compares it with an independent reference: a closed-form solution, a published
//! number, or our own integrator or Ritz series that shares no code with it. [`CASES`] lists them all. [`experiments`] compares cracks and pieces
//! with published experiments, which takes minutes; [`pieces`] compares methods for the vibration modes of fragments.

mod blows;
mod case;
mod cases;
mod check;
pub mod experiments;
mod models;
pub mod near_field;
mod ode;
pub mod pieces;
mod ritz;

pub use case::{Case, Curve, Findings, case};
pub use cases::CASES;
pub use check::Check;
pub use ritz::{box_frequencies, first_box_frequency};
