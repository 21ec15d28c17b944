//! Means that keep a world quiet: sleep, rolling resistance, and no body through a floor.

pub(crate) mod guard;
pub(crate) mod motions;
pub(crate) mod rest;
pub(crate) mod rolling;
