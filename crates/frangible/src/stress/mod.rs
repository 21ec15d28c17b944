//! Displacements, strains and stresses `[G12 §4.4]`.
//!
//! Sixteen steps are computed side by side, written once for one step and for sixteen. `pulp` picks the widest vectors at run time,
//! and no operation is fused, so the bits are those of plain code. (It does so for structs; a closure is compiled for the plain processor.)
//!
//! Weak points have rows of their own (`rows.rs`): where strain is linear, displacement, gradient, law and wall are one matrix, three rows beside
//! a free surface, made when a cluster is first looked at and read from end to end. Few of the points that a blow makes one look
//! at come near their strength, so a few shapes of the rows (`coarse.rs`) and a bound of what they leave out come first; a point in doubt
//! gets all its modes, so the bits are the same.
//!
//! Strain is linear, as the modes are: the quadratic terms take a turn of 0.03 for a stretch of 5e-4, which is glass's strength.
//! Flaws lie on the surface, where no traction acts, and thin walls are in plane stress; at the centres of a plate of one layer
//! bending shows half of the skin's stress or less. What a crack releases follows from its length, by the closed forms of a
//! crack in a stretched and in a bent wall.

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
mod tensor;
mod wall;
mod wide;

pub(crate) use coarse::Coarse;
pub use displacement::DisplacementBatch;
pub(crate) use displacement::{BATCH, Lanes, STRIDE, Steps, lane};
pub(crate) use frame::{Frame, MOST};
pub(crate) use lanes::StressLanes;
pub(crate) use moment::Moment;
pub(crate) use principal::{MARGIN, limit, perpendicular_axes};
pub use principal::{largest_eigenvalue, largest_eigenvalue_bound, principal_axes};
pub(crate) use rows::{RowPoint, Rows, of_shape};
pub(crate) use shadow::{Released, Shadow};
pub use shadow::{STRETCHED, bent, share_beside, share_left};
pub(crate) use skin::Search;
pub use skin::{Flaw, Skin};
pub use strain::{Elasticity, Law, StressState};
pub use tensor::Symmetric3;
pub use wall::Wall;
pub(crate) use wide::dot;
