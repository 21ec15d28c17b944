//! Steps in which bodies break.
//!
//! An engine decides in a step how two bodies part, and takes both for unbreakable. Whether one of them broke is known only after it, from
//! the impulses it found. There are two ways out. A break *inside* the step undoes it and takes it again with fragments in the body's
//! place, which is right in every detail and costs a copy of the world. A break *after* the step leaves it as it is and exchanges the body
//! then, which needs no copy and can wait for its turn.
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
