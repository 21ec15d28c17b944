//! THE pipeline: contacts in, outcome out, one call per stage in the paper's order.

use std::time::Instant;

use crate::body::Body;
use crate::config::FractureConfig;
use crate::contact::{self, Contact};
use crate::crack::{CrackSystem, StressField, advance, start_cracks};
use crate::error::InputError;
use crate::fragment;
use crate::modal;
use crate::outcome::{Fracture, ImpactReport, Outcome};
use crate::stress::{DisplacementBatch, Elasticity};
use crate::trace::CrackTrace;

/// Computes what an impact does to a body. Nothing is changed; the caller replaces a broken body by its fragments.
///
/// `contacts` are all contacts of this impact on this body, in its body frame (origin at the centre of mass).
/// The modes of the unbroken body serve during the whole break (the single-basis assumption of `[G12]`).
///
/// # Errors
/// A contact with a NaN, a negative impulse or no direction.
pub fn impact(
    body: &Body,
    contacts: &[Contact],
    config: &FractureConfig,
) -> Result<Outcome, InputError> {
    traced(body, contacts, config, &mut None)
}

/// [`impact()`], and what its cracks did element by element: for tests and for the comparison with the paper.
///
/// # Errors
/// As [`impact()`].
pub fn impact_traced(
    body: &Body,
    contacts: &[Contact],
    config: &FractureConfig,
) -> Result<(Outcome, CrackTrace), InputError> {
    let mut trace = Some(CrackTrace::default());
    let outcome = traced(body, contacts, config, &mut trace)?;
    Ok((outcome, trace.unwrap_or_default()))
}

fn traced(
    body: &Body,
    contacts: &[Contact],
    config: &FractureConfig,
    trace: &mut Option<CrackTrace>,
) -> Result<Outcome, InputError> {
    contacts.iter().try_for_each(Contact::validate)?;
    let asset = &*body.asset;
    let mut report = ImpactReport {
        strength: asset.material.strength,
        weak_points: body.weak_tets.len(),
        ..ImpactReport::default()
    };
    let clock = Instant::now();

    // Contact → force pulse → modal response [G12 §4.1-4.3].
    let load = contact::modal_load(asset, contacts);
    if load.touches.is_empty() {
        return Ok(Outcome::Held(Box::new(report)));
    }
    report.unadjusted_duration = contact::contact_duration(asset, &load, config.duration);
    report.contact_duration = if config.admissible_duration {
        contact::admissible_duration(asset, &load, report.unadjusted_duration)
    } else {
        report.unadjusted_duration
    };
    let pulse = contact::pulse(asset, &load, report.contact_duration, config);
    let motion = modal::respond(&asset.modes, &asset.material, &load.modal_impulse, &pulse);
    report.time_step = pulse.time_step;
    report.time_steps = motion.steps();
    report.approach_energy = contact::approach_energy(&load);
    report.peak_elastic_energy = motion.peak_energy;
    report.most_excited_frequency = contact::most_excited_mode(asset, &load.modal_impulse)
        .map_or(0.0, |i| asset.modes.frequency(i));
    report.timings.response = clock.elapsed().as_secs_f64();

    // Stress wave → cracks [G12 §4.4, §5].
    let mut system = CrackSystem::new(asset, config, body.seed);
    let mut displacement = DisplacementBatch::new(asset);
    let elasticity = Elasticity::new(&asset.material);
    let mut peak = 0.0;
    for step in 0..motion.steps() {
        let now = (step + 1) as f64 * pulse.time_step;
        let start = Instant::now();
        displacement.seek(asset, &motion, step);
        report.timings.stress += start.elapsed().as_secs_f64();
        let start = Instant::now();
        let field = StressField {
            asset,
            displacement: &displacement,
            elasticity,
            step,
        };
        advance(&mut system, &field, now - pulse.time_step, now);
        peak = start_cracks(&mut system, &field, &body.weak_tets, now, peak);
        if report.first_crack_time.is_none() && !system.cracks.is_empty() {
            report.first_crack_time = Some(now);
            report.first_crack_point = Some(system.cracks[0].frame.origin);
        }
        report.timings.cracks += start.elapsed().as_secs_f64();
    }
    report.peak_stress = f64::from(peak);
    report.cracks = system.cracks.len();
    report.crack_area = system.cracks.iter().fold(0.0, |sum, c| sum + c.area);
    report.fracture_energy = system.cracks.iter().fold(0.0, |sum, c| sum + c.spent);

    // Cracks → fragments [G12 §6].
    let start = Instant::now();
    let labels = fragment::label(&system, config.crumb_share);
    if let Some(trace) = trace {
        *trace = CrackTrace::of(&system, &labels.of_node);
    }
    if labels.count < 2 {
        report.timings.fragments = start.elapsed().as_secs_f64();
        return Ok(Outcome::Held(Box::new(report)));
    }
    let fragments = fragment::build(&system, &labels);
    let volume: f64 = fragments.iter().map(|f| f.mass.volume).sum();
    report.volume_error = volume / asset.fracture.total_volume() - 1.0;
    report.timings.fragments = start.elapsed().as_secs_f64();
    Ok(Outcome::Broke(Box::new(Fracture { fragments, report })))
}
