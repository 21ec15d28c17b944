//! One file per figure.

pub(crate) mod chocolate;
mod coarse;
pub(crate) mod damping;
pub(crate) mod labels;
pub(crate) mod propagation;
pub(crate) mod rod;
pub(crate) mod scenes;
pub(crate) mod stiffness;
pub(crate) mod surface;
pub(crate) mod toughness;
pub(crate) mod wave;
