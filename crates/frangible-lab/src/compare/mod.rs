//! Comparison of several fracture methods on the same impact `[G12 §7.3.4]`.
//!
//! [`compare`] takes a body, its contacts and the fracture settings, and returns the [pieces](Broken) for each [`Method`]:
//!
//! | method | source of the stress | fracture surfaces |
//! |---|---|---|
//! | [`Method::Ours`] | vibration, step by step | implicit surfaces steered by the stress |
//! | [`Method::QuasiStatic`] | static state under the impulse as a force over a given time | the same |
//! | [`Method::Elements`] | vibration at the moment of the largest stress | faces of the fracture mesh |
//! | [`Method::EnergyVoronoi`] | vibration at the moment of the largest strain energy | Voronoi cells sampled by strain energy, if the energy suffices |
//! | [`Method::Voronoi`] | none | Voronoi cells, densest around the impact |
//!
//! Each method's module describes the method, its source, and its simplifications. The pieces of all of them tile the body, and the same input and
//! seed give the same bits.

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
mod run;
mod scene;
mod voronoi;

pub use divide::{Border, Division};
pub use energy_voronoi::DEFAULT_SITES;
pub use error::CompareError;
pub use hit::Hit;
pub use method::Method;
pub use quasi_static::DEFAULT_STEP;
pub use result::Broken;
pub use run::{Options, compare};
pub use scene::{SCENES, broken_scene, picture};
