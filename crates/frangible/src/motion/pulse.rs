//! The half-sine that a given impulse is put on with, and its time steps `[G12 Eq. 3-5]`.

use std::f64::consts::PI;

/// A half-sine of unit impulse and the steps at which the body is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pulse {
    /// Duration t_d, s.
    pub duration: f64,
    /// Amplitude of the pulse of unit impulse, π/(2 t_d), 1/s. Times φ it is the peak force.
    pub amplitude: f64,
    /// Time step Δt, s: a whole number of them makes the contact.
    pub time_step: f64,
    /// Steps within the contact.
    pub contact_steps: usize,
    /// Steps until the end of the computation.
    pub total_steps: usize,
    /// Longest step that shows the modes' swing, s: it would suffice after the contact.
    pub longest_step: f64,
}

impl Pulse {
    /// u = π/t_d, rad/s.
    #[must_use]
    pub fn frequency(&self) -> f64 {
        PI / self.duration
    }
}
