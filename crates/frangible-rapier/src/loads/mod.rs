//! Loads other than blows: what bodies carry, blasts, scripts.

pub(crate) mod pushes;
pub(crate) mod resting;
