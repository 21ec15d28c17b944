//! A steady state in place of the vibration (Müller, McMillan, Dorsey, Jagnow, *Real-time simulation of deformation and fracture
//! of stiff materials*, 2001; `[G12 Fig. 4, top]`).
//!
//! Such methods take the impulse that the rigid-body engine found as a force over a time step of its own, and ask for the
//! static stress under that force. How long the contact lasts, and so what the striker is made of, does not enter; the time step
//! does, and it is the programmer's.
//!
//! Here: F = J / Δt, q_i = φ_i · F / λ_i for every mode. The force of a free body is balanced by its own inertia, which no mode
//! of vibration sees; Müller et al. anchor the body instead. From there on all is ours: weak points, strength, crack surfaces,
//! release, energy. The load acts for Δt; the cracks together spend no more than the strain energy of the steady state.

use frangible::Outcome;
use frangible::internals::contact::modal_load;
use frangible::internals::follow;
use frangible::internals::modal::Motion;

use super::error::CompareError;
use super::hit::Hit;

/// Time over which the impulse is spread unless another is asked for, s: a step of the rigid bodies of Frangible's scenes while
/// something may break.
pub const DEFAULT_STEP: f64 = 1.0 / 3840.0;

/// Breaks the body in the steady state of its impulses spread over `step`, s.
pub(crate) fn quasi_static(hit: Hit<'_>, step: f64) -> Result<Outcome, CompareError> {
    let asset = hit.body.asset();
    let load = modal_load(hit.body, hit.contacts);
    let followed = asset.modes().followed();
    let impulses = load.modal_impulse[..followed]
        .iter()
        .zip(&asset.modes().eigenvalues);
    let still: Vec<f64> = impulses.map(|(impulse, l)| impulse / (step * l)).collect();
    let energies = still.iter().zip(&asset.modes().eigenvalues);
    let energy = energies.map(|(q, l)| 0.5 * l * q * q).sum();
    let row: Vec<f32> = still.iter().map(|&q| q as f32).collect();
    let (time_step, steps) = steps(hit, step);
    let motion = Motion::new(row.repeat(steps), row.len(), energy, energy);
    let pressed: Vec<u32> = load.touches.iter().map(|touch| touch.triangle).collect();
    Ok(follow(hit.body, &motion, &pressed, time_step, hit.config)?)
}

/// Time step, s, in which a crack runs a mean edge of the mesh, and number of steps for which the load lasts.
fn steps(hit: Hit<'_>, lasts: f64) -> (f64, usize) {
    let asset = hit.body.asset();
    let Some(speed) = hit.config.crack_speed() else {
        return (lasts, 1);
    };
    let edge = f64::from(asset.fracture().mean_edge());
    let time_step = edge / (speed * asset.material().rayleigh_speed());
    let steps = (lasts / time_step).ceil() as usize;
    (time_step, steps.clamp(1, 4096))
}
