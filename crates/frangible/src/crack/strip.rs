//! An edge crack in a strip (Tada, Paris, Irwin, §2.10 and §2.13): K = σ √(π a) F.

use std::f64::consts::FRAC_PI_2;
use std::sync::LazyLock;

/// Largest α: beyond it the functions only grow.
pub(super) const MOST: f64 = 0.97;

/// Parts of the range of a/H in which the integrals are tabulated.
const STEPS: usize = 512;

/// F of tension, at α = a/H.
pub(super) fn tension(alpha: f64) -> f64 {
    let y = FRAC_PI_2 * alpha;
    factor(y) * (0.752 + 2.02 * alpha + 0.37 * (1.0 - libm::sin(y)).powi(3))
}

/// F of bending, at α = a/H.
pub(super) fn bending(alpha: f64) -> f64 {
    let y = FRAC_PI_2 * alpha;
    factor(y) * (0.923 + 0.199 * (1.0 - libm::sin(y)).powi(4))
}

fn factor(y: f64) -> f64 {
    let ratio = match y > 1e-6 {
        true => libm::tan(y) / y,
        false => 1.0,
    };
    libm::sqrt(ratio) / libm::cos(y)
}

/// ∫₀^α x F F dx of tension with itself, with bending, and of bending with itself.
pub(super) fn integrals(alpha: f64) -> [f64; 3] {
    static TABLE: LazyLock<Vec<[f64; 3]>> = LazyLock::new(table);
    let at = alpha * STEPS as f64 / MOST;
    let k = (at as usize).min(STEPS - 1);
    let part = at - k as f64;
    [0, 1, 2].map(|i| TABLE[k][i] + part * (TABLE[k + 1][i] - TABLE[k][i]))
}

fn table() -> Vec<[f64; 3]> {
    let step = MOST / STEPS as f64;
    let mut sum = [0.0; 3];
    let mut table = vec![sum];
    for k in 0..STEPS {
        let alpha = (k as f64 + 0.5) * step;
        let (t, b) = (tension(alpha), bending(alpha));
        for (sum, product) in sum.iter_mut().zip([t * t, t * b, b * b]) {
            *sum += step * alpha * product;
        }
        table.push(sum);
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The polynomials of W. Brown and J. Srawley (ASTM STP 410, 1966), for α up to 0.6.
    #[test]
    fn factors_are_those_of_other_authors() {
        let polynomial = |alpha: f64, factors: [f64; 5]| {
            let terms = factors.iter().rev();
            terms.fold(0.0, |sum, factor| sum * alpha + factor)
        };
        for alpha in [0.05, 0.2, 0.4, 0.5, 0.6] {
            let of_tension = polynomial(alpha, [1.122, -0.231, 10.55, -21.71, 30.382]);
            let of_bending = polynomial(alpha, [1.122, -1.40, 7.33, -13.08, 14.0]);
            assert!((tension(alpha) / of_tension - 1.0).abs() < 0.02, "{alpha}");
            assert!((bending(alpha) / of_bending - 1.0).abs() < 0.02, "{alpha}");
        }
    }

    #[test]
    fn fronts_wake_before_their_section_can_move_them() {
        let largest = tension(MOST) + 1.5 * bending(MOST);
        assert!(
            (0.9..=1.0).contains(&(largest / crate::tips::SECTION)),
            "{largest}"
        );
    }

    #[test]
    fn integrals_grow_by_their_integrands() {
        for alpha in [0.1, 0.5, 0.9] {
            let step = 0.01;
            let [above, below] = [alpha + step, alpha - step].map(integrals);
            let (t, b) = (tension(alpha), bending(alpha));
            for (k, product) in [t * t, t * b, b * b].into_iter().enumerate() {
                let slope = (above[k] - below[k]) / (2.0 * step);
                let ratio = slope / (alpha * product);
                assert!((ratio - 1.0).abs() < 0.04, "{alpha} {k}: {ratio}");
            }
        }
    }
}
