//! Cracks: their start, run and end `[G12 §4.4, §5]`.
//!
//! *Start* (`initiation.rs`). A crack starts where the stress at a weak point passes its strength. Stress is linear from one time step to the
//! next, so the moment lies between the steps, and the number of cracks does not depend on the step.
//!
//! *Run* (`propagation.rs`). Fronts spread over the crack's own surface (`arrival.rs`). A front enters a neighbouring tetrahedron if the crack
//! crosses it, meets nothing there and can pay for it. A crack through a wall opens from one face and follows the tension of that face: cracks that
//! turned to whichever face had the larger tension curled into petals. The mean energy through the wall feeds it. It may leave a second crack behind
//! (`branching.rs`), and passes one that opens from the other face of the wall (`passing.rs`).
//!
//! *Release* (`release.rs`). A crack unloads the material beside it. A weak point looks at the cracks only when one is about to start there that can
//! be paid. Released stress stays released, so the point needs no look if the release that it remembers already keeps it below its strength. It looks
//! at all places of all cracks near by, eight of them side by side. Under a blow whose forces are followed with the body, a piece that is cut off
//! moves on its own, or comes to rest as a whole where it is small (`crate::blow`, `rest.rs`).
//!
//! *Old cracks* (`crate::tips`). The front of a crack from an earlier impact follows Griffith: a crack of centimetres is fed from a layer of depth
//! 2πa, where a is its area over the length of its front. Cracks that a piece's own modes know release nothing more.

mod arrival;
mod branching;
mod calm;
mod cuts;
mod extents;
mod feed;
mod felt;
mod field;
mod initiation;
mod ledger;
mod node_values;
mod passing;
mod propagation;
mod release;
mod rest;
mod shown;
mod single;
mod sites;
mod surface;
mod suspects;
mod system;
mod weak_rows;
mod weak_stress;

pub(crate) use cuts::Known;
pub(crate) use field::StressField;
pub(crate) use initiation::{Peak, crack};
use propagation::{advance, retry};
pub use shown::ShownStress;
pub(crate) use single::{Crack, ElementCut};
pub(crate) use suspects::Suspects;
pub(crate) use system::{CrackSystem, ELSEWHERE, UNCUT};
