//! Cracks: where they start, how they run, when they stop `[G12 §4.4, §5]`.
//!
//! Cracks start between the steps, where the stress, linear from step to step, passes the strength; so their number does not
//! hang on the step. A crack through a wall opens from one face and follows the tension of that face, since arms that turned to
//! whichever face has the larger tension curled into petals; what feeds it is the mean energy through the wall.
//!
//! What has released a point releases it for good, so a point looks at each place of a crack once, and only when what it remembers does not
//! hold it; blocks of places farther than one it knows it passes over. Sites still to come stand in queues, the last first.
//!
//! The fronts of old cracks follow Griffith: a crack of centimetres is fed from a layer of 2πa, where a is its area over the
//! length of its front. Cracks that a piece's own modes know release nothing more.

mod arrivals;
mod branching;
mod culling;
mod field;
mod initiation;
mod node_values;
mod parts;
mod propagation;
mod release;
mod shown;
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
pub use shown::ShownStress;
pub(crate) use surface::crossing_polygon;
pub(crate) use suspects::Suspects;
pub(crate) use system::{Crack, CrackSystem, ElementCut, Junction, front_limit};
pub use tip::CrackFront;
pub(crate) use tip::{Tip, fronts, tips};
