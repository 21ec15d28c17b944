//! How far a half-sine pulse moves a mode at most, whenever: what stress bounds need that follow no time.
//!
//! From rest, q̈ + d q̇ + λ q = ½ u sin(ut) for 0 ≤ t ≤ π/u, a pulse of unit impulse; free after that. With
//! w = √(q̇² + λ q²) any force f gives ẇ ≤ |f|, damped or not, and √λ |q| ≤ w. Hence
//! - √λ |q| ≤ ∫ f dt = 1, always;
//! - where λ > u², with c = ½ u/(λ − u²), the rest e = q − c sin(ut) obeys ë + d ė + λ e = −c d u cos(ut), e(0) = 0,
//!   ė(0) = −c u. So √λ |e| ≤ c (u + 2d) during the pulse, and √λ |q| ≤ 2c (u + d) after it.
//!
//! All of these grow with u: a longer pulse of the same impulse moves a mode less.

use super::ModalBasis;
use crate::material::Material;

/// What the bounds need of each mode.
#[derive(Clone, Debug, Default)]
pub(crate) struct Reaches {
    /// λ, 1/s².
    eigenvalues: Vec<f32>,
    /// √λ, 1/s.
    frequencies: Vec<f32>,
    /// d, 1/s.
    dampings: Vec<f32>,
}

/// The motion of a mode under a pulse of unit impulse as one that follows the force and a rest, m·√kg per N·s/√kg.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Split {
    /// c of c sin(ut), the part that follows the force during the pulse; 0 where nothing is gained by the split.
    pub(crate) following: f32,
    /// Most of |q − c sin(ut)| during the pulse …
    pub(crate) rest: f32,
    /// … and of |q| after it.
    pub(crate) after: f32,
}

impl Reaches {
    pub(crate) fn new(basis: &ModalBasis, material: &Material) -> Self {
        let modes = 0..basis.count();
        Self {
            eigenvalues: basis.eigenvalues.iter().map(|&l| l as f32).collect(),
            frequencies: basis.eigenvalues.iter().map(|l| l.sqrt() as f32).collect(),
            dampings: modes.map(|i| basis.damping(i, material) as f32).collect(),
        }
    }

    /// √λ of the highest mode, 1/s; 0 without modes.
    pub(crate) fn highest(&self) -> f32 {
        self.frequencies.last().copied().unwrap_or(0.0)
    }

    /// Most of |q| of a mode at any time under a pulse of unit impulse and frequency u = π/t_d, rad/s, m·√kg per N·s/√kg;
    /// infinite u asks for no duration.
    #[inline(always)]
    pub(crate) fn most(&self, mode: usize, u: f32) -> f32 {
        let (l, w, d) = (
            self.eigenvalues[mode],
            self.frequencies[mode],
            self.dampings[mode],
        );
        let stiffer = l - u * u;
        let most = 0.5 * u * (w + u + 2.0 * d);
        // Without a branch, so that a loop over the modes turns into vector instructions; a NaN of infinite u is none.
        let share = if stiffer > most { most / stiffer } else { 1.0 };
        share / w
    }

    /// The same in parts.
    pub(crate) fn split(&self, mode: usize, u: f32) -> Split {
        let (l, w, d) = (
            self.eigenvalues[mode],
            self.frequencies[mode],
            self.dampings[mode],
        );
        let most = self.most(mode, u);
        let following = 0.5 * u / (l - u * u);
        let rest = following * (u + 2.0 * d) / w;
        if l > u * u && rest < most {
            Split {
                following,
                rest,
                after: most.min(2.0 * following * (u + d) / w),
            }
        } else {
            Split {
                following: 0.0,
                rest: most,
                after: most,
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modal::Oscillator;

    /// Samples of the pulse and of as long after it.
    const SAMPLES: usize = 400;

    fn reaches(eigenvalue: f64, damping: f64) -> Reaches {
        Reaches {
            eigenvalues: vec![eigenvalue as f32],
            frequencies: vec![eigenvalue.sqrt() as f32],
            dampings: vec![damping as f32],
        }
    }

    /// From far softer than the pulse to far stiffer, from no damping to far beyond the critical.
    fn cases() -> impl Iterator<Item = (f64, f64, f64)> {
        let times = |count: i32, factor: f64| (0..count).map(move |k| factor.powi(k));
        times(60, 1.12).flat_map(move |ratio| {
            [0.0, 1e-3, 0.1, 0.5, 1.0, 2.0, 30.0].map(|share| {
                let (u, frequency) = (2000.0, 200.0 * ratio);
                (frequency * frequency, 2.0 * share * frequency, u)
            })
        })
    }

    #[test]
    fn no_mode_moves_farther_than_its_reach() {
        let mut tightest = f64::INFINITY;
        for (eigenvalue, damping, u) in cases() {
            let bounds = reaches(eigenvalue, damping);
            let most = f64::from(bounds.most(0, u as f32));
            let split = bounds.split(0, u as f32);
            let step = std::f64::consts::PI / u / SAMPLES as f64;
            let mut mode = Oscillator::new(eigenvalue, damping, u, step);
            let mut largest: f64 = 0.0;
            for k in 1..=2 * SAMPLES {
                mode.step(k <= SAMPLES);
                let q = 0.5 * u * mode.displacement();
                largest = largest.max(q.abs());
                let case = format!("λ {eigenvalue} d {damping} u {u}, sample {k}");
                assert!(q.abs() <= most * (1.0 + 1e-5), "{case}: {q} {most}");
                if k <= SAMPLES {
                    let follows = f64::from(split.following) * (k as f64 * step * u).sin();
                    let rest = (q - follows).abs();
                    let room = 1e-6 * most;
                    assert!(rest <= f64::from(split.rest) + room, "{case}: {rest}");
                } else {
                    assert!(q.abs() <= f64::from(split.after) * (1.0 + 1e-5), "{case}");
                }
            }
            tightest = tightest.min(most / largest);
        }
        assert!(tightest < 1.02, "{tightest}");
    }

    #[test]
    fn a_longer_pulse_moves_a_mode_less_and_none_knows_no_duration() {
        for (eigenvalue, damping, u) in cases() {
            let bounds = reaches(eigenvalue, damping);
            let most = |u: f32| bounds.most(0, u);
            assert!(most(0.9 * u as f32) <= most(u as f32) * (1.0 + 1e-6));
            let free = 1.0 / eigenvalue.sqrt() as f32;
            assert!((most(f32::INFINITY) / free - 1.0).abs() < 1e-6);
        }
    }
}
