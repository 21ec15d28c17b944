//! Weibull scatter of the strength, seeded per element.

use crate::rng::{Purpose, stream, uniform};

/// Least factor that the scatter gives: a flaw this deep would not have survived the making.
const LEAST: f64 = 0.01;

/// Factor on the strength of a weak tetrahedron: the share of those that do not survive a factor f is 1 − exp(−f^m).
pub(super) fn scatter(seed: u64, tet: u32, modulus: f64) -> f64 {
    let share = uniform(&mut stream(seed, Purpose::Strength, tet));
    libm::pow(-libm::log1p(-share), 1.0 / modulus).max(LEAST)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scattered_strengths_follow_weibull() {
        for modulus in [2.0, 5.0, 12.0] {
            let n = 20_000;
            let mut factors: Vec<f64> = (0..n).map(|e| scatter(7, e, modulus)).collect();
            factors.sort_by(f64::total_cmp);
            // Kolmogorov's distance: its 99.9 % quantile is 1.95/√n.
            let distance = factors
                .iter()
                .enumerate()
                .map(|(i, f)| {
                    let survived = (-f.powf(modulus)).exp();
                    (1.0 - survived - (i as f64 + 0.5) / f64::from(n)).abs()
                })
                .fold(0.0, f64::max);
            assert!(
                distance < 1.95 / f64::from(n).sqrt(),
                "{modulus}: {distance}"
            );
        }
    }
}
