//! The modal response as the GPU steps it: matrices per mode, and states to restart from.

use frangible::modal::Oscillator;
use frangible::{Asset, Vibration};

use crate::passes::COLUMNS;

/// Words of a mode's matrix: as the shader's `Mode`.
pub(crate) const MATRIX: usize = 12;

/// Words of a state.
pub(crate) const STATE: usize = 4;

type Matrix4 = [[f64; 4]; 4];

/// What the GPU needs for the response of all modes to one impact.
#[derive(Clone, Debug)]
pub(crate) struct Response {
    /// [`MATRIX`] numbers per mode.
    pub(crate) matrices: Vec<f32>,
    /// [`STATE`] numbers per restart and mode; restarts are [`COLUMNS`] steps apart.
    pub(crate) restarts: Vec<f32>,
}

impl Response {
    /// In f64, stored in f32.
    pub(crate) fn new(asset: &Asset, vibration: &Vibration) -> Self {
        let (basis, pulse) = (&asset.modes, &vibration.pulse);
        let modes = basis.count();
        let blocks = pulse.total_steps.div_ceil(COLUMNS);
        let mut matrices = Vec::with_capacity(MATRIX * modes);
        let mut restarts = vec![0.0; STATE * modes * blocks];
        for i in 0..modes {
            let (eigenvalue, damping) = (basis.eigenvalues[i], basis.damping(i, &asset.material));
            let oscillator =
                Oscillator::new(eigenvalue, damping, pulse.frequency(), pulse.time_step);
            let step = *oscillator.step_matrix();
            let scale = vibration.modal_impulse[i] * pulse.amplitude / eigenvalue.sqrt();
            let numbers = [step[0], step[1], [step[2][2], step[2][3], scale, 0.0]];
            matrices.extend(numbers.as_flattened().iter().map(|&x| x as f32));
            let block = power_of_two(&step, COLUMNS.ilog2());
            let mut state = [0.0, 0.0, 0.0, 1.0];
            for b in 0..blocks {
                let at = STATE * (b * modes + i);
                for (out, x) in restarts[at..at + STATE].iter_mut().zip(state) {
                    *out = x as f32;
                }
                let forced = pulse.contact_steps.saturating_sub(b * COLUMNS).min(COLUMNS);
                state = match forced {
                    COLUMNS => times(&block, &state),
                    0 => free(&block, &state),
                    _ => {
                        let end = (0..forced).fold(state, |s, _| times(&step, &s));
                        (forced..COLUMNS).fold(end, |s, _| free(&step, &s))
                    }
                };
            }
        }
        Self { matrices, restarts }
    }
}

fn times(a: &Matrix4, s: &[f64; 4]) -> [f64; 4] {
    std::array::from_fn(|i| (0..4).map(|j| a[i][j] * s[j]).sum())
}

/// A step without the pulse: displacement and velocity do not feel the other half of the state.
fn free(a: &Matrix4, s: &[f64; 4]) -> [f64; 4] {
    times(a, &[s[0], s[1], 0.0, 0.0])
}

/// A to the power 2ⁿ.
fn power_of_two(a: &Matrix4, n: u32) -> Matrix4 {
    (0..n).fold(*a, |a, _| {
        std::array::from_fn(|i| {
            std::array::from_fn(|j| (0..4).map(|k| a[i][k] * a[k][j]).sum::<f64>())
        })
    })
}
