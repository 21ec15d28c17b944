//! The numbers behind the figures of `[G12]`, Glondu, Marchal, Dumont, *Real-Time Simulation of Brittle Fracture Using Modal Analysis*, IEEE
//! TVCG 2012.
//!
//! Each figure is computed anew in the paper's model and in ours. `docs/figures.md` compares the numbers with what the paper says of its figures.
//! Figs. 6, 9 and 10 show steps of the algorithms, which [`reference`](mod@crate::reference) has word for word.

mod bodies;
mod chocolate;
mod rod;
mod scenes;
mod statistics;
mod stiffness;
mod toughness;
mod wave;

use serde_json::{Map, Value};

use crate::{Progress, Result};

/// Computation of a figure's numbers.
type Compute = fn() -> Result<Value>;

/// Names of the figures, in the order of the paper, and their computations.
const FIGURES: [(&str, Compute); 7] = [
    ("fig1", scenes::compute),
    ("fig3", rod::compute),
    ("fig4", stiffness::compute),
    ("fig5", wave::compute),
    ("fig7", toughness::toughness),
    ("fig12", toughness::damping),
    ("fig13", chocolate::compute),
];

/// Computes the figures of these names, all without one.
///
/// # Errors
/// A name that no figure has, with those that there are; an error of the bake or of an impact.
pub fn compute(names: &[String], hear: Progress<'_>) -> Result<Value> {
    let known = FIGURES.map(|f| f.0);
    if let Some(name) = names.iter().find(|name| !known.contains(&name.as_str())) {
        return Err(format!("there is no figure `{name}`; figures: {}", known.join(", ")).into());
    }
    let wanted = |name: &str| names.is_empty() || names.iter().any(|n| n == name);
    let mut all = Map::new();
    for (i, (name, compute)) in FIGURES.into_iter().enumerate() {
        hear(i as f64 / FIGURES.len() as f64);
        if wanted(name) {
            all.insert(name.into(), compute()?);
        }
    }
    Ok(all.into())
}
