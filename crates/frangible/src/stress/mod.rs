//! Displacements, strains and stresses `[G12 §4.4]`.
//!
//! The modes' amplitudes give the displacements of the analysis nodes, those the gradient at a point, and a law makes stress of it. Which law
//! holds depends on the place: flaws lie on the surface, where no traction acts, and thin walls are in plane stress (`skin.rs`, `wall.rs`).
//! In a plate of one layer of tetrahedra the stress at their centres would be half of the skin's stress in bending, or less.
//!
//! Strain is linear, as the modes are. With the quadratic terms a turn of 0.03 would count as a stretch of 5e-4, at which glass breaks.
//!
//! Three things make it fast, and change no bit:
//! - Sixteen time steps are computed side by side. The code is written once for one step and for sixteen (`tensor.rs`); `pulp` picks the
//!   widest vectors of the processor at run time, and no operation is fused. (It does so for structs: a closure would be compiled for
//!   the plain processor.)
//! - Weak points have rows of their own (`rows.rs`). Where strain is linear, displacement, gradient, law and wall are one matrix, which has
//!   three rows beside a free surface. The rows of a cluster are made when it is first looked at, and read from end to end.
//! - Few of the points that have to be looked at come near their strength. So a few shapes in place of all modes (`coarse.rs`) come first, with
//!   a bound of what they leave out, and only a point in doubt gets all its modes.
//!
//! The release beside a crack follows from its length (`shadow.rs`), by the closed forms of a crack in a stretched and in a bent wall.

mod batch;
mod cluster_rows;
mod coarse;
mod frame;
mod lanes;
mod place;
mod principal;
mod rows;
mod shadow;
mod shape;
mod sizes;
mod skin;
mod strain;
mod tensor;
mod wall;
mod wide;

pub(crate) use batch::{BATCH, Lanes, STRIDE, Steps, lane};
pub(crate) use cluster_rows::{ClusterRows, LawRows, OppositeRows, WeakRows};
pub(crate) use coarse::Coarse;
pub(crate) use frame::{Frame, MOST};
pub(crate) use lanes::StressLanes;
pub(crate) use place::{Places, WeakPlace, wall_of, weak_place};
pub(crate) use principal::{MARGIN, limit, perpendicular_axes};
pub use principal::{largest_eigenvalue, largest_eigenvalue_bound, principal_axes};
pub(crate) use rows::{RowPoint, Rows, Sample, of_shape};
pub(crate) use shadow::{Released, Shadow};
pub use shadow::{STRETCHED, bent, share_beside, share_left};
pub(crate) use shape::Shape;
pub(crate) use sizes::Sizes;
pub(crate) use skin::Search;
pub use skin::{Flaw, Skin};
pub use strain::{Elasticity, Law, StressState};
pub use tensor::Symmetric3;
pub use wall::Wall;
pub(crate) use wide::{Wide, dot, length};
