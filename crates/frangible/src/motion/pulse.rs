//! Half-sine force pulse of a given impulse, and its time steps `[G12 Eq. 3-5]`.

use std::f64::consts::PI;

/// A half-sine pulse of unit impulse and the time steps of the response.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pulse {
    /// Duration t_d, s.
    pub duration: f64,
    /// Amplitude of the pulse of unit impulse, π/(2 t_d), 1/s; the peak force is this times the impulse.
    pub amplitude: f64,
    /// Time step Δt, s; the contact is a whole number of steps.
    pub time_step: f64,
    /// Number of steps in the contact.
    pub contact_steps: usize,
    /// Total number of steps.
    pub total_steps: usize,
    /// Longest step that resolves the oscillation of the modes, s; sufficient after the contact.
    pub longest_step: f64,
}

impl Pulse {
    /// Returns the pulse frequency u = π/t_d, rad/s.
    #[must_use]
    pub fn frequency(&self) -> f64 {
        PI / self.duration
    }
}
