//! One impact, broken by several methods, so that they can be held side by side `[G12 §7.3.4]`.
//!
//! [`compare`] takes a body, its contacts and the configuration of its fracture, and gives the [pieces](Broken) of each
//! [`Method`]:
//!
//! | method | where the stress comes from | where the body parts |
//! |---|---|---|
//! | [`Method::Ours`] | the vibration, step by step | implicit surfaces that follow it |
//! | [`Method::QuasiStatic`] | a steady state: the impulse as a force over a stated time | the same |
//! | [`Method::Elements`] | the vibration at its worst moment | faces of the fracture mesh |
//! | [`Method::EnergyVoronoi`] | the vibration at its most strained moment | Voronoi cells, drawn by strain energy, apart where that pays |
//! | [`Method::Voronoi`] | nowhere | Voronoi cells, densest around the impact |
//!
//! Each method's module describes the method, its source, and its simplifications. The pieces of all of them tile the body, and the same input and
//! seed give the same bits.

mod compare;
mod divide;
mod draws;
mod elements;
mod energy_voronoi;
mod error;
mod face_pieces;
mod hit;
mod method;
mod moment;
mod plane_crack;
mod quasi_static;
mod result;
mod voronoi;

pub use compare::{Options, compare};
pub use divide::{Border, Division};
pub use energy_voronoi::DEFAULT_SITES;
pub use error::CompareError;
pub use hit::Hit;
pub use method::Method;
pub use quasi_static::DEFAULT_STEP;
pub use result::Broken;
