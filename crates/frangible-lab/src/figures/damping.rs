//! Fig. 12: damping of high frequencies and the number of fragments.

use frangible::Asset;
use serde_json::{Value, json};

use super::bodies::{changed, slab, slab_blow};
use super::statistics::{mean_damage, models};
use super::toughness::lines;
use crate::Result;

/// Stiffness damping α, s: the paper's two values, and a further one.
const DAMPING: [f64; 3] = [0.0, 1e-6, 1e-5];

/// The slab at each damping, in the paper's model and in ours.
pub(super) fn compute() -> Result<Value> {
    let slab = slab()?;
    let contact = [slab_blow(&slab)?];
    let mut rows = Vec::new();
    for (model, config) in models() {
        for alpha in DAMPING {
            let plate = changed(&slab, |material| material.stiffness_damping = alpha);
            rows.push(json!({
                "model": model,
                "alpha_s": alpha,
                "undamped_modes": undamped(&plate),
                "damage": mean_damage(&plate, &contact, &config)?,
                "lines_mm": lines(&plate, &contact, &config)?,
            }));
        }
    }
    Ok(rows.into())
}

/// Number of modes below critical damping.
fn undamped(plate: &Asset) -> usize {
    let modes = plate.modes();
    let swings =
        |i: &usize| modes.damping(*i, plate.material()) < 2.0 * modes.eigenvalues[*i].sqrt();
    (0..modes.count()).filter(swings).count()
}
