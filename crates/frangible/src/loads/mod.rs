//! Loads other than impacts from a rigid-body engine: resting contacts, blasts, scripted blows and prescribed modal motions. All
//! but the resting contacts `[G12 §7.3.3]` are extensions of the paper.

mod blast;
mod clock;
mod motion;
mod rest;
mod scripted;

pub use blast::{Blast, blast};
pub use clock::LoadClock;
pub use motion::{follow, follow_traced};
pub use rest::{Force, rest};
pub use scripted::fracture_at;
