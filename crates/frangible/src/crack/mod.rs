//! Cracks: initiation, propagation and arrest `[G12 §4.4, §5]`.
//!
//! *Initiation* (`initiation.rs`). A crack starts where the stress at a weak point exceeds its strength. Stress is interpolated linearly between
//! time steps, so cracks start between steps, and their number does not depend on the step length.
//!
//! *Propagation* (`propagation.rs`). Fronts spread over the crack's own surface (`arrival.rs`). A front enters a neighbouring tetrahedron if the
//! crack surface crosses it, there is no obstacle, and the available energy suffices. A crack through a wall opens from one face and follows the
//! tension of that face; if it followed the face with the larger tension, it would curl into petals. It is driven by the mean energy through the
//! wall. It may branch (`branching.rs`), and may cross a crack that opens from the other face of the wall (`passing.rs`). A front that lacks energy
//! waits and is tried at each step; an upper bound of its tension refuses most tries (`waiting.rs`).
//!
//! *Films* (`film.rs`). A crack in a ply of a laminated wall stops at the film, unless the next ply does not bear what it leaves.
//!
//! *Sections* (`sections.rs`, `section.rs`, `strip.rs`). A crack in a solid that is large against the section it lies in is also driven by the force and
//! the moment of that section, since the stress ahead of it in the unbroken body no longer says what acts on its front.
//!
//! *Release* (`release.rs`). A crack unloads the material beside it. The release at a weak point is evaluated only if a crack is about to start
//! there with sufficient energy. Released stress stays released, so no evaluation is needed if the stored release already keeps the stress below
//! the strength. All positions on all nearby cracks are evaluated, eight at a time. In an integrated blow, a separated piece moves independently,
//! or comes to rest as a whole if it is small (`crate::blow`, `rest.rs`).
//!
//! *Marks* (`marks.rs`). In glass each cut keeps where the mirror of its crack ends.
//!
//! *Existing cracks* (`crate::tips`). The front of a crack from an earlier impact follows Griffith's criterion: the energy of a crack of
//! centimetres comes from a layer of depth 2πa, where a is its area divided by the length of its front. Cracks that are included in a piece's own
//! modes release no further stress.

mod arrival;
mod branching;
mod cuts;
mod extents;
mod feed;
mod felt;
mod field;
mod film;
mod initiation;
mod ledger;
mod marks;
mod node_values;
mod passing;
mod propagation;
mod release;
mod rest;
mod section;
mod sections;
mod shown;
mod single;
mod sites;
mod squares;
mod strip;
mod surface;
mod suspects;
mod system;
mod waiting;
mod weak_rows;
mod weak_stress;

pub(crate) use cuts::Known;
pub(crate) use field::StressField;
pub(crate) use initiation::{Peak, crack};
pub use marks::CrackMark;
use propagation::{advance, retry};
pub use shown::ShownStress;
pub(crate) use single::{Crack, ElementCut};
pub(crate) use suspects::Suspects;
pub(crate) use system::{CrackSystem, ELSEWHERE, UNCUT};
