//! A free square bar: bending, stretching, twisting.

use std::f64::consts::{PI, TAU};

use frangible_bake::fem::Elasticity;
use frangible_bake::{BakeError, Shape};

use crate::case::{Case, Findings};
use crate::check::hertz;
use crate::models::{GLASS, free_modes, norm, quadratic, root};

const LENGTH: f64 = 0.5;
const SIDE: f64 = 0.03;

pub(crate) const CASE: Case = Case {
    name: "bar",
    title: "Free bar",
    about: "A square glass bar, 500 × 30 × 30 mm (E 70 GPa, ν 0.23, ρ 2500 kg/m³), quadratic elements 15 mm long, two \
        layers. Bending: Timoshenko's beam, with rotary inertia and shear (Euler and Bernoulli's is 1.4 % higher here). \
        Stretching: c/(2L) with c = √(E/ρ); the lateral motion that the formula leaves out lowers it by some per mille. \
        Twisting: √(μJ/(ρI_p))/(2L) with J = 0.1406 a⁴.",
    compute,
};

const BEAM: &str = "Timoshenko's beam; T. C. Huang, J. Appl. Mech. 28, 579 (1961); shear coefficient of Cowper (1966)";

fn compute(progress: &mut dyn FnMut(f64)) -> Result<Findings, BakeError> {
    let system = quadratic(&Shape::rod(LENGTH, SIDE), 0.5 * SIDE, 2, &GLASS)?;
    let modes = free_modes(&system, 12)?;
    progress(1.0);
    let (first, second) = (timoshenko(&GLASS, 0), timoshenko(&GLASS, 1));
    let mut checks = vec![
        hertz("first bending", modes.frequency(0), first, 0.01, BEAM),
        hertz(
            "first bending, across",
            modes.frequency(1),
            first,
            0.01,
            BEAM,
        ),
        hertz("second bending", modes.frequency(2), second, 0.01, BEAM),
    ];
    // The axial mode moves along x alone, the first torsional one across it, and not in the middle plane's mean.
    let share_along_x = |i: usize| {
        let along: Vec<f64> = modes.shape(i).iter().step_by(3).copied().collect();
        norm(&along) / norm(modes.shape(i))
    };
    let axial = (0..12).find(|&i| share_along_x(i) > 0.99);
    let torsion = (0..12).find(|&i| share_along_x(i) < 0.05);
    // NaN where there is no such mode: the check fails.
    let frequency = |mode: Option<usize>| mode.map_or(f64::NAN, |i| modes.frequency(i));
    let shear_modulus = GLASS.lame().1;
    checks.push(hertz(
        "torsion",
        frequency(torsion),
        // J / I_p = 0.1406 · 6.
        (0.8436 * shear_modulus / GLASS.density).sqrt() / (2.0 * LENGTH),
        0.01,
        "Saint-Venant; Timoshenko and Goodier, Theory of Elasticity, §109",
    ));
    checks.push(hertz(
        "stretching",
        frequency(axial),
        (GLASS.youngs_modulus / GLASS.density).sqrt() / (2.0 * LENGTH),
        0.01,
        "wave equation of a thin rod",
    ));
    Ok(checks.into())
}

/// Frequency of the `n`-th bending mode of the free bar with shear and rotary inertia, Hz.
fn timoshenko(material: &Elasticity, n: usize) -> f64 {
    let (e, density) = (material.youngs_modulus, material.density);
    let nu = material.poisson_ratio;
    let shear_coefficient = 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu);
    // Huang's numbers: r² = I/(AL²), s² = EI/(kAμL²), b² = ρAL⁴ω²/(EI).
    let r2 = SIDE * SIDE / (12.0 * LENGTH * LENGTH);
    let s2 = r2 * e / (shear_coefficient * material.lame().1);
    let characteristic = |b: f64| {
        let b2 = b * b;
        let inner = ((r2 - s2).powi(2) + 4.0 / b2).sqrt();
        let alpha = ((inner - (r2 + s2)) / 2.0).sqrt();
        let beta = ((inner + (r2 + s2)) / 2.0).sqrt();
        let factor =
            b * (b2 * r2 * (r2 - s2).powi(2) + 3.0 * r2 - s2) / (1.0 - b2 * r2 * s2).sqrt();
        2.0 - 2.0 * (b * alpha).cosh() * (b * beta).cos()
            + factor * (b * alpha).sinh() * (b * beta).sin()
    };
    // Euler and Bernoulli's root (4.730, 7.853, …)² is an upper end, and the next lower one far below.
    let slender = |n: usize| ((n as f64 + 1.5) * PI).powi(2);
    let b = root(characteristic, 0.7 * slender(n), 1.01 * slender(n));
    let radius_of_gyration = SIDE / 12.0_f64.sqrt();
    b * radius_of_gyration * (e / density).sqrt() / (LENGTH * LENGTH * TAU)
}
