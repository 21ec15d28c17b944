//! A thin free square plate.

use frangible_bake::{BakeError, Shape};

use crate::case::{Case, Findings};
use crate::check::number;
use crate::models::{TABLES, free_modes, quadratic};

/// Side and thickness, m.
const SIDE: f64 = 0.4;
const THICKNESS: f64 = 0.004;

/// ω a² √(ρh/D) for ν = 0.3.
const COEFFICIENTS: [f64; 5] = [13.47, 19.60, 24.27, 34.80, 34.80];

pub(crate) const CASE: Case = Case {
    name: "plate",
    title: "Free square plate",
    about: "A thin plate, 400 × 400 × 4 mm, ν 0.3: the first five values of ω a² √(ρh/D), D = E h³/(12 (1 − ν²)), with one \
        layer of quadratic elements. Leissa's survey gives 13.47 to 13.49, 19.60 to 19.79 and 24.27 to 24.43 for the first three, \
        the Ritz series from above; the limits are taken. The 16 × 16 elements of the first rows are about as many as a bake takes.",
    compute,
};

const LEISSA: &str = "A. W. Leissa, J. Sound Vib. 31, 257 (1973), and later series";

fn compute(progress: &mut dyn FnMut(f64)) -> Result<Findings, BakeError> {
    let e = TABLES.youngs_modulus;
    let nu = TABLES.poisson_ratio;
    let bending = e * THICKNESS.powi(3) / (12.0 * (1.0 - nu * nu));
    let factor = SIDE * SIDE * (TABLES.density * THICKNESS / bending).sqrt();
    let mut checks = Vec::new();
    for (squares, tolerance) in [(16, 0.015), (24, 0.003)] {
        let edge = SIDE / f64::from(squares);
        let plate = Shape::plate(SIDE, SIDE, THICKNESS);
        let modes = free_modes(&quadratic(&plate, edge, 1, &TABLES)?, 5)?;
        for (i, reference) in COEFFICIENTS.into_iter().enumerate() {
            checks.push(number(
                format!("mode {}, {squares} × {squares}", i + 1),
                modes.eigenvalues[i].sqrt() * factor,
                reference,
                tolerance,
                LEISSA,
            ));
        }
        progress(f64::from(squares - 12) / 12.0);
    }
    Ok(checks.into())
}
