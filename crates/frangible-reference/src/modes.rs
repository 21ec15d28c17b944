//! Modal deformation: the damped wave under the contact's force, analytically `[G12 §4.3, §4.4]`.
//!
//! Of `q̈ + d q̇ + λ q = sin(u t)` from rest: the forced motion `Im(X e^{iut})`, `X = 1/(λ − u² + i d u)`, and the
//! free one `c₁ e^{ω₁ t} + c₂ e^{ω₂ t}` with the paper's complex ω that makes it start from rest.

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::body::Solid;
use crate::contact::{Force, damping};

/// q of every mode at time `t` within the contact, m·√kg.
pub(crate) fn amplitudes(solid: &Solid, force: &Force, t: f64) -> Vec<f64> {
    let (u, a) = (force.frequency(), force.amplitude());
    let mut q = Vec::new();
    for (i, &lambda) in solid.asset.modes.eigenvalues.iter().enumerate() {
        let unit = forced(lambda, damping(solid, i), u, t);
        q.push(force.modal_impulse[i] * a * unit);
    }
    q
}

/// Response of one mode to sin(u t), from rest.
pub(crate) fn forced(lambda: f64, d: f64, mut u: f64, t: f64) -> f64 {
    // The formula is 0/0 at undamped resonance and at critical damping; a hair beside them it is right to 1e-7.
    if (lambda - u * u).abs() + d * u < 1e-7 * lambda {
        u *= 1.0 + 1e-7;
    }
    let mut root = Complex::real(0.25 * d * d - lambda).sqrt();
    if root.norm() < 1e-7 * d {
        root = Complex::real(1e-7 * d);
    }
    let half = Complex::real(-0.5 * d);
    let (w1, w2) = (half + root, half - root);
    let x = Complex::real(1.0) / Complex(lambda - u * u, d * u);
    let at_rest = Complex::real(-u * x.0);
    let c1 = (at_rest + w2 * Complex::real(x.1)) / (w1 - w2);
    let c2 = -Complex::real(x.1) - c1;
    let steady = x * Complex(0.0, u * t).exp();
    let free = c1 * (w1 * Complex::real(t)).exp() + c2 * (w2 * Complex::real(t)).exp();
    steady.1 + free.0
}

#[derive(Clone, Copy)]
struct Complex(f64, f64);

impl Complex {
    fn real(x: f64) -> Self {
        Self(x, 0.0)
    }

    fn norm(self) -> f64 {
        self.0.hypot(self.1)
    }

    fn exp(self) -> Self {
        Self(self.1.cos(), self.1.sin()) * Self::real(self.0.exp())
    }

    /// Of a real number.
    fn sqrt(self) -> Self {
        if self.0 < 0.0 {
            Self(0.0, (-self.0).sqrt())
        } else {
            Self(self.0.sqrt(), 0.0)
        }
    }
}

impl Add for Complex {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Self(self.0 + b.0, self.1 + b.1)
    }
}

impl Sub for Complex {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        Self(self.0 - b.0, self.1 - b.1)
    }
}

impl Neg for Complex {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}

impl Mul for Complex {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        Self(self.0 * b.0 - self.1 * b.1, self.0 * b.1 + self.1 * b.0)
    }
}

impl Div for Complex {
    type Output = Self;
    fn div(self, b: Self) -> Self {
        let n = b.0 * b.0 + b.1 * b.1;
        Self(
            (self.0 * b.0 + self.1 * b.1) / n,
            (self.1 * b.0 - self.0 * b.1) / n,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::forced;

    /// Runge-Kutta of fourth order with steps too small to matter.
    fn integrated(lambda: f64, d: f64, u: f64, t: f64) -> f64 {
        const STEPS: usize = 20_000;
        let h = t / STEPS as f64;
        let rate = |[q, v]: [f64; 2], t: f64| [v, (u * t).sin() - d * v - lambda * q];
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
        x[0]
    }

    #[test]
    fn the_response_is_that_of_the_differential_equation() {
        let (u, end) = (3.0, std::f64::consts::PI / 3.0);
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
            for share in [0.1, 0.5, 1.0] {
                let (x, y) = (
                    forced(lambda, d, u, share * end),
                    integrated(lambda, d, u, share * end),
                );
                assert!(
                    (x - y).abs() < 1e-6 * y.abs().max(1.0 / lambda),
                    "{lambda} {d}: {x} {y}"
                );
            }
        }
    }
}
