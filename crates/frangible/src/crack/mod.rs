//! Cracks: where they start, how they run, when they stop `[G12 §4.4, §5]`.

mod culling;
mod field;
mod initiation;
mod propagation;
mod release;
mod surface;
mod system;

pub(crate) use culling::Culling;
pub(crate) use field::StressField;
pub(crate) use initiation::{Peak, start_cracks};
pub(crate) use propagation::advance;
pub(crate) use surface::crossing_polygon;
pub(crate) use system::front_limit;
pub(crate) use system::{Crack, CrackSystem, ElementCut, Junction};
