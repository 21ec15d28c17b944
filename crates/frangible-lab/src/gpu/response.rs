//! The modal response as the GPU steps it: matrices per mode, and states to restart from.

use frangible::Material;
use frangible::internals::contact::Pulse;
use frangible::internals::modal::{ModalBasis, Oscillator};

use super::passes::COLUMNS;

/// Words of a mode's matrix: as the shader's `Mode`.
pub(crate) const MATRIX: usize = 12;

/// Words of a state.
pub(crate) const STATE: usize = 4;

type Matrix4 = [[f64; 4]; 4];

/// Response of all modes to one impact, in the form that the GPU needs.
#[derive(Clone, Debug)]
pub(crate) struct Response {
    /// [`MATRIX`] numbers per mode.
    pub(crate) matrices: Vec<f32>,
    /// [`STATE`] numbers per restart and mode; restarts are [`COLUMNS`] steps apart.
    pub(crate) restarts: Vec<f32>,
}

impl Response {
    /// The matrices and restarts of one impact, found in f64 and stored in f32.
    pub(crate) fn new(
        basis: &ModalBasis,
        material: &Material,
        modal_impulse: &[f64],
        pulse: &Pulse,
    ) -> Self {
        let modes = basis.count();
        let blocks = pulse.total_steps.div_ceil(COLUMNS);
        let mut matrices = Vec::with_capacity(MATRIX * modes);
        let mut restarts = vec![0.0; STATE * modes * blocks];
        for i in 0..modes {
            let (eigenvalue, damping) = (basis.eigenvalues[i], basis.damping(i, material));
            let oscillator =
                Oscillator::new(eigenvalue, damping, pulse.frequency(), pulse.time_step);
            let step = oscillator.step_matrix();
            let scale = modal_impulse[i] * pulse.amplitude / eigenvalue.sqrt();
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

#[cfg(test)]
mod tests {
    use frangible::internals::modal::respond;

    use super::*;

    /// The amplitudes step by step, as `amplitudes.wgsl` computes them: every product and sum rounded to f32.
    fn stepped(response: &Response, modes: usize, pulse: &Pulse) -> Vec<f32> {
        let mut amplitudes = vec![0.0_f32; modes * pulse.total_steps];
        for mode in 0..modes {
            let m = &response.matrices[MATRIX * mode..MATRIX * (mode + 1)];
            let mut s = [0.0_f32; 4];
            for step in 0..pulse.total_steps {
                if step % COLUMNS == 0 {
                    let at = STATE * (step / COLUMNS * modes + mode);
                    s.copy_from_slice(&response.restarts[at..at + STATE]);
                }
                let turned = [m[8] * s[2] + m[9] * s[3], m[8] * s[3] - m[9] * s[2]];
                if step >= pulse.contact_steps {
                    (s[2], s[3]) = (0.0, 0.0);
                }
                let row = |r: &[f32]| r[0] * s[0] + r[1] * s[1] + r[2] * s[2] + r[3] * s[3];
                s = [row(&m[..4]), row(&m[4..8]), turned[0], turned[1]];
                amplitudes[step * modes + mode] = s[0] * m[10];
            }
        }
        amplitudes
    }

    #[test]
    fn the_response_in_f32_stays_close_to_that_in_f64() {
        let frequencies = [30.0, 200.0, 1e3, 4e3, 12e3, 30e3, 62e3, 62e3];
        let basis = ModalBasis {
            eigenvalues: frequencies
                .map(|f: f64| (std::f64::consts::TAU * f).powi(2))
                .to_vec(),
            ..ModalBasis::default()
        };
        let impulse = [1.0, -0.3, 0.02, 5.0, 1.0, 2.0, 1e-3, 0.0];
        let mut worst = 0.0_f64;
        // Undamped, of glass, strongly damped, nearly all overdamped.
        for stiffness_damping in [0.0, 1e-9, 1e-6, 1e-3] {
            // The steps of the contact end inside a block, at its end, and the motion inside one.
            for (contact_steps, total_steps) in [(16, 16), (64, 4000), (777, 5003)] {
                let time_step = 1e-6;
                let duration = time_step * contact_steps as f64;
                let pulse = Pulse {
                    duration,
                    amplitude: std::f64::consts::PI / (2.0 * duration),
                    time_step,
                    contact_steps,
                    total_steps,
                    longest_step: 1e-3,
                };
                let mut material = Material::preset("glass").unwrap();
                material.stiffness_damping = stiffness_damping;
                let exact = respond(&basis, &material, &impulse, &pulse);
                let response = Response::new(&basis, &material, &impulse, &pulse);
                let close = stepped(&response, basis.count(), &pulse);
                for mode in 0..basis.count() {
                    let steps = (0..total_steps).map(|k| k * basis.count() + mode);
                    let largest = steps.clone().map(|i| exact.amplitudes[i].abs());
                    let largest = f64::from(largest.fold(0.0, f32::max));
                    let error = steps.map(|i| f64::from(exact.amplitudes[i] - close[i]).abs());
                    let error = error.fold(0.0, f64::max);
                    assert!(error <= 2e-5 * largest, "{mode}: {error} of {largest}");
                    if largest > 0.0 {
                        worst = worst.max(error / largest);
                    }
                }
            }
        }
        println!("largest error over largest amplitude of a mode: {worst:.2e}");
    }
}
