//! Measures of the cracks of the scenes: how many run away from the blow, how many around it, where the first one starts, which parts stay whole. The
//! page docs/real-breaks.md puts them beside descriptions of real breaks.
//!
//! The blow is that of a scene's first break, computed once; only the seed of the weak points changes.

mod broken;
mod features;
mod subjects;

use frangible::internals::impact_traced;
use frangible::{Outcome, impact};
use serde_json::{Value, json};

use self::broken::Broken;
use self::features::common;
use self::subjects::{Struck, Subject};
use crate::{Progress, Result};

/// Bodies of each subject, which differ in their weak points, unless told otherwise.
pub const SEEDS: u64 = 10;

/// Breaks every subject with `seeds` seeds, and counts.
///
/// # Errors
/// An error of the bake or of the impact.
pub fn compute(seeds: u64, hear: Progress<'_>) -> Result<Value> {
    let subjects = subjects::all()?;
    let count = subjects.len() as f64;
    let subjects = subjects.iter().enumerate().map(|(i, subject)| {
        hear(i as f64 / count);
        measure(subject, seeds)
    });
    let subjects: Vec<Value> = subjects.collect::<Result<_>>()?;
    let slowest = json!({
        "bottle_m_s": slowest_of(&subjects::bottle_and_heavy_ball()?, seeds)?,
        "glass_m_s": slowest_of(&subjects::falling_glass()?, seeds)?,
    });
    Ok(json!({ "seeds": seeds, "subjects": subjects, "slowest": slowest }))
}

/// Breaks a subject with every seed. The numbers are in the features' own units.
fn measure(subject: &Subject, seeds: u64) -> Result<Value> {
    let mut broken = Vec::new();
    for seed in 1..=seeds {
        let body = subject.kind.body(seed);
        let (outcome, trace) = impact_traced(&body, &subject.contacts, &subject.config)?;
        broken.extend(Broken::of(subject, outcome, &trace));
    }
    let common = common();
    let rows = common.iter().chain(&subject.features).map(|feature| {
        let scale = match feature.unit {
            "%" => 100.0,
            "mm" => 1e3,
            "µs" => 1e6,
            "kN" => 1e-3,
            _ => 1.0,
        };
        let found = broken
            .iter()
            .filter_map(&feature.reading)
            .map(|x| scale * x);
        let found: Vec<f64> = found.collect();
        let mean = (!found.is_empty()).then(|| found.iter().sum::<f64>() / found.len() as f64);
        json!({
            "feature": feature.name,
            "unit": feature.unit,
            "mean": mean,
            "least": found.iter().copied().reduce(f64::min),
            "most": found.iter().copied().reduce(f64::max),
        })
    });
    let rows: Vec<Value> = rows.collect();
    Ok(json!({ "title": subject.title, "broke": broken.len(), "features": rows }))
}

/// The slowest speeds that break the first body, half of them and the last, m/s.
fn slowest_of(struck: &Struck, seeds: u64) -> Result<[f64; 3]> {
    let mut found = Vec::new();
    for seed in 1..=seeds {
        let body = struck.kind.body(seed);
        let breaks = |speed: f64| -> Result<bool> {
            let hit = struck.at(speed);
            let outcome = impact(&body, std::slice::from_ref(&hit), &struck.config)?;
            Ok(matches!(outcome, Outcome::Broke(_)))
        };
        let mut speed = subjects::SLOWEST;
        while !breaks(speed)? {
            speed *= 1.05;
        }
        found.push(speed);
    }
    found.sort_by(f64::total_cmp);
    Ok([
        found[0],
        found[(found.len() - 1) / 2],
        found[found.len() - 1],
    ])
}
