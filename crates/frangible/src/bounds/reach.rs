//! Largest amplitude of a mode under a blow at any time, for stress bounds that follow no time.
//!
//! From rest, q̈ + d q̇ + λ q = f(t). With w = √(q̇² + λ q²) any force gives ẇ ≤ |f|, damped or not, and √λ |q| ≤ w. Hence
//! √λ |q| ≤ ∫ |f| dt, always. A mode that follows the force has q = f/λ, at most that of the largest force.

use crate::modal::ModalBasis;

/// Largest amplitude of each mode under a blow.
#[derive(Clone, Debug, Default)]
pub(crate) struct Reaches {
    /// λ, 1/s².
    eigenvalues: Vec<f32>,
    /// √λ, 1/s.
    frequencies: Vec<f32>,
    /// Number of modes that are followed through time.
    followed: usize,
}

impl Reaches {
    pub(crate) fn new(basis: &ModalBasis) -> Self {
        Self {
            eigenvalues: basis.eigenvalues.iter().map(|&l| l as f32).collect(),
            frequencies: basis.eigenvalues.iter().map(|l| l.sqrt() as f32).collect(),
            followed: basis.followed(),
        }
    }

    /// √λ of the highest mode, 1/s; 0 without modes.
    pub(crate) fn highest(&self) -> f32 {
        self.frequencies.last().copied().unwrap_or(0.0)
    }

    /// Largest |q| of a mode at any time under a blow of unit impulse, whatever its course, whose force is at most `force` (N per
    /// N·s), m·√kg per N·s/√kg.
    #[inline(always)]
    pub(crate) fn most(&self, mode: usize, force: f32) -> f32 {
        if mode < self.followed {
            1.0 / self.frequencies[mode]
        } else {
            force / self.eigenvalues[mode]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modal::Oscillator;

    #[test]
    fn no_mode_moves_farther_than_its_reach() {
        const SAMPLES: usize = 400;
        let mut tightest = f64::INFINITY;
        let u = 2000.0;
        for ratio in (0..60).map(|k| 1.12_f64.powi(k)) {
            for share in [0.0, 1e-3, 0.1, 0.5, 1.0, 2.0, 30.0] {
                let frequency = 20.0 * ratio;
                let bounds = Reaches::new(&ModalBasis {
                    eigenvalues: vec![frequency * frequency],
                    ..ModalBasis::default()
                });
                let most = f64::from(bounds.most(0, 0.0));
                let step = std::f64::consts::PI / u / SAMPLES as f64;
                let damping = 2.0 * share * frequency;
                let mut mode = Oscillator::new(frequency * frequency, damping, u, step);
                for k in 1..=2 * SAMPLES {
                    mode.step(k <= SAMPLES);
                    // As far as its energy could still take it.
                    let q = 0.5 * u * (2.0 * mode.energy()).sqrt() / frequency;
                    assert!(q <= most * (1.0 + 1e-5), "ω {frequency} share {share}: {q}");
                    tightest = tightest.min(most / q);
                }
            }
        }
        assert!(tightest < 1.02, "{tightest}");
    }
}
