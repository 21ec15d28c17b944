//! Modal deformation: the damped wave under the contact's force, analytically `[G12 §4.3, §4.4]`.
//!
//! The solution of `q̈ + d q̇ + λ q = sin(u t)` from rest: the forced motion `Im(X e^{iut})`, `X = 1/(λ − u² + i d u)`, and the
//! free one `c₁ e^{ω₁ t} + c₂ e^{ω₂ t}` with the paper's complex ω that makes it start from rest.

use num_complex::Complex64;

use crate::reference::body::Solid;
use crate::reference::contact::{Force, damping};

/// q of every mode after `step` steps, m·√kg.
pub(crate) fn amplitudes(solid: &Solid, force: &Force, step: usize) -> Vec<f64> {
    let (u, a) = (force.frequency(), force.amplitude());
    let within = step.min(force.contact_steps) as f64 * force.time_step;
    let after = step.saturating_sub(force.contact_steps) as f64 * force.time_step;
    let mut q = Vec::new();
    for (i, &lambda) in solid.asset.modes().eigenvalues.iter().enumerate() {
        let d = damping(solid, i);
        let mut unit = forced(lambda, d, u, within);
        if after > 0.0 {
            unit.0 = free(lambda, d, unit, after);
        }
        q.push(force.modal_impulse[i] * a * unit.0);
    }
    q
}

/// q and q̇ of one mode under sin(u t), from rest.
pub(crate) fn forced(lambda: f64, d: f64, mut u: f64, t: f64) -> (f64, f64) {
    // The formula is 0/0 at undamped resonance and at critical damping; a hair beside them it is right to 1e-7.
    if (lambda - u * u).abs() + d * u < 1e-7 * lambda {
        u *= 1.0 + 1e-7;
    }
    let (w1, w2) = roots(lambda, d);
    let x = Complex64::from(1.0) / Complex64::new(lambda - u * u, d * u);
    let at_rest = Complex64::from(-u * x.re);
    let c1 = (at_rest + w2 * Complex64::from(x.im)) / (w1 - w2);
    let c2 = -Complex64::from(x.im) - c1;
    let steady = x * Complex64::new(0.0, u * t).exp();
    let (e1, e2) = (
        c1 * (w1 * Complex64::from(t)).exp(),
        c2 * (w2 * Complex64::from(t)).exp(),
    );
    (
        steady.im + (e1 + e2).re,
        u * steady.re + (w1 * e1 + w2 * e2).re,
    )
}

/// q of one mode a time `t` after it was left alone with this q and q̇.
fn free(lambda: f64, d: f64, (q, v): (f64, f64), t: f64) -> f64 {
    let (w1, w2) = roots(lambda, d);
    let c1 = (Complex64::from(v) - w2 * Complex64::from(q)) / (w1 - w2);
    let c2 = Complex64::from(q) - c1;
    (c1 * (w1 * Complex64::from(t)).exp() + c2 * (w2 * Complex64::from(t)).exp()).re
}

/// ω = (−d ± √(d² − 4 λ)) / 2.
fn roots(lambda: f64, d: f64) -> (Complex64, Complex64) {
    let mut root = Complex64::from(0.25 * d * d - lambda).sqrt();
    if root.norm() < 1e-7 * d {
        root = Complex64::from(1e-7 * d);
    }
    let half = Complex64::from(-0.5 * d);
    (half + root, half - root)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::{forced, free};

    /// q and q̇ by Runge-Kutta of fourth order with steps too small to matter; the force ends at π/u.
    fn integrated(lambda: f64, d: f64, u: f64, t: f64) -> (f64, f64) {
        // A multiple of the shares below, so that a step ends where the force does.
        const STEPS: usize = 20_000;
        let h = t / STEPS as f64;
        let force = |t: f64| if u * t < PI { (u * t).sin() } else { 0.0 };
        let rate = |[q, v]: [f64; 2], t: f64| [v, force(t) - d * v - lambda * q];
        let ahead = |x: [f64; 2], k: [f64; 2], h: f64| [x[0] + h * k[0], x[1] + h * k[1]];
        let mut x = [0.0, 0.0];
        for step in 0..STEPS {
            let now = step as f64 * h;
            let a = rate(x, now);
            let b = rate(ahead(x, a, 0.5 * h), now + 0.5 * h);
            let c = rate(ahead(x, b, 0.5 * h), now + 0.5 * h);
            let e = rate(ahead(x, c, h), now + h);
            for i in 0..2 {
                x[i] += h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + e[i]);
            }
        }
        (x[0], x[1])
    }

    #[test]
    fn the_response_is_that_of_the_differential_equation() {
        let u = 3.0;
        let end = PI / u;
        // Under-damped, undamped, at resonance with and without damping, critically damped, over-damped.
        for (lambda, d) in [
            (100.0, 1.0),
            (100.0, 0.0),
            (9.0, 0.5),
            (9.0, 0.0),
            (25.0, 10.0),
            (25.0, 40.0),
            (1e4, 3.0),
        ] {
            let near = |x: f64, y: f64| (x - y).abs() < 1e-6 * y.abs().max(1.0 / lambda);
            for share in [0.1, 0.5, 1.0] {
                let (x, y) = (
                    forced(lambda, d, u, share * end),
                    integrated(lambda, d, u, share * end),
                );
                assert!(near(x.0, y.0), "{lambda} {d}: {x:?} {y:?}");
                assert!((x.1 - y.1).abs() < 1e-6, "{lambda} {d}: {x:?} {y:?}");
            }
            for share in [2.0, 4.0] {
                let y = integrated(lambda, d, u, share * end).0;
                let x = free(lambda, d, forced(lambda, d, u, end), (share - 1.0) * end);
                assert!(near(x, y), "{lambda} {d}, after: {x} {y}");
            }
        }
    }
}
