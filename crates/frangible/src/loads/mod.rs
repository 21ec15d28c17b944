//! Loads that are no impact of a rigid-body engine: resting contacts, blasts, scripted blows, motions (beyond the paper,
//! but for the resting contacts it names `[G12 §7.3.3]`).

mod blast;
mod motion;
mod rest;
mod scripted;

pub use blast::{Blast, blast};
pub use motion::{follow, follow_traced};
pub use rest::{Force, rest};
pub use scripted::fracture_at;
