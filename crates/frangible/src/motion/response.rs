//! Exact response of the modes to a half-sine force pulse.
//!
//! Unlike `[G12 §4.3]`, the motion is computed beyond the end of the contact, where the stress often peaks.

use super::{Complement, Motion, Pulse};
use crate::material::Material;
use crate::modal::{ModalBasis, Oscillator};

/// Computes the response of the integrated modes to `pulse` with load shape ξ in f64, stored in f32 `[G12 §4.3]`.
#[must_use]
pub fn respond(basis: &ModalBasis, material: &Material, load: &[f64], pulse: &Pulse) -> Motion {
    let (modes, steps) = (basis.followed(), pulse.total_steps);
    let mut amplitudes = vec![0.0_f32; steps * modes];
    let mut energy = vec![[0.0_f64; 2]; steps];
    for first in (0..modes).step_by(WIDTH) {
        let some: Vec<(Oscillator, f64)> = (first..(first + WIDTH).min(modes))
            .map(|i| {
                let damping = basis.damping(i, material);
                let (u, step) = (pulse.frequency(), pulse.time_step);
                let mode = Oscillator::new(basis.eigenvalues[i], damping, u, step);
                (mode, load[i] * pulse.amplitude)
            })
            .collect();
        run(Respond {
            some: &some,
            first,
            modes,
            forced_steps: pulse.contact_steps,
            amplitudes: &mut amplitudes,
            energy: &mut energy,
        });
    }
    let peak = |k: usize| energy.iter().map(|e| e[k]).fold(0.0, f64::max);
    Motion {
        amplitudes,
        modes,
        peak_energy: peak(0),
        peak_strain_energy: peak(1),
        strain_energy: Vec::new(),
        complement: Complement::default(),
        coarse: None,
    }
}

/// Modes that are stepped side by side.
const WIDTH: usize = 8;

/// A number of each of them.
type Lanes = [f64; WIDTH];

/// Steps a few modes side by side.
struct Respond<'a> {
    /// The modes, at most [`WIDTH`], and the force on each.
    some: &'a [(Oscillator, f64)],
    /// Number of the first.
    first: usize,
    /// Number of modes in all.
    modes: usize,
    forced_steps: usize,
    amplitudes: &'a mut [f32],
    /// Energy and strain energy of all modes at each step, J: these are added.
    energy: &'a mut [[f64; 2]],
}

impl Respond<'_> {
    /// A number of each mode; of places without a mode, the first one's.
    #[inline(always)]
    fn lanes(&self, of: impl Fn(&Oscillator) -> f64) -> Lanes {
        let mut lanes = [of(&self.some[0].0); WIDTH];
        for (lane, (mode, _)) in lanes.iter_mut().zip(self.some) {
            *lane = of(mode);
        }
        lanes
    }

    #[inline(always)]
    fn block(&self, of: impl Fn(&Oscillator) -> [[f64; 2]; 2]) -> [Lanes; 4] {
        [
            self.lanes(|m| of(m)[0][0]),
            self.lanes(|m| of(m)[0][1]),
            self.lanes(|m| of(m)[1][0]),
            self.lanes(|m| of(m)[1][1]),
        ]
    }
}

widest! {
    fn run(respond: Respond<'_>) {
        respond.run();
    }
}

impl Respond<'_> {
    #[inline(always)]
    fn run(self) {
        let blocks = [
            [
                self.block(|m| m.forced.own),
                self.block(|m| m.forced.force),
                self.block(|m| m.forced.turn),
            ],
            [
                self.block(|m| m.free.own),
                self.block(|m| m.free.force),
                self.block(|m| m.free.turn),
            ],
        ];
        let frequency = self.lanes(|m| m.frequency);
        let mut force = [0.0; WIDTH];
        for (force, (_, f)) in force.iter_mut().zip(self.some) {
            *force = *f;
        }
        let (mut q, mut v, mut s, mut c) = ([0.0; WIDTH], [0.0; WIDTH], [0.0; WIDTH], [1.0; WIDTH]);
        let rows = self.amplitudes.chunks_exact_mut(self.modes);
        for ((k, row), energy) in rows.enumerate().zip(self.energy) {
            let [own, by, turn] = &blocks[usize::from(k >= self.forced_steps)];
            let (mut amplitude, mut whole, mut strain) =
                ([0.0_f32; WIDTH], [0.0; WIDTH], [0.0; WIDTH]);
            for i in 0..WIDTH {
                // As in `Step::times`.
                let [new_q, new_v, new_s, new_c] = [
                    own[0][i] * q[i] + own[1][i] * v[i] + by[0][i] * s[i] + by[1][i] * c[i],
                    own[2][i] * q[i] + own[3][i] * v[i] + by[2][i] * s[i] + by[3][i] * c[i],
                    turn[0][i] * s[i] + turn[1][i] * c[i],
                    turn[2][i] * s[i] + turn[3][i] * c[i],
                ];
                (q[i], v[i], s[i], c[i]) = (new_q, new_v, new_s, new_c);
                // As in `Oscillator`.
                amplitude[i] = (q[i] / frequency[i] * force[i]) as f32;
                whole[i] = 0.5 * (q[i] * q[i] + v[i] * v[i]) * force[i] * force[i];
                strain[i] = 0.5 * q[i] * q[i] * force[i] * force[i];
            }
            for i in 0..self.some.len() {
                row[self.first + i] = amplitude[i];
                energy[0] += whole[i];
                energy[1] += strain[i];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn modes_side_by_side_move_as_each_does_alone() {
        let material = Material::preset("glass").unwrap();
        for modes in [0, 1, 7, 8, 9, 21] {
            let basis = ModalBasis {
                eigenvalues: (0..modes)
                    .map(|i| (4e3 * 1.3_f64.powi(i)).powi(2))
                    .collect(),
                ..ModalBasis::default()
            };
            let load: Vec<f64> = (0..modes).map(|i| f64::from(i * 7 % 5) - 1.7).collect();
            let pulse = Pulse {
                duration: 1e-3,
                amplitude: std::f64::consts::FRAC_PI_2 / 1e-3,
                time_step: 1e-3 / 40.0,
                contact_steps: 40,
                total_steps: 90,
                longest_step: 1e-3,
            };
            let motion = respond(&basis, &material, &load, &pulse);
            let (mut energy, mut strain_energy) = ([0.0; 90], [0.0; 90]);
            for (i, &load) in load.iter().enumerate() {
                let force = load * pulse.amplitude;
                let damping = basis.damping(i, &material);
                let (u, step) = (pulse.frequency(), pulse.time_step);
                let mut mode = Oscillator::new(basis.eigenvalues[i], damping, u, step);
                for k in 0..90 {
                    mode.step(k < 40);
                    assert_eq!(motion.at(k)[i], (mode.displacement() * force) as f32);
                    energy[k] += mode.energy() * force * force;
                    strain_energy[k] += mode.strain_energy() * force * force;
                }
            }
            let peak = |e: &[f64]| e.iter().copied().fold(0.0, f64::max);
            assert_eq!(motion.peak_energy, peak(&energy));
            assert_eq!(motion.peak_strain_energy, peak(&strain_energy));
        }
    }
}
