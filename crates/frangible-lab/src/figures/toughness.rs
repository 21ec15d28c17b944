//! Figs. 7 and 12: the slab at three toughnesses, and with several dampings.

use std::sync::Arc;

use frangible::internals::impact_traced;
use frangible::{Asset, Breakable, Contact, FractureConfig, Material};
use serde_json::{Value, json};

use super::bodies::{SLAB, changed, slab, slab_blow};
use super::statistics::{mean_damage, models};
use crate::Result;
use crate::verify::experiments::CrackPattern;

/// Fracture energies G_c, J/m², as in the paper.
const TOUGHNESS: [f64; 3] = [150.0, 90.0, 60.0];
/// Stiffness damping α, s: the paper's two values, and a further one.
const DAMPING: [f64; 3] = [0.0, 1e-6, 1e-5];

pub(super) fn toughness() -> Result<Value> {
    series("toughness_j_m2", TOUGHNESS, true, |m, g| {
        m.fracture_energy = g;
    })
}

pub(super) fn damping() -> Result<Value> {
    series("alpha_s", DAMPING, false, |m, alpha| {
        m.stiffness_damping = alpha;
    })
}

/// The slab with several values of a number of its material, in the paper's model and in ours; with the lines of its cracks if they are drawn.
fn series(
    key: &str,
    values: [f64; 3],
    drawn: bool,
    change: fn(&mut Material, f64),
) -> Result<Value> {
    let slab = slab()?;
    let contact = [slab_blow(&slab)?];
    let mut rows = Vec::new();
    for (model, config) in models() {
        for value in values {
            let slab = changed(&slab, |material| change(material, value));
            let mut row = json!({
                "model": model,
                "damage": mean_damage(&slab, &contact, &config)?,
                "undamped_modes": undamped(&slab),
            });
            row[key] = json!(value);
            if drawn {
                row["lines_mm"] = json!(lines(&slab, &contact, &config)?);
            }
            rows.push(row);
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

/// Cracks just below the upper face, seed 1: both ends of each line, mm.
fn lines(
    slab: &Arc<Asset>,
    contacts: &[Contact],
    config: &FractureConfig,
) -> Result<Vec<[f64; 4]>> {
    let body = Breakable::uniform(Arc::clone(slab))?.body(1);
    let (_, trace) = impact_traced(&body, contacts, config)?;
    let pattern = CrackPattern::of(slab, &trace, 0.49 * SLAB[2]);
    Ok(pattern.millimetres())
}
