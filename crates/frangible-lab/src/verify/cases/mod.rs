//! The cases, one file each.

pub(crate) mod ball;
pub(crate) mod bar;
pub(crate) mod basis;
pub(crate) mod block;
pub(crate) mod blow;
pub(crate) mod cantilever;
pub(crate) mod contact;
pub(crate) mod convergence;
pub(crate) mod near_field;
pub(crate) mod oscillator;
pub(crate) mod plate;
pub(crate) mod scaling;
pub(crate) mod two_bodies;
