//! Exact response of the modes to a half-sine force pulse.
//!
//! Each mode is one damped oscillator `q̈ + d q̇ + λ q = ξ a sin(u t)`, from rest, until the pulse ends;
//! free after that. With the state `(ω q, q̇, sin ut, cos ut)` both are linear systems with constant
//! coefficients, so one 4 × 4 matrix exponential per mode steps them exactly, for any Δt, whatever the
//! damping (under, critical, over), and at resonance (u² = λ) where the textbook quotient is 0/0.
//! Changes versus `[G12 §4.3]`: the motion goes on after the contact, where the stress often peaks.

use super::ModalBasis;
use super::step::Step;
use crate::blow::Complement;
use crate::contact::Pulse;
use crate::material::Material;

/// Steps the unit response (ξ a = 1) of one mode; multiply by ξ a.
#[derive(Clone, Copy, Debug)]
pub struct Oscillator {
    frequency: f64,
    forced: Step,
    free: Step,
    state: [f64; 4],
}

impl Oscillator {
    /// At rest, with eigenvalue λ (1/s²), damping d (1/s), pulse frequency u (rad/s), step Δt (s).
    #[must_use]
    pub fn new(eigenvalue: f64, damping: f64, pulse_frequency: f64, time_step: f64) -> Self {
        let (w, d, u) = (eigenvalue.sqrt(), damping, pulse_frequency);
        let scale = |a: f64| a * time_step;
        let forced = Step {
            own: [[0.0, scale(w)], [scale(-w), scale(-d)]],
            force: [[0.0, 0.0], [scale(1.0), 0.0]],
            turn: [[0.0, scale(u)], [scale(-u), 0.0]],
        };
        Self {
            frequency: w,
            forced: forced.exponential(),
            free: Step {
                force: [[0.0; 2]; 2],
                ..forced
            }
            .exponential(),
            state: [0.0, 0.0, 0.0, 1.0],
        }
    }

    /// One step Δt further, under the pulse or free of it.
    pub fn step(&mut self, forced: bool) {
        let step = if forced { &self.forced } else { &self.free };
        self.state = step.times(self.state);
    }

    /// What a step multiplies the state with, under the pulse; free of it the entries `[1][2]` and those that follow
    /// from it, the upper right quarter, are zero. Row-major.
    #[must_use]
    pub fn step_matrix(&self) -> [[f64; 4]; 4] {
        let Step { own, force, turn } = self.forced;
        std::array::from_fn(|i| match i {
            0 | 1 => [own[i][0], own[i][1], force[i][0], force[i][1]],
            _ => [0.0, 0.0, turn[i - 2][0], turn[i - 2][1]],
        })
    }

    /// Displacement q, in m·√kg per N/√kg of modal force.
    #[must_use]
    pub fn displacement(&self) -> f64 {
        self.state[0] / self.frequency
    }

    /// Velocity q̇.
    #[must_use]
    pub fn velocity(&self) -> f64 {
        self.state[1]
    }

    /// Strain energy ½ λ q².
    #[must_use]
    pub fn strain_energy(&self) -> f64 {
        0.5 * self.state[0] * self.state[0]
    }

    /// Energy ½ (q̇² + λ q²).
    #[must_use]
    pub fn energy(&self) -> f64 {
        0.5 * (self.state[0] * self.state[0] + self.state[1] * self.state[1])
    }
}

/// Modal amplitudes over time, time-major: `amplitudes[step * modes + mode]`, m·√kg.
#[derive(Clone, Debug, Default)]
pub struct Motion {
    /// Amplitudes q of every mode at t = Δt, 2 Δt, …
    pub amplitudes: Vec<f32>,
    /// Number of modes.
    pub modes: usize,
    /// Largest Σ ½ (q̇² + λ q²) at a step, J.
    pub peak_energy: f64,
    /// Largest strain energy Σ ½ λ q² at a step, J.
    pub peak_strain_energy: f64,
    /// Largest strain energy until the end of each step, J; empty where only the largest of all is known.
    pub(crate) strain_energy: Vec<f64>,
    /// What the modes leave out.
    pub(crate) complement: Complement,
    /// From this step on steps are longer, by this factor: after a blow only the modes swing.
    pub(crate) coarse: Option<(usize, f64)>,
}

impl Motion {
    /// A motion that comes from elsewhere: amplitudes of the first `modes` modes, step after step, m·√kg, and its largest energy
    /// and strain energy, J.
    #[must_use]
    pub fn new(
        amplitudes: Vec<f32>,
        modes: usize,
        peak_energy: f64,
        peak_strain_energy: f64,
    ) -> Self {
        Self {
            amplitudes,
            modes,
            peak_energy,
            peak_strain_energy,
            strain_energy: Vec::new(),
            complement: Complement::default(),
            coarse: None,
        }
    }

    /// Number of time steps.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.amplitudes.len().checked_div(self.modes).unwrap_or(0)
    }

    /// The largest strain energy until the end of a step, J: what cracks may have spent by then. Where that was not followed, the largest
    /// of all steps.
    pub(crate) fn strain_energy_until(&self, step: usize) -> f64 {
        let known = self.strain_energy.get(step).copied();
        known.unwrap_or(self.peak_strain_energy)
    }

    /// When a step begins, s, where the first are so long, s: steps after a blow are longer.
    #[must_use]
    pub fn begin(&self, step: usize, time_step: f64) -> f64 {
        match self.coarse {
            Some((first, factor)) if step > first => {
                (first as f64 + (step - first) as f64 * factor) * time_step
            }
            _ => step as f64 * time_step,
        }
    }

    /// The step in which a time, s, lies, where the first steps are so long, s; the last one for later times, none without steps.
    #[must_use]
    pub fn step_at(&self, time: f64, time_step: f64) -> Option<usize> {
        let last = self.steps().checked_sub(1)?;
        let at = time / time_step;
        let step = match self.coarse {
            Some((first, factor)) if at > first as f64 => {
                first as f64 + (at - first as f64) / factor
            }
            _ => at,
        };
        Some((step.max(0.0) as usize).min(last))
    }

    /// Amplitudes of all modes at a step, m·√kg.
    #[must_use]
    pub fn at(&self, step: usize) -> &[f32] {
        &self.amplitudes[step * self.modes..(step + 1) * self.modes]
    }
}

/// Response of the followed modes to `pulse` with load shape ξ, computed in f64, stored in f32 `[G12 §4.3]`.
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
        // With the widest vectors that this processor has; the same operations in the same order, so the same bits.
        pulp::Arch::new().dispatch(Respond {
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
    /// How many modes there are in all.
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

impl pulp::NullaryFnOnce for Respond<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
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
