//! One mode under a half-sine force pulse, stepped exactly.
//!
//! It is a damped oscillator `q̈ + d q̇ + λ q = ξ a sin(u t)`, from rest, until the pulse ends;
//! free after that. With the state `(ω q, q̇, sin ut, cos ut)` both are linear systems with constant
//! coefficients, so one 4 × 4 matrix exponential per mode steps them exactly, for any Δt, whatever the
//! damping (under, critical, over), and at resonance (u² = λ) where the textbook quotient is 0/0.

use super::step::Step;

/// Steps the unit response (ξ a = 1) of one mode; multiply by ξ a.
#[derive(Clone, Copy, Debug)]
pub struct Oscillator {
    pub(crate) frequency: f64,
    pub(crate) forced: Step,
    pub(crate) free: Step,
    state: [f64; 4],
}

impl Oscillator {
    /// Creates an oscillator at rest with eigenvalue λ (1/s²), damping d (1/s), pulse frequency u (rad/s) and time step Δt (s).
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

    /// Advances by one step Δt, with the pulse acting if `forced`, free otherwise.
    pub fn step(&mut self, forced: bool) {
        let step = if forced { &self.forced } else { &self.free };
        self.state = step.times(self.state);
    }

    /// Returns the row-major transition matrix of a step under the pulse. For a free step the upper right quarter is zero.
    #[must_use]
    pub fn step_matrix(&self) -> [[f64; 4]; 4] {
        let Step { own, force, turn } = self.forced;
        std::array::from_fn(|i| match i {
            0 | 1 => [own[i][0], own[i][1], force[i][0], force[i][1]],
            _ => [0.0, 0.0, turn[i - 2][0], turn[i - 2][1]],
        })
    }

    /// Returns the displacement q, in m·√kg per N/√kg of modal force.
    #[must_use]
    pub fn displacement(&self) -> f64 {
        self.state[0] / self.frequency
    }

    /// Returns the velocity q̇.
    #[must_use]
    pub fn velocity(&self) -> f64 {
        self.state[1]
    }

    /// Returns the strain energy ½ λ q².
    #[must_use]
    pub fn strain_energy(&self) -> f64 {
        0.5 * self.state[0] * self.state[0]
    }

    /// Returns the total energy ½ (q̇² + λ q²).
    #[must_use]
    pub fn energy(&self) -> f64 {
        0.5 * (self.state[0] * self.state[0] + self.state[1] * self.state[1])
    }
}
