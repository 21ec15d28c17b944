//! Displacements, strains and stresses `[G12 §4.4]`.

mod bound;
mod coarse;
mod displacement;
mod frame;
mod lanes;
mod moment;
mod principal;
mod rows;
mod shadow;
mod skin;
mod strain;
mod wall;
mod wide;

pub use bound::StressBounds;
pub(crate) use bound::{MARGIN, quadratic_modulus, tension_bound};
pub(crate) use coarse::Coarse;
pub(crate) use displacement::{BATCH, Lanes, STRIDE, Steps, lane};
pub use displacement::{DisplacementBatch, ShapeWeights};
pub(crate) use frame::{Frame, MOST};
pub(crate) use lanes::StressLanes;
pub(crate) use moment::Moment;
pub(crate) use principal::perpendicular_axes;
pub use principal::{largest_eigenvalue, largest_eigenvalue_bound, principal_axes};
pub(crate) use rows::{RowPoint, Rows, of_shape};
pub(crate) use shadow::{Released, Shadow};
pub use shadow::{STRETCHED, bent, share_beside, share_left};
pub(crate) use skin::Search;
pub use skin::{Flaw, Skin};
pub use strain::{Elasticity, Law, StressState, Symmetric3};
pub use wall::Wall;
pub(crate) use wide::dot;
