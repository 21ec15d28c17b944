//! A thin free square plate.

use frangible_bake::{BakeError, Shape};

use crate::verify::case::Findings;
use crate::verify::check::check;
use crate::verify::models::{TABLES, covered, free_modes, quadratic};

/// Side and thickness, m.
const SIDE: f64 = 0.4;
const THICKNESS: f64 = 0.004;

/// ω a² √(ρh/D) for ν = 0.3.
const COEFFICIENTS: [f64; 5] = [13.47, 19.60, 24.27, 34.80, 34.80];

const LEISSA: &str = "A. W. Leissa, J. Sound Vib. 31, 257 (1973), and later series";

pub(super) fn compute() -> Result<Findings, BakeError> {
    let e = TABLES.youngs_modulus;
    let nu = TABLES.poisson_ratio;
    let bending = e * THICKNESS.powi(3) / (12.0 * (1.0 - nu * nu));
    let factor = SIDE * SIDE * (TABLES.density * THICKNESS / bending).sqrt();
    let plate = Shape::plate(SIDE, SIDE, THICKNESS);
    let squares = |n: u32| quadratic(&plate, SIDE / f64::from(n), 1, &TABLES);
    let models = [
        ("16 × 16", squares(16)?, 0.015),
        ("24 × 24", squares(24)?, 0.003),
        ("lattice", covered(&plate, 0.01, 3000, &TABLES)?, 0.02),
    ];
    let mut checks = Vec::new();
    for (what, system, tolerance) in &models {
        let modes = free_modes(system, 5)?;
        for (i, reference) in COEFFICIENTS.into_iter().enumerate() {
            let name = format!("mode {}, {what}", i + 1);
            let found = modes.eigenvalues[i].sqrt() * factor;
            checks.push(check(name, "", [found, reference], *tolerance, LEISSA));
        }
    }
    Ok(checks.into())
}
