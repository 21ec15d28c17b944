//! A free square bar: bending, stretching, twisting.

use std::f64::consts::{PI, TAU};

use frangible::glam::DVec3;
use frangible_bake::eigen::Modes;
use frangible_bake::fem::{Elasticity, System};
use frangible_bake::{BakeError, Shape};

use crate::verify::case::Findings;
use crate::verify::check::checks;
use crate::verify::models::{GLASS, covered, free_modes, quadratic, root};

const LENGTH: f64 = 0.5;
const SIDE: f64 = 0.03;

const BEAM: &str = "Timoshenko's beam; T. C. Huang, J. Appl. Mech. 28, 579 (1961); shear coefficient of Cowper (1966)";
const TORSION: &str = "Saint-Venant; Timoshenko and Goodier, Theory of Elasticity, §109";
const ROD: &str = "wave equation of a thin rod";

/// Number of modes.
const WANTED: usize = 12;

pub(super) fn compute() -> Result<Findings, BakeError> {
    let bar = Shape::rod(LENGTH, SIDE);
    let [first, second] = [0, 1].map(|n| timoshenko(&GLASS, n));
    // J / I_p = 0.1406 · 6.
    let torsion = (0.8436 * GLASS.lame().1 / GLASS.density).sqrt() / (2.0 * LENGTH);
    let rod = (GLASS.youngs_modulus / GLASS.density).sqrt() / (2.0 * LENGTH);
    let mut checks = Vec::new();
    for (what, system, torsion_tolerance) in [
        ("mesh", quadratic(&bar, 0.5 * SIDE, 2, &GLASS)?, 0.05),
        ("lattice", covered(&bar, 0.01, 1000, &GLASS)?, 0.02),
    ] {
        let modes = free_modes(&system, WANTED)?;
        // Along the bar both go as cos(πx/L).
        let wave = |p: DVec3| (PI * p.x / LENGTH).cos();
        let twisting = most_like(&modes, &system, |p| {
            wave(p) * DVec3::X.cross(p - DVec3::new(p.x, 0.5 * SIDE, 0.5 * SIDE))
        });
        let stretching = most_like(&modes, &system, |p| wave(p) * DVec3::X);
        let found = |mode: Option<usize>| mode.map_or(f64::NAN, |i| modes.frequency(i));
        let named = |name: &str| format!("{name}, {what}");
        checks.extend(checks![
            named("first bending"), "Hz", modes.frequency(0) => first, 0.01, BEAM;
            named("first bending across"), "Hz", modes.frequency(1) => first, 0.01, BEAM;
            named("second bending"), "Hz", modes.frequency(2) => second, 0.01, BEAM;
            named("twisting"), "Hz", found(twisting) => torsion, torsion_tolerance, TORSION;
            named("stretching"), "Hz", found(stretching) => rod, 0.01, ROD;
        ]);
    }
    Ok(checks.into())
}

/// The mode most like a motion: the largest of φᵀ M u.
fn most_like(modes: &Modes, system: &System, motion: impl Fn(DVec3) -> DVec3) -> Option<usize> {
    let field: Vec<f64> = system
        .positions
        .iter()
        .flat_map(|p| motion(*p).to_array())
        .collect();
    let inertia = system.mass.multiply(&field);
    let share = |i: &usize| {
        let product: f64 = modes
            .shape(*i)
            .iter()
            .zip(&inertia)
            .map(|(x, m)| x * m)
            .sum();
        product.abs()
    };
    (0..WANTED).max_by(|a, b| share(a).total_cmp(&share(b)))
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
