//! Checks that a contact puts no more energy into the modes than it has.

use std::f64::consts::PI;

use super::{ModalBasis, Oscillator};
use crate::material::Material;

/// Rounding of the bounds and of the energies, relative: where they are closer to the budget the energies decide.
const ROUNDING: f64 = 1e-9;

/// Numbers of one mode that its energy depends on.
#[derive(Clone, Copy, Debug)]
struct Mode {
    /// λ, 1/s².
    eigenvalue: f64,
    /// √λ, 1/s.
    frequency: f64,
    /// d, 1/s.
    damping: f64,
    /// Modal impulse, N·s/√kg.
    impulse: f64,
}

/// Modal energy Σ ½ (q̇² + λ q²) that a contact puts into the modes, for any duration.
pub(crate) struct ContactEnergy {
    modes: Vec<Mode>,
}

impl ContactEnergy {
    /// The energy of a contact with modal impulses `load`, N·s/√kg.
    pub(crate) fn new(basis: &ModalBasis, material: &Material, load: &[f64]) -> Self {
        let mode = |(i, &impulse): (usize, &f64)| Mode {
            eigenvalue: basis.eigenvalues[i],
            frequency: basis.eigenvalues[i].sqrt(),
            damping: basis.damping(i, material),
            impulse,
        };
        Self {
            modes: load.iter().enumerate().map(mode).collect(),
        }
    }

    /// Returns true if it stays at or below `budget`, J, over a contact of this duration, s.
    pub(crate) fn is_within(&self, duration: f64, budget: f64) -> bool {
        let (low, high) = self.bounds(PI / duration);
        if high < budget * (1.0 - ROUNDING) {
            return true;
        }
        low <= budget * (1.0 + ROUNDING) && self.samples_are_within(duration, budget)
    }

    /// The energy at the middle of the contact is at least the first, J, and never more than the second.
    ///
    /// The size √(q̇² + λ q²) of a mode's motion is at most 1 after a unit impulse (`bounds/reach.rs`). Where λ > u², the motion is
    /// c sin(ut), c = ½ u/(λ − u²), of size c √λ at most, and a rest of size c (u + 2d) at most. In the middle, where sin(ut) = 1, its
    /// size is at least the difference of the two.
    fn bounds(&self, u: f64) -> (f64, f64) {
        let (mut low, mut high) = (0.0, 0.0);
        for mode in &self.modes {
            let rest = u + 2.0 * mode.damping;
            let stiffer = mode.eigenvalue - u * u;
            let c = if stiffer > 0.0 {
                0.5 * u / stiffer
            } else {
                0.0
            };
            let most = if stiffer > 0.0 {
                (c * (mode.frequency + rest)).min(1.0)
            } else {
                1.0
            };
            let least = (c * (mode.frequency - rest)).max(0.0);
            let size = 0.5 * mode.impulse * mode.impulse;
            low += size * least * least;
            high += size * most * most;
        }
        (low, high)
    }

    /// Returns true if the energy is within the budget, J, at samples over the contact.
    fn samples_are_within(&self, duration: f64, budget: f64) -> bool {
        // The energy is evaluated exactly at the samples; 40 of them find its peak to a few per mille.
        const SAMPLES: usize = 40;
        let u = PI / duration;
        let amplitude = u / 2.0;
        // Modes that hold most come first, so that most durations that bring in too much are known by a few of them.
        let most = |i: usize| {
            let lambda = self.modes[i].eigenvalue;
            let impulse = self.modes[i].impulse.abs();
            impulse * (1.0 / lambda.sqrt()).min(1.77 * amplitude / lambda) * lambda.sqrt()
        };
        let mut order: Vec<(f64, usize)> = (0..self.modes.len()).map(|i| (most(i), i)).collect();
        order.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let mut energy = [0.0; SAMPLES];
        for (_, i) in order {
            let mode = &self.modes[i];
            let force = mode.impulse * amplitude;
            let step = duration / SAMPLES as f64;
            let mut oscillator = Oscillator::new(mode.eigenvalue, mode.damping, u, step);
            for e in &mut energy {
                oscillator.step(true);
                *e += oscillator.energy() * force * force;
            }
            if energy.iter().any(|&e| e > budget) {
                return false;
            }
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn contact(k: u32) -> ContactEnergy {
        // Numbers in 0..1 without a pattern.
        let number = |i: u32| f64::from((k * 7919 + i * 104_729) % 1009) / 1009.0;
        let modes = (0..20).map(|i| {
            let frequency = 3e3 * 1.2_f64.powi(i as i32);
            Mode {
                eigenvalue: frequency * frequency,
                frequency,
                damping: 2.0 * frequency * number(k).powi(6) * 1.5,
                impulse: number(i + 1) - 0.5,
            }
        });
        ContactEnergy {
            modes: modes.collect(),
        }
    }

    #[test]
    fn bounds_answer_as_the_samples_do() {
        let (mut by_bounds, mut within) = (0, 0);
        for k in 0..30 {
            let contact = contact(k);
            for duration in (0..60).map(|i| 2e-5 * 1.1_f64.powi(i)) {
                for budget in [1e-5, 1e-3, 0.1, 0.5, 1.0, 2.0] {
                    let slow = contact.samples_are_within(duration, budget);
                    let (low, high) = contact.bounds(PI / duration);
                    assert!(low <= high);
                    assert_eq!(contact.is_within(duration, budget), slow);
                    by_bounds += usize::from(low > budget || high < budget);
                    within += usize::from(slow);
                }
            }
        }
        assert!(
            by_bounds > 3000 && (1000..9800).contains(&within),
            "{by_bounds} {within}"
        );
    }
}
