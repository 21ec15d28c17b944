//! Scaling of modes with stiffness, density and size: the reason that a baked body needs no new bake for these.

use frangible_bake::eigen::Modes;
use frangible_bake::fem::Elasticity;
use frangible_bake::{BakeError, Shape};

use crate::verify::case::Findings;
use crate::verify::check::{Check, check};
use crate::verify::models::{GLASS, free_modes, norm, quadratic};

/// Modes compared.
const WANTED: usize = 20;

const DIMENSIONS: &str = "dimensional analysis";

pub(super) fn compute() -> Result<Findings, BakeError> {
    let of = |scale: f64, material: &Elasticity| -> Result<Modes, BakeError> {
        let block = Shape::block([0.1 * scale, 0.08 * scale, 0.05 * scale]);
        free_modes(&quadratic(&block, 0.025 * scale, 2, material)?, WANTED)
    };
    let before = of(1.0, &GLASS)?;
    let stiffer = of(
        1.0,
        &Elasticity {
            youngs_modulus: 3.0 * GLASS.youngs_modulus,
            ..GLASS
        },
    )?;
    let denser = of(
        1.0,
        &Elasticity {
            density: 2.0 * GLASS.density,
            ..GLASS
        },
    )?;
    let larger = of(2.0, &GLASS)?;
    let eigenvalue = |modes: &Modes, i: usize| modes.eigenvalues[i] / before.eigenvalues[i];
    let shape = |modes: &Modes, i: usize| norm(modes.shape(i)) / norm(before.shape(i));
    Ok(vec![
        farthest("λ at E × 3", 3.0, 1e-8, |i| eigenvalue(&stiffer, i)),
        farthest("λ at ρ × 2", 0.5, 1e-8, |i| eigenvalue(&denser, i)),
        farthest("φ at ρ × 2", 0.5_f64.sqrt(), 1e-6, |i| shape(&denser, i)),
        farthest("λ at size × 2", 0.25, 1e-8, |i| eigenvalue(&larger, i)),
        farthest("φ at size × 2", 0.125_f64.sqrt(), 1e-6, |i| {
            shape(&larger, i)
        }),
    ]
    .into())
}

/// The mode whose ratio is farthest from the reference.
fn farthest(name: &str, reference: f64, tolerance: f64, ratio: impl Fn(usize) -> f64) -> Check {
    let value = (0..WANTED)
        .map(ratio)
        .max_by(|a, b| (a - reference).abs().total_cmp(&(b - reference).abs()))
        .unwrap_or(f64::NAN);
    check(name, "", [value, reference], tolerance, DIMENSIONS)
}
