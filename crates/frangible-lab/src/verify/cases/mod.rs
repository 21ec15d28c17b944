//! Cases with known answers, one file each.

mod ball;
mod bar;
mod basis;
mod block;
pub(crate) mod blow;
mod cantilever;
mod contact;
mod convergence;
pub(crate) mod near_field;
mod oscillator;
mod plate;
mod scaling;
mod two_bodies;

use crate::verify::case::Case;

/// All cases, in the order of the report.
pub const CASES: [Case; 13] = [
    Case::new("bar", "Free bar", bar::compute),
    Case::new("plate", "Free square plate", plate::compute),
    Case::new("block", "Free block", block::compute),
    Case::new("ball", "Solid ball", ball::compute),
    Case::new("cantilever", "Cantilever", cantilever::compute),
    Case::new(
        "convergence",
        "Convergence: linear against quadratic elements",
        convergence::compute,
    ),
    Case::new("basis", "Modal basis", basis::compute),
    Case::new("scaling", "Scaling laws", scaling::compute),
    Case::new(
        "oscillator",
        "One mode under a half-sine",
        oscillator::compute,
    ),
    Case::new("contact", "Contact", contact::compute),
    Case::new("near-field", "Near field of a blow", near_field::compute),
    Case::new("blow", "A blow, integrated", blow::compute),
    Case::new(
        "two-bodies",
        "Two bodies that both vibrate",
        two_bodies::compute,
    ),
];
