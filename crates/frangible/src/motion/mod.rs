//! Motion of a body under a load: modal amplitudes over time, corrections for omitted modes, and displacements of points.

mod complement;
mod displacement;
mod moment;
mod pulse;
mod response;

pub(crate) use complement::{Complement, Residual};
pub use displacement::DisplacementBatch;
pub(crate) use moment::Moment;
pub use pulse::Pulse;
pub use response::respond;

/// Modal amplitudes over time, time-major: `amplitudes[step * modes + mode]`, m·√kg.
#[derive(Clone, Debug, Default)]
pub struct Motion {
    /// Amplitudes q of every mode at the end of each time step.
    pub amplitudes: Vec<f32>,
    /// Number of modes.
    pub modes: usize,
    /// Largest Σ ½ (q̇² + λ q²) at a step, J.
    pub peak_energy: f64,
    /// Largest strain energy Σ ½ λ q² at a step, J.
    pub peak_strain_energy: f64,
    /// Largest strain energy until the end of each step, J; empty where only the largest of all is known.
    pub(crate) strain_energy: Vec<f64>,
    /// Parts that the modes leave out.
    pub(crate) complement: Complement,
    /// From this step on steps are longer, by this factor: after a blow only the modes swing.
    pub(crate) coarse: Option<(usize, f64)>,
}

impl Motion {
    /// Creates a prescribed motion from the amplitudes of the first `modes` modes, m·√kg, time-major, and its peak energy and peak
    /// strain energy, J.
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

    /// Records the energy at the end of one more step, and the strain energy in it, J.
    pub(crate) fn take_energies(&mut self, energy: f64, strain_energy: f64) {
        self.peak_energy = self.peak_energy.max(energy);
        self.peak_strain_energy = self.peak_strain_energy.max(strain_energy);
        self.strain_energy.push(self.peak_strain_energy);
    }

    /// Forgets all steps but the first so many, whose largest energy was this, J.
    pub(crate) fn keep(&mut self, steps: usize, peak_energy: f64) {
        self.amplitudes.truncate(steps * self.modes);
        self.strain_energy.truncate(steps);
        self.peak_energy = peak_energy;
        self.peak_strain_energy = self.strain_energy.last().copied().unwrap_or(0.0);
    }

    /// Returns the number of time steps.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.amplitudes.len().checked_div(self.modes).unwrap_or(0)
    }

    /// Largest strain energy until the end of a step, J: the most that cracks may have spent by then. Where that was not followed, the largest
    /// of all steps.
    pub(crate) fn strain_energy_until(&self, step: usize) -> f64 {
        let known = self.strain_energy.get(step).copied();
        known.unwrap_or(self.peak_strain_energy)
    }

    /// Returns the start time of a step, s. `time_step` is the length of the first steps, s; steps after the contact are longer.
    #[must_use]
    pub fn begin(&self, step: usize, time_step: f64) -> f64 {
        match self.coarse {
            Some((first, factor)) if step > first => {
                (first as f64 + (step - first) as f64 * factor) * time_step
            }
            _ => step as f64 * time_step,
        }
    }

    /// Returns the step that contains a time, s, or the last step for later times; `None` for a motion without steps. `time_step` is the
    /// length of the first steps, s.
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

    /// Returns the amplitudes of all modes at a step, m·√kg.
    #[must_use]
    pub fn at(&self, step: usize) -> &[f32] {
        &self.amplitudes[step * self.modes..(step + 1) * self.modes]
    }
}
