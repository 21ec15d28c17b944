//! Check that a mode solves the eigenvalue problem, performed for every returned mode.

use faer::sparse::SparseColMat;

use crate::eigen::Modes;
use crate::eigen::panel::{Row, WIDTH, add_multiple, panel_of_columns};
use crate::eigen::reduce::Reduction;
use crate::error::BakeError;
use crate::fem::{Mass, System};

/// Largest relative residual of a mode, where f64 rounding allows it.
const LIMIT: f64 = 1e-8;

/// Returns the relative residual ‖Kφ − λMφ‖ / ‖Kφ‖ of a mode, and its limit: 1e-8, or ten times the
/// rounding error of Kφ if that is larger (on a thin plate it is 5e-8).
#[must_use]
pub fn residual(system: &System, eigenvalue: f64, shape: &[f64]) -> (f64, f64) {
    residual_of(system, None, eigenvalue, shape, LIMIT)
}

/// The residual over the free unknowns: the supports bear the forces on the others.
fn residual_of(
    system: &System,
    reduction: Option<&Reduction>,
    eigenvalue: f64,
    shape: &[f64],
    wanted: f64,
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
    let limit = if relative <= wanted {
        wanted
    } else {
        (10.0 * f64::EPSILON * norm(&system.multiply_magnitudes(shape)) / norm(&k)).max(wanted)
    };
    (relative, limit)
}

/// Largest relative residual, or the first mode above its limit.
pub(crate) fn check(
    system: &System,
    reduction: Option<&Reduction>,
    modes: &Modes,
    wanted: f64,
) -> Result<f64, BakeError> {
    let unknowns = modes.unknowns;
    let mut largest = 0.0_f64;
    for (group, shapes) in modes.shapes.chunks(WIDTH * unknowns).enumerate() {
        let first = group * WIDTH;
        let eigenvalues = &modes.eigenvalues[first..(first + WIDTH).min(modes.eigenvalues.len())];
        let residuals = residuals(system, reduction, eigenvalues, shapes);
        for (i, &eigenvalue) in eigenvalues.iter().enumerate() {
            let mode = first + i;
            let (mut residual, mut limit) = (residuals[i], wanted);
            if residual.is_nan() || residual > wanted {
                // The limit that rounding allows, one mode at a time: rare but on thin plates.
                (residual, limit) =
                    residual_of(system, reduction, eigenvalue, modes.shape(mode), wanted);
            }
            if residual.is_nan() || residual > limit {
                return Err(BakeError::Residual {
                    mode,
                    residual,
                    limit,
                });
            }
            largest = largest.max(residual);
        }
    }
    Ok(largest)
}

/// Relative residuals of up to eight modes.
fn residuals(
    system: &System,
    reduction: Option<&Reduction>,
    eigenvalues: &[f64],
    shapes: &[f64],
) -> Row {
    let x = panel_of_columns(shapes, system.unknowns());
    let mut lambda = [0.0; WIDTH];
    lambda[..eigenvalues.len()].copy_from_slice(eigenvalues);
    let mut k = vec![[0.0; WIDTH]; x.len()];
    let mut inertia = k.clone();
    add_product(&system.stiffness, 1, &x, &mut k);
    match &system.mass {
        Mass::Lumped(mass) => {
            for (i, row) in inertia.iter_mut().enumerate() {
                add_multiple(row, mass[i / 3], &x[i]);
            }
        }
        Mass::Consistent(matrix) => add_product(matrix, 3, &x, &mut inertia),
    }
    let (mut rest, mut whole) = ([0.0; WIDTH], [0.0; WIDTH]);
    for i in (0..x.len()).filter(|&i| reduction.is_none_or(|r| r.is_free(i))) {
        for l in 0..WIDTH {
            rest[l] += (k[i][l] - lambda[l] * inertia[i][l]).powi(2);
            whole[l] += k[i][l] * k[i][l];
        }
    }
    std::array::from_fn(|l| (rest[l] / whole[l]).sqrt())
}

frangible::widest! {
    /// y += (S ⊗ I) x, where the lower triangle of S is given and I has `axes` rows.
    pub(crate) fn add_product(
        lower: &SparseColMat<usize, f64>,
        axes: usize,
        x: &[Row],
        y: &mut [Row],
    ) {
        let (pattern, values) = lower.parts();
        for j in 0..pattern.ncols() {
            let range = pattern.col_range(j);
            for axis in 0..axes {
                let from = x[axes * j + axis];
                let mut sum = [0.0; WIDTH];
                let rows = pattern.row_idx()[range.clone()].iter();
                for (&i, &value) in rows.zip(&values[range.clone()]) {
                    let row = axes * i + axis;
                    add_multiple(&mut sum, value, &x[row]);
                    if i != j {
                        add_multiple(&mut y[row], value, &from);
                    }
                }
                add_multiple(&mut y[axes * j + axis], 1.0, &sum);
            }
        }
    }
}
