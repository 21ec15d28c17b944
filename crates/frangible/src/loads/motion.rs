//! Fracture under a prescribed modal motion.

use crate::body::Body;
use crate::config::FractureConfig;
use crate::cracking::{Cracking, Moves};
use crate::error::{InputError, positive};
use crate::impact::pieces;
use crate::motion::Motion;
use crate::outcome::{ImpactReport, LookedAt, Outcome};
use crate::trace::CrackTrace;

/// Grows cracks under a prescribed motion of a body's modes, with the steps of [`impact()`](crate::impact()) after the stress wave
/// is computed.
///
/// `pressed` lists surface triangles under external pressure; `time_step` is the time step of the motion, s. With the energy ledger,
/// the cracks together spend at most the motion's [peak strain energy](Motion::peak_strain_energy).
///
/// A motion with identical rows represents a static state, as assumed by methods that neglect vibration.
///
/// # Errors
/// A motion, time step or energy that is not one of this body.
pub fn follow(
    body: &Body,
    motion: &Motion,
    pressed: &[u32],
    time_step: f64,
    config: &FractureConfig,
) -> Result<Outcome, InputError> {
    run(body, motion, pressed, time_step, config, &mut None)
}

/// [`follow()`] with a trace of its cracks, element by element: for tests.
///
/// # Errors
/// The errors of [`follow()`].
pub fn follow_traced(
    body: &Body,
    motion: &Motion,
    pressed: &[u32],
    time_step: f64,
    config: &FractureConfig,
) -> Result<(Outcome, CrackTrace), InputError> {
    let mut trace = Some(CrackTrace::default());
    let outcome = run(body, motion, pressed, time_step, config, &mut trace)?;
    Ok((outcome, trace.unwrap_or_default()))
}

fn run(
    body: &Body,
    motion: &Motion,
    pressed: &[u32],
    time_step: f64,
    config: &FractureConfig,
    trace: &mut Option<CrackTrace>,
) -> Result<Outcome, InputError> {
    if motion.modes != body.asset.modes.followed() || motion.steps() == 0 {
        return Err(InputError::Motion(
            "it must have one amplitude per mode of the body and at least one time step",
        ));
    }
    if !motion.amplitudes.iter().all(|q| q.is_finite()) {
        return Err(InputError::Motion(
            "every amplitude must be a finite number",
        ));
    }
    positive("time step", time_step, "s")?;
    config.validate()?;
    let energy = motion.peak_strain_energy;
    if !energy.is_finite() || energy < 0.0 {
        return Err(InputError::Motion(
            "its strain energy must be a finite number, zero or above",
        ));
    }
    let mut report = ImpactReport::of(body);
    report.time_step = time_step;
    report.time_steps = motion.steps();
    report.looked_at = LookedAt::Amplitudes;
    let cracked = Cracking {
        body,
        config,
        moves: Moves::Given(motion.clone()),
        pressed: pressed.to_vec(),
        time_step,
        budget: energy,
    }
    .run(0, report, trace);
    Ok(pieces(body, cracked))
}
