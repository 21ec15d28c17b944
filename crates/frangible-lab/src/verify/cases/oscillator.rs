//! One mode under a force pulse.

use std::f64::consts::PI;

use frangible::internals::modal::Oscillator;
use frangible_bake::BakeError;

use crate::verify::case::Findings;
use crate::verify::check::{Check, check, checks};
use crate::verify::ode::integrate;

/// Duration of the pulse, s.
const DURATION: f64 = 1e-3;
/// Natural frequency, rad/s.
const FREQUENCY: f64 = 4000.0;
/// Steps of the recurrence within the pulse, and after it: coarse, since each is exact.
const STEPS: u32 = 20;
/// Relative tolerance of each step of the integrator.
const TOLERANCE: f64 = 1e-10;

const INTEGRATOR: &str = "adaptive Runge–Kutta, rtol 10⁻¹⁰";

pub(super) fn compute() -> Result<Findings, BakeError> {
    let u = PI / DURATION;
    let critical = 2.0 * FREQUENCY;
    let square = FREQUENCY * FREQUENCY;
    let mut checks = Vec::new();
    let mut farthest = [0.0_f64; 2];
    for (name, lambda, d) in [
        ("undamped", square, 0.0),
        ("underdamped (ζ = 0.1)", square, 0.1 * critical),
        ("critically damped (ζ = 1)", square, critical),
        ("overdamped (ζ = 5)", square, 5.0 * critical),
        ("resonance, undamped", u * u, 0.0),
        ("resonance, ζ = 0.005", u * u, 0.01 * u),
    ] {
        let (check, off) = compare(name, lambda, d, u);
        checks.push(check);
        farthest = [0, 1].map(|i| farthest[i].max(off[i]));
    }
    checks.extend(checks![
        "farthest displacement, any moment", "", farthest[0] => 0.0, 1e-8, INTEGRATOR;
        "farthest velocity, any moment", "", farthest[1] => 0.0, 1e-8, INTEGRATOR;
    ]);
    checks.push(impulse());
    Ok(checks.into())
}

/// The largest displacement, and the farthest displacement and velocity, relative to the largest.
fn compare(name: &str, lambda: f64, d: f64, u: f64) -> (Check, [f64; 2]) {
    let w = lambda.sqrt();
    let step = DURATION / f64::from(STEPS);
    let mut mode = Oscillator::new(lambda, d, u, step);
    // (ω q, q̇), so that both are of like size.
    let mut state = [0.0, 0.0];
    let (mut largest, mut at_largest) = (0.0_f64, 0.0);
    let mut off = [0.0_f64; 2];
    for k in 0..2 * STEPS {
        let forced = k < STEPS;
        let force = |t: f64| if forced { (u * t).sin() } else { 0.0 };
        let (start, end) = (step * f64::from(k), step * f64::from(k + 1));
        let rate = |t: f64, [q, v]: [f64; 2]| [w * v, force(t) - d * v - w * q];
        state = integrate(rate, start, state, end, TOLERANCE);
        mode.step(forced);
        let q = state[0] / w;
        if q.abs() > largest {
            (largest, at_largest) = (q.abs(), mode.displacement() * q.signum());
        }
        off[0] = off[0].max((mode.displacement() - q).abs());
        off[1] = off[1].max((mode.velocity() - state[1]).abs());
    }
    let check = check(name, "s²", [at_largest, largest], 1e-8, INTEGRATOR);
    (check, [off[0] / largest, off[1] / (w * largest)])
}

fn impulse() -> Check {
    let duration = 1e-7;
    let u = PI / duration;
    let mut mode = Oscillator::new(FREQUENCY * FREQUENCY, 0.0, u, duration / 16.0);
    for _ in 0..16 {
        mode.step(true);
    }
    // Undamped: the amplitude follows from the energy. The impulse of the unit sine is 2/u.
    let pair = [
        (2.0 * mode.energy()).sqrt() / FREQUENCY,
        2.0 / u / FREQUENCY,
    ];
    check(
        "amplitude after an impulse",
        "s²",
        pair,
        1e-6,
        "impulse response, φ/ω",
    )
}
