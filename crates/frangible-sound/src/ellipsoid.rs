//! Added mass of an ellipsoid, which determines the sound of a shaken body at low frequencies.

use std::f64::consts::PI;

/// Returns the volume of an ellipsoid with these semi-axes, m, plus that of the air that moves with it along each axis, m³. Multiplied
/// by the density of air and the acceleration, it is the dipole moment. 2πa³ for a sphere, 8a³/3 for a thin disc across itself.
/// Lamb, Hydrodynamics, §114: V (1 + α/(2−α)), α_i = abc ∫₀^∞ dλ / ((a_i²+λ) √((a²+λ)(b²+λ)(c²+λ))).
#[must_use]
pub fn moved_air(semi_axes: [f64; 3]) -> [f64; 3] {
    let product: f64 = semi_axes.iter().product();
    let squares = semi_axes.map(|a| a * a);
    let least = squares.iter().copied().fold(f64::INFINITY, f64::min);
    let most = squares.iter().copied().fold(0.0, f64::max);
    // λ = e^u: the integrand falls exponentially to both sides, where the trapezoidal rule converges fastest.
    let (from, to) = ((1e-12 * least).ln(), (1e12 * most).ln());
    let steps = 600;
    let step = (to - from) / f64::from(steps);
    let mut alpha = [0.0; 3];
    for k in 0..=steps {
        let lambda = (from + f64::from(k) * step).exp();
        let root = squares.iter().map(|s| s + lambda).product::<f64>().sqrt();
        for (alpha, square) in alpha.iter_mut().zip(squares) {
            *alpha += step * product * lambda / ((square + lambda) * root);
        }
    }
    let volume = 4.0 / 3.0 * PI * product;
    // They sum to 2; of a thin disc 2 − α would be lost in rounding.
    [
        2.0 * volume / (alpha[1] + alpha[2]),
        2.0 * volume / (alpha[0] + alpha[2]),
        2.0 * volume / (alpha[0] + alpha[1]),
    ]
}
