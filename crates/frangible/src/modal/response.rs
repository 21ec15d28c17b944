//! Exact response of the modes to a half-sine force pulse.
//!
//! Each mode is one damped oscillator `q̈ + d q̇ + λ q = ξ a sin(u t)`, from rest, until the pulse ends;
//! free after that. With the state `(ω q, q̇, sin ut, cos ut)` both are linear systems with constant
//! coefficients, so one 4 × 4 matrix exponential per mode steps them exactly, for any Δt, whatever the
//! damping (under, critical, over), and at resonance (u² = λ) where the textbook quotient is 0/0.
//! Changes versus `[G12 §4.3]`: the motion goes on after the contact, where the stress often peaks.

use super::ModalBasis;
use crate::contact::Pulse;
use crate::material::Material;

type Matrix4 = [[f64; 4]; 4];

/// Steps the unit response (ξ a = 1) of one mode; multiply by ξ a.
#[derive(Clone, Copy, Debug)]
pub struct Oscillator {
    frequency: f64,
    forced: Matrix4,
    free: Matrix4,
    state: [f64; 4],
}

impl Oscillator {
    /// At rest, with eigenvalue λ (1/s²), damping d (1/s), pulse frequency u (rad/s), step Δt (s).
    #[must_use]
    pub fn new(eigenvalue: f64, damping: f64, pulse_frequency: f64, time_step: f64) -> Self {
        let (w, d, u) = (eigenvalue.sqrt(), damping, pulse_frequency);
        let scale = |a: f64| a * time_step;
        let forced = [
            [0.0, scale(w), 0.0, 0.0],
            [scale(-w), scale(-d), scale(1.0), 0.0],
            [0.0, 0.0, 0.0, scale(u)],
            [0.0, 0.0, scale(-u), 0.0],
        ];
        let mut free = forced;
        free[1][2] = 0.0;
        Self {
            frequency: w,
            forced: exponential(&forced),
            free: exponential(&free),
            state: [0.0, 0.0, 0.0, 1.0],
        }
    }

    /// One step Δt further, under the pulse or free of it.
    pub fn step(&mut self, forced: bool) {
        let a = if forced { &self.forced } else { &self.free };
        self.state = std::array::from_fn(|i| (0..4).map(|j| a[i][j] * self.state[j]).sum());
    }

    /// What a step multiplies the state with, under the pulse; free of it the entries `[1][2]` and those that follow
    /// from it, the upper right quarter, are zero. Row-major.
    #[must_use]
    pub fn step_matrix(&self) -> &[[f64; 4]; 4] {
        &self.forced
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

fn product(a: &Matrix4, b: &Matrix4) -> Matrix4 {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..4).map(|k| a[i][k] * b[k][j]).sum()))
}

/// Matrix exponential by scaling, a Taylor series of order 13 (remainder below 1e-15 at norm ½), squaring.
pub(super) fn exponential(a: &Matrix4) -> Matrix4 {
    let norm = a
        .iter()
        .map(|row| row.iter().map(|x| x.abs()).sum::<f64>())
        .fold(0.0, f64::max);
    let squarings = if norm > 0.5 {
        (norm / 0.5).log2().ceil() as i32
    } else {
        0
    };
    let scaled = a.map(|row| row.map(|x| x * 0.5_f64.powi(squarings)));
    let mut sum: Matrix4 =
        std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j))));
    let mut term = sum;
    for k in 1..=13 {
        term = product(&term, &scaled).map(|row| row.map(|x| x / f64::from(k)));
        for (row, t) in sum.iter_mut().zip(&term) {
            for (x, y) in row.iter_mut().zip(t) {
                *x += y;
            }
        }
    }
    for _ in 0..squarings {
        sum = product(&sum, &sum);
    }
    sum
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
}

impl Motion {
    /// Number of time steps.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.amplitudes.len().checked_div(self.modes).unwrap_or(0)
    }

    /// Amplitudes of all modes at a step, m·√kg.
    #[must_use]
    pub fn at(&self, step: usize) -> &[f32] {
        &self.amplitudes[step * self.modes..(step + 1) * self.modes]
    }
}

/// Response of all modes to `pulse` with load shape ξ, computed in f64, stored in f32 `[G12 §4.3]`.
#[must_use]
pub fn respond(basis: &ModalBasis, material: &Material, load: &[f64], pulse: &Pulse) -> Motion {
    let modes = basis.count();
    let steps = pulse.total_steps;
    let mut amplitudes = vec![0.0_f32; steps * modes];
    let mut energy = vec![0.0_f64; steps];
    let mut strain_energy = vec![0.0_f64; steps];
    for i in 0..modes {
        let force = load[i] * pulse.amplitude;
        let mut mode = Oscillator::new(
            basis.eigenvalues[i],
            basis.damping(i, material),
            pulse.frequency(),
            pulse.time_step,
        );
        for k in 0..steps {
            mode.step(k < pulse.contact_steps);
            amplitudes[k * modes + i] = (mode.displacement() * force) as f32;
            energy[k] += mode.energy() * force * force;
            strain_energy[k] += mode.strain_energy() * force * force;
        }
    }
    Motion {
        amplitudes,
        modes,
        peak_energy: energy.into_iter().fold(0.0, f64::max),
        peak_strain_energy: strain_energy.into_iter().fold(0.0, f64::max),
    }
}

/// Whether the modal energy Σ ½ (q̇² + λ q²) stays at or below `budget`, J, over a contact of this duration, s, with modal
/// impulses `load`, N·s/√kg.
#[must_use]
pub fn contact_energy_within(
    basis: &ModalBasis,
    material: &Material,
    load: &[f64],
    duration: f64,
    budget: f64,
) -> bool {
    // The energy is evaluated exactly at the samples; 40 of them find its peak to a few per mille.
    const SAMPLES: usize = 40;
    let u = std::f64::consts::PI / duration;
    let amplitude = u / 2.0;
    // Modes that hold most come first, so that most durations that bring in too much are known by a few of them.
    let most = |i: usize| {
        let lambda = basis.eigenvalues[i];
        load[i].abs() * (1.0 / lambda.sqrt()).min(1.77 * amplitude / lambda) * lambda.sqrt()
    };
    let mut order: Vec<(f64, usize)> = (0..basis.count()).map(|i| (most(i), i)).collect();
    order.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let mut energy = [0.0; SAMPLES];
    for (_, i) in order {
        let force = load[i] * amplitude;
        let mut mode = Oscillator::new(
            basis.eigenvalues[i],
            basis.damping(i, material),
            u,
            duration / SAMPLES as f64,
        );
        for e in &mut energy {
            mode.step(true);
            *e += mode.energy() * force * force;
        }
        if energy.iter().any(|&e| e > budget) {
            return false;
        }
    }
    true
}
