//! Means over seeds.

use std::sync::Arc;

use frangible::{Asset, Breakable, Contact, FractureConfig, Outcome, impact};
use rayon::prelude::*;
use serde::Serialize;

use crate::Result;

/// Seeds of every mean.
const SEEDS: u64 = 50;

/// Damage by an impact, or the mean of several.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub(crate) struct Damage {
    /// Crack area, m².
    #[serde(rename = "area_m2")]
    pub(crate) area: f64,
    pub(crate) cracks: f64,
    pub(crate) pieces: f64,
    /// Standard error of the mean of the area, m².
    #[serde(rename = "area_error_m2")]
    pub(crate) area_error: f64,
    /// Standard error of the mean of the pieces.
    pub(crate) pieces_error: f64,
}

/// The paper's model and ours, with their names.
pub(crate) fn models() -> [(&'static str, FractureConfig); 2] {
    [
        ("the paper's model", FractureConfig::as_in_the_paper()),
        ("ours", FractureConfig::default()),
    ]
}

/// Damage of one blow, mean over seeds 1..=[`SEEDS`].
pub(crate) fn mean_damage(
    asset: &Arc<Asset>,
    contacts: &[Contact],
    config: &FractureConfig,
) -> Result<Damage> {
    let kind = Breakable::uniform(Arc::clone(asset))?;
    let all: Vec<Damage> = (1..=SEEDS)
        .into_par_iter()
        .map(|seed| Ok(damage(&impact(&kind.body(seed), contacts, config)?)))
        .collect::<Result<_>>()?;
    let (area, area_error) = mean(all.iter().map(|d| d.area));
    let (pieces, pieces_error) = mean(all.iter().map(|d| d.pieces));
    let (cracks, _) = mean(all.iter().map(|d| d.cracks));
    Ok(Damage {
        area,
        cracks,
        pieces,
        area_error,
        pieces_error,
    })
}

/// Damage by one impact.
pub(crate) fn damage(outcome: &Outcome) -> Damage {
    let report = outcome.report();
    Damage {
        area: report.crack_area,
        cracks: report.cracks as f64,
        pieces: pieces(outcome) as f64,
        ..Damage::default()
    }
}

pub(crate) fn pieces(outcome: &Outcome) -> usize {
    match outcome {
        Outcome::Broke(fracture) => fracture.fragments.len(),
        _ => 1,
    }
}

/// Mean and its standard error.
fn mean(values: impl Iterator<Item = f64> + Clone) -> (f64, f64) {
    let count = values.clone().count().max(2) as f64;
    let mean = values.clone().sum::<f64>() / count;
    let squares: f64 = values.map(|v| (v - mean) * (v - mean)).sum();
    (mean, (squares / (count - 1.0) / count).sqrt())
}
