//! Loads other than blows: resting loads, blasts, scripted blows.

pub(crate) mod pushes;
pub(crate) mod resting;
