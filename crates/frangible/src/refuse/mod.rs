//! Bounds that refuse what does nothing, before it is computed (beyond the paper).
//!
//! Nearly all contacts of a game are harmless. Each bound here is never below the stress that it stands for, rounding included, so what
//! is refused would have cracked nothing, and what breaks is the same bit for bit without the bounds.
//!
//! They come after the physics: nothing of how bodies vibrate and crack knows them, but for the two front doors
//! ([`impact()`](crate::impact()) and [`rest`](crate::internals::rest)), which ask them first, and the loop over time steps, which asks
//! them what to pass over ([`Culling`]). What they need of a body is found once for its kind, by the module `bounds`.

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

/// Returns true if a bound that costs microseconds shows that an impact does nothing to a body; [`impact()`](crate::impact()) asks it first.
/// False says nothing.
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
