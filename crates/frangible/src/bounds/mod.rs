//! Stress bounds of a kind of body, computed once (an extension of the paper); the module `refuse` uses them.

mod clusters;
mod per_impulse;
mod reach;
mod stress_bounds;
mod surface_sums;

pub(crate) use clusters::WeakClusters;
pub(crate) use per_impulse::PerImpulse;
pub(crate) use reach::Reaches;
pub(crate) use stress_bounds::{quadratic_modulus, tension_bound, tension_bounds};
pub(crate) use surface_sums::surface_sums;

/// Factor on bounds that covers the rounding of sums over a few thousand terms.
pub(crate) const ROUNDING: f32 = 1.0 + 1e-4;

/// The largest stress, Pa, and gradient per newton of force anywhere on the surface, and per m/s² of gravity.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct PerNewton {
    pub(crate) force: [f32; 2],
    pub(crate) gravity: [f32; 2],
}
