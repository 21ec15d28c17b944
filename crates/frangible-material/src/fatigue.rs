//! Static fatigue: decrease of strength with the duration of a load.

use crate::error::{OutOfRange, positive};

/// Static fatigue: in air, flaws of glass and ceramics grow slowly under a sustained load, `da/dt ∝ K^n`.
///
/// A flaw of inert strength R has, after a constant tension σ of duration t, the strength S with
/// `S^(n−2) = R^(n−2) − σ^n t / B` (S. M. Wiederhorn, J. Am. Ceram. Soc. 50 (1967) 407; inert strengths: A. G. Evans, Int. J. Fracture 10 (1974) 251), and
/// fails if σ exceeds it. B follows from the strength in a test at a constant stress rate and the inert strength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fatigue {
    /// Exponent n, above 2: soda-lime glass 16, porcelain 20 to 40.
    pub exponent: f64,
    /// Stress rate of the slow strength test, Pa/s.
    pub rate: f64,
    /// Inert strength over the strength in the slow test, above 1.
    pub increase: f64,
}

impl Fatigue {
    /// Checks every number.
    ///
    /// # Errors
    /// The first number that is out of range.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        let Self {
            exponent,
            rate,
            increase,
        } = *self;
        let fits = exponent > 2.0 && exponent <= 200.0;
        let must = "above 2 and at most 200 (glass 16)";
        OutOfRange::unless(fits, "fatigue exponent", exponent, must)?;
        positive("stress rate of the strength test", rate, "Pa/s")?;
        let fits = increase > 1.0 && increase <= 100.0;
        let must = "above 1 and at most 100 (glass 1.52)";
        OutOfRange::unless(
            fits,
            "inert strength over that of the slow test",
            increase,
            must,
        )
    }

    /// Returns the constant tension at which a flaw fails after `duration`, s, over its inert `strength`, Pa. `material`: inert strength of the
    /// specimens of the slow test, Pa.
    #[must_use]
    pub fn left_after(&self, duration: f64, strength: f64, material: f64) -> f64 {
        let n = self.exponent;
        // In logarithms, as the power of a large exponent has no number.
        let increase = libm::log(self.increase);
        let least = (n - 2.0) * increase + libm::log1p(-libm::exp((2.0 - n) * increase));
        let slow = libm::log(material) - increase;
        let b = 3.0 * slow - libm::log(n + 1.0) - libm::log(self.rate) - least;
        let c = 2.0 * libm::log(strength) + libm::log(duration) - b;
        // (n − 2) y + ln(1 + e^(c + 2y)) = 0 rises and is convex, so Newton's steps from 0 come down to its root and never pass it.
        let mut y = 0.0;
        for _ in 0..20 {
            let grown = c + 2.0 * y;
            let small = libm::exp(-grown.abs());
            let share = if grown > 0.0 { 1.0 } else { small } / (1.0 + small);
            let value = (n - 2.0) * y + grown.max(0.0) + libm::log1p(small);
            y -= value / (n - 2.0 + 2.0 * share);
        }
        libm::exp(y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GLASS: Fatigue = Fatigue {
        exponent: 16.0,
        rate: 2e6,
        increase: 1.52,
    };

    #[test]
    fn a_flaw_fails_where_the_load_has_used_up_its_strength() {
        let (strength, material) = (80e6, 62.3e6);
        for duration in [0.0, 1e-3, 3.0, 60.0, 3.15e7] {
            let sigma = strength * GLASS.left_after(duration, strength, material);
            let b = (material / 1.52_f64).powi(3) / (17.0 * 2e6 * (1.52_f64.powi(14) - 1.0));
            let used = (sigma / strength).powi(14) * (1.0 + sigma * sigma * duration / b);
            assert!((used - 1.0).abs() < 1e-9, "{duration}: {used}");
        }
    }

    #[test]
    fn glass_bears_half_as_much_for_a_year_as_for_a_moment() {
        let left = |t: f64| GLASS.left_after(t, 62.3e6, 62.3e6);
        assert!(left(1e-6) > 0.98);
        // The law of ASTM E1300 is a power of 1/16 between 3 s and a year.
        let ratio = left(3.15e7) / left(3.0);
        assert!(
            (ratio / (3.0_f64 / 3.15e7).powf(1.0 / 16.0) - 1.0).abs() < 0.01,
            "{ratio}"
        );
        assert!((0.2..0.5).contains(&left(3.15e7)), "{}", left(3.15e7));
    }

    #[test]
    fn no_number_that_is_allowed_gives_none() {
        for (exponent, rate, increase) in [
            (16.0, 2e6, 1.52),
            (200.0, f64::MIN_POSITIVE, 100.0),
            (200.0, f64::MAX, 100.0),
            (2.0 + 1e-12, 1e6, 1.0 + 1e-12),
        ] {
            let fatigue = Fatigue {
                exponent,
                rate,
                increase,
            };
            fatigue.validate().unwrap();
            for duration in [0.0, f64::MIN_POSITIVE, 1.0, f64::MAX] {
                for (strength, material) in [(1e-3, 1e12), (1e12, 1e-3)] {
                    let left = fatigue.left_after(duration, strength, material);
                    assert!((0.0..=1.0).contains(&left), "{left} of {fatigue:?}");
                }
            }
        }
    }

    #[test]
    fn numbers_that_mean_nothing_are_named() {
        for (fatigue, name) in [
            (
                Fatigue {
                    exponent: 0.0,
                    ..GLASS
                },
                "fatigue exponent",
            ),
            (
                Fatigue {
                    exponent: f64::NAN,
                    ..GLASS
                },
                "fatigue exponent",
            ),
            (Fatigue { rate: 0.0, ..GLASS }, "stress rate"),
            (
                Fatigue {
                    increase: 1.0,
                    ..GLASS
                },
                "inert strength",
            ),
        ] {
            let refused = fatigue.validate().unwrap_err().to_string();
            assert!(refused.contains(name), "{refused}");
        }
    }
}
