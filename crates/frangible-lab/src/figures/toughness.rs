//! Fig. 7: the slab's cracks at three toughnesses.

use std::sync::Arc;

use frangible::internals::impact_traced;
use frangible::{Asset, Breakable, Contact, FractureConfig};
use serde_json::{Value, json};

use super::bodies::{changed, slab, slab_blow};
use super::slice::surface_trace;
use super::statistics::{mean_damage, models};
use crate::Result;

/// Fracture energies G_c, J/m², as in the paper.
const TOUGHNESS: [f64; 3] = [150.0, 90.0, 60.0];

/// The slab at each toughness, in the paper's model and in ours.
pub(super) fn compute() -> Result<Value> {
    let slab = slab()?;
    let contact = [slab_blow(&slab)?];
    let mut rows = Vec::new();
    for (model, config) in models() {
        for toughness in TOUGHNESS {
            let slab = changed(&slab, |m| m.fracture_energy = toughness);
            rows.push(json!({
                "model": model,
                "toughness_j_m2": toughness,
                "damage": mean_damage(&slab, &contact, &config)?,
                "lines_mm": lines(&slab, &contact, &config)?,
            }));
        }
    }
    Ok(rows.into())
}

/// Traces of the cracks on the upper face, seed 1: both ends of each, mm.
pub(super) fn lines(
    slab: &Arc<Asset>,
    contacts: &[Contact],
    config: &FractureConfig,
) -> Result<Vec<[f32; 4]>> {
    let body = Breakable::uniform(Arc::clone(slab))?.body(1);
    let (_, trace) = impact_traced(&body, contacts, config)?;
    let elements = trace.cracks.iter().flatten();
    let lines = elements.flat_map(|element| surface_trace(slab.fracture(), element));
    let above = lines.filter(|[a, b]| a.z > 0.0 && b.z > 0.0);
    let ends = above.map(|[a, b]| [a.x, a.y, b.x, b.y].map(|x| (1e4 * x).round() / 10.0));
    Ok(ends.collect())
}
