//! Steps in which bodies break.
//!
//! A physics engine resolves contacts as if both bodies were unbreakable, and the impulses that determine whether one of them breaks are known
//! only after the step. There are two solutions. A break *inside* the step undoes the step and repeats it with fragments in place of the
//! body, which is accurate in every detail but requires a copy of the world. A break *after* the step keeps the step and replaces the body
//! then, which needs no copy and can be postponed.
//!
//! - `step.rs`: the front door, and the work around either way;
//! - `inside`, `after`: the two ways;
//! - `advance.rs`: the step of Rapier that both take;
//! - `approach.rs`: bodies that may be hit in the coming step;
//! - `judge.rs`: blows and loads put to the fracture, `answer.rs`: its answers, and what follows for a body;
//! - `ask.rs`: questions about blows that have not happened.

mod advance;
pub(crate) mod after;
mod answer;
pub(crate) mod approach;
mod ask;
mod inside;
pub(crate) mod judge;
mod step;
