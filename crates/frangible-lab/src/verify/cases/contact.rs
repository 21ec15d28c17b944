//! Contact of two spheres, and the pulse of force that stands for it.

use std::f64::consts::PI;
use std::sync::Arc;

use frangible::glam::Vec3;
use frangible::internals::DurationModel;
use frangible::internals::contact::{contact_duration, hertz_duration, modal_load, pulse};
use frangible::{Breakable, Contact, FractureConfig, Striker};
use frangible_bake::fem::Elasticity;
use frangible_bake::{BakeError, bake};

use crate::verify::case::Findings;
use crate::verify::check::checks;
use crate::verify::models::ball;
use crate::verify::ode::integrate;

/// Radii, m.
const RADII: [f64; 2] = [0.025, 0.010];
/// Approach speed, m/s.
const SPEED: f64 = 3.0;
const STEEL: Elasticity = Elasticity {
    youngs_modulus: 200e9,
    poisson_ratio: 0.29,
    density: 7850.0,
};

pub(super) fn compute() -> Result<Findings, BakeError> {
    let (e, nu) = (STEEL.youngs_modulus, STEEL.poisson_ratio);
    let masses = RADII.map(|r| STEEL.density * 4.0 / 3.0 * PI * r.powi(3));
    let mass = 1.0 / (1.0 / masses[0] + 1.0 / masses[1]);
    let radius = 1.0 / (1.0 / RADII[0] + 1.0 / RADII[1]);
    let modulus = e / (2.0 * (1.0 - nu * nu));
    let given = hertz_duration(mass, modulus, radius, SPEED);
    let exact = exact_constant() * (mass * mass / (modulus * modulus * radius * SPEED)).powf(0.2);
    let coarse = Some(0.5 * RADII[0]);
    let asset = bake(&ball(RADII[0], &STEEL, coarse))?;
    let striker = Striker::rigid()
        .with_contact_modulus(e / (1.0 - nu * nu))
        .with_effective_mass(masses[1])
        .with_curvature_radius(RADII[1])
        .with_restitution(0.5);
    let top = Vec3::new(0.0, RADII[0] as f32, 0.0);
    let hit = Contact::strike(top, Vec3::NEG_Y, SPEED as f32, striker);
    let asset = Arc::new(asset);
    let body = Breakable::uniform(Arc::clone(&asset))
        .map_err(BakeError::from)?
        .body(1);
    let load = modal_load(&body, &[hit]);
    let duration = contact_duration(&asset, &load, DurationModel::Hertz);
    let pulse = pulse(&asset, &load, duration, &FractureConfig::default());
    let force = |t: f64| pulse.amplitude * (pulse.frequency() * t).sin();
    let steps = pulse.contact_steps as f64 * pulse.time_step / pulse.duration;
    let law = integrated(mass, modulus, radius);
    Ok(checks![
        "duration, two spheres", "s", given => exact, 2e-4, "H. Hertz (1882); Johnson, Contact Mechanics, Eq. 11.24";
        "the same, law integrated", "s", given => law, 2e-4, "adaptive Runge–Kutta, rtol 10⁻¹⁰";
        "duration, baked sphere", "s", duration => exact, 0.02, "the same, from a mesh";
        "∫ f dt / φ", "", simpson(force, pulse.duration) => 1.0, 1e-12, "momentum";
        "steps of the pulse × Δt / t_d", "", steps => 1.0, 1e-12, "no step straddles the end";
    ]
    .into())
}

/// 2 √π Γ(7/5)/Γ(9/10) (15/16)^(2/5).
fn exact_constant() -> f64 {
    const GAMMA_7_5: f64 = 0.887_263_817_503_075_2;
    const GAMMA_9_10: f64 = 1.068_628_702_119_319_4;
    2.0 * PI.sqrt() * GAMMA_7_5 / GAMMA_9_10 * (15.0_f64 / 16.0).powf(0.4)
}

/// Duration by Hertz' law of force: twice the time until the spheres no longer approach, found by Newton's method.
fn integrated(mass: f64, modulus: f64, radius: f64) -> f64 {
    let k = 4.0 / 3.0 * modulus * radius.sqrt() / mass;
    // Depth and speed of like size by a rate of their own: v over the deepest δ.
    let w = SPEED / (1.25 * SPEED * SPEED / k).powf(0.4);
    let acceleration = |depth: f64| -k * depth.max(0.0).powf(1.5);
    let rate = |_: f64, [x, v]: [f64; 2]| [w * v, acceleration(x / w)];
    let mut time = 1.4 / w;
    for _ in 0..8 {
        let [x, v] = integrate(rate, 0.0, [0.0, SPEED], time, 1e-10);
        time -= v / acceleration(x / w);
    }
    2.0 * time
}

/// ∫ f over 0..end with a thousand intervals: right to 1e-13 for a half-sine.
fn simpson(f: impl Fn(f64) -> f64, end: f64) -> f64 {
    const INTERVALS: u32 = 1000;
    let h = end / f64::from(INTERVALS);
    let weight = |k: u32| match k {
        0 | INTERVALS => 1.0,
        k if k % 2 == 1 => 4.0,
        _ => 2.0,
    };
    (0..=INTERVALS)
        .map(|k| weight(k) * f(h * f64::from(k)))
        .sum::<f64>()
        * h
        / 3.0
}
