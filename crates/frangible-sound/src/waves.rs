//! Spherical harmonics and outgoing spherical waves.

use glam::DVec3;
use num_complex::Complex64;

/// Highest degree l of the spherical harmonics that represent a mode's surface motion. A sphere of radius a radiates degree l efficiently
/// from k a ≈ l on, so that this degree suffices up to 6.5 kHz for a radius of 5 cm; above, the finest pattern of a mode is omitted.
pub const MOST_DEGREE: usize = 6;

/// Number of real spherical harmonics up to [`MOST_DEGREE`].
pub const HARMONICS: usize = (MOST_DEGREE + 1) * (MOST_DEGREE + 1);

/// Returns the index of the harmonic of degree l and order m, −l to l, in a list of harmonics.
#[must_use]
pub const fn harmonic(l: usize, m: isize) -> usize {
    ((l * l + l) as isize + m) as usize
}

/// The degree of the harmonic at a place of the list.
pub(crate) const fn degree(place: usize) -> usize {
    let mut l = 0;
    while (l + 1) * (l + 1) <= place {
        l += 1;
    }
    l
}

/// Returns all real spherical harmonics in a direction, orthonormal over the unit sphere: cos mφ for order m > 0, sin |m|φ for m < 0.
/// The direction need not be of unit length; a zero vector counts as +z.
#[must_use]
pub fn harmonics(direction: DVec3) -> [f64; HARMONICS] {
    let d = direction.try_normalize().unwrap_or(DVec3::Z);
    let mut values = [0.0; HARMONICS];
    // P_l^m(z) / sin^m θ times the norm, by the recurrence in l; (x + iy)^m carries sin^m θ e^{imφ}.
    let (mut power, mut sectoral) = ((1.0, 0.0), (1.0 / (4.0 * std::f64::consts::PI)).sqrt());
    for m in 0..=MOST_DEGREE {
        if m > 0 {
            let k = m as f64;
            sectoral *= ((2.0 * k + 1.0) / (2.0 * k)).sqrt();
            power = (power.0 * d.x - power.1 * d.y, power.0 * d.y + power.1 * d.x);
        }
        let root = if m == 0 { 1.0 } else { 2.0_f64.sqrt() };
        let (mut before, mut now) = (0.0, sectoral);
        for l in m..=MOST_DEGREE {
            values[harmonic(l, m as isize)] = root * power.0 * now;
            if m > 0 {
                values[harmonic(l, -(m as isize))] = root * power.1 * now;
            }
            let (n, k) = ((l + 1) as f64, m as f64);
            let factor = |n: f64| ((4.0 * n * n - 1.0) / (n * n - k * k)).sqrt();
            let older = if l > m { before / factor(n - 1.0) } else { 0.0 };
            (before, now) = (now, factor(n) * (d.z * now - older));
        }
    }
    values
}

/// h_l(x) e^{ix} for l = 0 to [`MOST_DEGREE`] + 1: spherical Hankel functions of the second kind, which go outwards in time e^{+iωt},
/// without the phase of the way. By their finite sum, which loses no digits at any x.
pub(crate) fn hankel(x: f64) -> [Complex64; MOST_DEGREE + 2] {
    std::array::from_fn(|l| {
        // i^{l+1}/x Σ_m (−i)^m (l+m)! / (m! (l−m)! (2x)^m)
        let (mut sum, mut term) = (Complex64::default(), Complex64::ONE);
        for m in 0..=l {
            sum += term;
            let (a, b) = ((l + m + 1) as f64, (l - m) as f64);
            // Times −i (l+m+1)(l−m) / ((m+1) 2x).
            let factor = a * b / ((m + 1) as f64 * 2.0 * x);
            term = Complex64::new(term.im, -term.re).scale(factor);
        }
        let mut value = sum.scale(1.0 / x);
        for _ in 0..=l {
            value = Complex64::new(-value.im, value.re);
        }
        value
    })
}

/// h_l'(x) e^{ix} for l = 0 to [`MOST_DEGREE`].
pub(crate) fn hankel_slopes(x: f64) -> [Complex64; MOST_DEGREE + 1] {
    let h = hankel(x);
    std::array::from_fn(|l| h[l].scale(l as f64 / x) - h[l + 1])
}

/// Returns the radiation efficiency of each degree at k a = x: the power of a sphere of radius a that vibrates in a harmonic of this
/// degree, relative to that of a plane wave of the same area and velocity. x²/(1+x²) for l = 0, x⁴/(4+x⁴) for l = 1.
#[must_use]
pub fn efficiencies(x: f64) -> [f64; MOST_DEGREE + 1] {
    hankel_slopes(x).map(|slope| 1.0 / (x * x * slope.norm_sqr()))
}
