//! Cracks: where they start, how they run, when they stop `[G12 §4.4, §5]`.

mod arrivals;
mod culling;
mod field;
mod initiation;
mod node_values;
mod parts;
mod propagation;
mod release;
mod sites;
mod surface;
mod suspects;
mod system;
mod tip;
mod weak_stress;

pub(crate) use culling::Culling;
pub(crate) use field::{StressField, weak_place};
pub(crate) use initiation::{Peak, crack};
pub(crate) use parts::refused_by_parts;
use propagation::{advance, retry};
pub(crate) use surface::crossing_polygon;
pub(crate) use suspects::Suspects;
pub(crate) use system::{Crack, CrackSystem, ElementCut, Junction, front_limit};
pub use tip::CrackFront;
pub(crate) use tip::{Tip, fronts, tips};
