//! Upper bounds of the stress that reject harmless contacts early (an extension of the paper).
//!
//! Nearly all contacts in a game are harmless. Each bound is at least the stress that it bounds, including rounding, so a rejected contact
//! would not have caused a crack, and the outcome of fracture is bit-identical without the bounds.
//!
//! The physics modules do not depend on the bounds, except for the two entry points ([`impact()`](crate::impact()) and
//! [`rest`](crate::internals::rest)), which evaluate them first, and the loop over time steps, which uses them to skip work ([`Culling`]).
//! The module `bounds` computes the required data once per kind of body.

mod cluster_bounds;
mod culling;
mod impact;
mod per_newton;
mod pushes;

pub(crate) use culling::Culling;
pub(crate) use impact::refused;
pub use per_newton::rest_margin_at_least;

pub(crate) use pushes::Pushes;

use crate::body::Body;
use crate::config::FractureConfig;
use crate::contact::Contact;
use crate::stress::limit;
use crate::tips::front_limit;

/// Returns true if a bound that takes microseconds shows that an impact has no effect on a body; [`impact()`](crate::impact()) calls it first.
/// A result of false is inconclusive.
#[must_use]
pub fn is_harmless(body: &Body, contacts: &[Contact], config: &FractureConfig) -> bool {
    config.culling
        && config.validate().is_ok()
        && contacts.iter().all(|c| c.validate().is_ok())
        && refused(body, contacts, config).is_some()
}

/// Stress bound below which nothing happens to a body, Pa: no crack starts, and none of its old ones moves.
///
/// `left`: share of the weakest point's strength that is left.
pub(crate) fn harmless(body: &Body, left: f64) -> f32 {
    let strength = limit((body.resistance.weakest * left) as f32);
    if body.state().is_intact() {
        strength
    } else {
        let (material, least) = (&body.asset.material, body.resistance.toughness.least);
        strength.min(front_limit(material, least, &body.tips))
    }
}
