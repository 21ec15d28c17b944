//! Displacements, strains and stresses `[G12 §4.4]`.
//!
//! The modal amplitudes give the displacements of the analysis nodes, these the displacement gradient at a point, and a constitutive law the
//! stress. The law depends on the position: flaws lie on the surface, which is free of traction, and thin walls are in plane stress (`skin.rs`,
//! `wall.rs`). In a plate with one layer of tetrahedra, the bending stress at their centres would be at most half of the surface stress.
//!
//! Strain is linear, like the modes. With the quadratic terms, a rotation by 0.03 would count as a strain of 5e-4, at which glass breaks.
//!
//! Three optimizations do not change any bit of the result:
//! - Sixteen time steps are computed at once. The code is written once for one step and for sixteen (`tensor.rs`); `pulp` picks the
//!   widest vectors of the processor at run time, and no operation is fused. (It does so for structs: a closure would be compiled for
//!   the plain processor.)
//! - Weak points have precomputed rows (`rows.rs`). Since strain is linear, displacement, gradient, constitutive law and wall combine into one
//!   matrix, which has three rows at a free surface. The rows of a cluster are computed on first use and read sequentially.
//! - Few of the evaluated points come near their strength. A few shapes (`coarse.rs`) are therefore evaluated first in place of all modes, with a
//!   bound of the remainder, and all modes only for points that this does not decide.
//!
//! The release beside a crack follows from its length (`shadow.rs`), by the closed forms of a crack in a solid, in a stretched wall and in a bent one.

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
pub(crate) use rows::{NO_TET, RowPoint, Rows, Sample, SampleStress, of_shape};
pub(crate) use shadow::{Released, Shadow};
pub use shadow::{STRETCHED, bent, share_beside, share_in_solid, share_left};
pub(crate) use shape::Shape;
pub(crate) use sizes::Sizes;
pub(crate) use skin::Search;
pub use skin::{Flaw, Skin};
pub use strain::{Elasticity, Law, StressState};
pub use tensor::Symmetric3;
pub use wall::Wall;
pub(crate) use wide::{Wide, dot, length};
