//! Does a mode solve the eigenvalue problem? Checked for every mode that is given out.

use crate::eigen::Modes;
use crate::eigen::reduce::Reduction;
use crate::error::BakeError;
use crate::fem::{Mass, System};

/// What every mode must reach, where f64 rounding allows it.
const LIMIT: f64 = 1e-8;

/// Relative residual ‖Kφ − λMφ‖ / ‖Kφ‖ of one mode, and the limit it must meet: 1e-8, or ten times
/// the rounding of Kφ itself where that is more (on a thin plate it is 5e-8).
#[must_use]
pub fn residual(system: &System, eigenvalue: f64, shape: &[f64]) -> (f64, f64) {
    residual_of(system, None, eigenvalue, shape)
}

/// The same over the unknowns that are left: what holds the others bears their forces.
fn residual_of(
    system: &System,
    reduction: Option<&Reduction>,
    eigenvalue: f64,
    shape: &[f64],
) -> (f64, f64) {
    let left = |i: usize| reduction.is_none_or(|r| r.is_free(i));
    let norm = |v: &[f64]| {
        let entries = v.iter().enumerate().filter(|(i, _)| left(*i));
        entries.map(|(_, x)| x * x).sum::<f64>().sqrt()
    };
    let k = system.multiply(shape);
    let rest: Vec<f64> = match &system.mass {
        Mass::Lumped(mass) => (0..k.len())
            .map(|i| k[i] - eigenvalue * mass[i / 3] * shape[i])
            .collect(),
        Mass::Consistent(_) => {
            let inertia = system.mass.multiply(shape);
            (0..k.len())
                .map(|i| k[i] - eigenvalue * inertia[i])
                .collect()
        }
    };
    let relative = norm(&rest) / norm(&k);
    let limit = if relative <= LIMIT {
        LIMIT
    } else {
        (10.0 * f64::EPSILON * norm(&system.multiply_magnitudes(shape)) / norm(&k)).max(LIMIT)
    };
    (relative, limit)
}

/// Largest relative residual, or the first mode above its limit.
pub(crate) fn check(
    system: &System,
    reduction: Option<&Reduction>,
    modes: &Modes,
) -> Result<f64, BakeError> {
    let mut largest = 0.0_f64;
    for (mode, &eigenvalue) in modes.eigenvalues.iter().enumerate() {
        let (residual, limit) = residual_of(system, reduction, eigenvalue, modes.shape(mode));
        if residual.is_nan() || residual > limit {
            return Err(BakeError::Residual {
                mode,
                residual,
                limit,
            });
        }
        largest = largest.max(residual);
    }
    Ok(largest)
}
