//! THE pipeline: contacts in, outcome out, one call per stage in the paper's order.

use std::sync::Arc;

use web_time::Instant;

use crate::asset::Asset;
use crate::blow::Blow;
use crate::body::Body;
use crate::config::{DurationModel, FractureConfig};
use crate::contact::{self, Contact, Load, Refusal};
use crate::crack::{CrackSystem, Culling, Peak, StressField, Suspects, crack, front_limit};
use crate::error::InputError;
use crate::fragment::{self, Built, Labels};
use crate::modal::Motion;
use crate::outcome::{Fracture, ImpactReport, LookedAt, Outcome};
use crate::piece::{Breakup, static_impact};
use crate::stages::Vibration;
use crate::state::BodyState;
use crate::stress::{BATCH, DisplacementBatch, MARGIN, STRIDE, lane};
use crate::trace::CrackTrace;

/// Computes what an impact does to a body. Nothing is changed; the caller replaces a broken body by its fragments.
///
/// `contacts` are all contacts of this impact on this body, in its body frame (origin at the centre of mass).
/// The modes of the unbroken body serve during the whole break (the single-basis assumption of `[G12]`).
/// A contact far below the strength, which is nearly every one, costs a look at the closest surface triangle, seldom O(modes), and no
/// allocation.
///
/// # Errors
/// A contact with a NaN, a negative impulse or no direction; what [`FractureConfig::validate`] refuses.
pub fn impact(
    body: &Body,
    contacts: &[Contact],
    config: &FractureConfig,
) -> Result<Outcome, InputError> {
    if let Some(statics) = &body.statics {
        return static_impact(body, statics, contacts, config, &mut None);
    }
    let cracked = cracks(body, contacts, config, &mut None)?;
    Ok(pieces(body, cracked))
}

/// [`impact()`], and what its cracks did element by element: for tests and for the comparison with the paper. No bound free of time
/// refuses it: its motion is followed, and the report has the steps.
///
/// # Errors
/// As [`impact()`].
pub fn impact_traced(
    body: &Body,
    contacts: &[Contact],
    config: &FractureConfig,
) -> Result<(Outcome, CrackTrace), InputError> {
    let mut trace = Some(CrackTrace::default());
    let outcome = match &body.statics {
        Some(statics) => static_impact(body, statics, contacts, config, &mut trace)?,
        None => pieces(body, cracks(body, contacts, config, &mut trace)?),
    };
    Ok((outcome, trace.unwrap_or_default()))
}

/// Whether an impact would break a body into pieces: [`impact`] without making them.
///
/// # Errors
/// As [`impact`].
pub fn would_break(
    body: &Body,
    contacts: &[Contact],
    config: &FractureConfig,
) -> Result<bool, InputError> {
    if body.statics.is_some() {
        let outcome = impact(body, contacts, config)?;
        return Ok(matches!(outcome, Outcome::Broke(_)));
    }
    let cracked = cracks(body, contacts, config, &mut None)?;
    Ok(matches!(cracked, Cracked::Parted(..)))
}

/// Whether a bound that costs microseconds shows that an impact does nothing to a body; [`impact()`] asks it first. False
/// says nothing.
#[must_use]
pub fn is_harmless(body: &Body, contacts: &[Contact], config: &FractureConfig) -> bool {
    config.culling
        && config.validate().is_ok()
        && body.statics.is_none()
        && contacts.iter().all(|c| c.validate().is_ok())
        && contact::refused(body, contacts, config).is_some()
}

/// What the cracks of an impact did to a body.
#[expect(clippy::large_enum_variant, reason = "one at a time, never stored")]
pub(crate) enum Cracked<'a> {
    /// Margin, report, and the body's cracks if there are new ones.
    Held(f64, ImpactReport, Option<Box<BodyState>>),
    /// Pieces, not made yet.
    Parted(CrackSystem<'a>, Labels, ImpactReport),
}

fn cracks<'a>(
    body: &'a Body,
    contacts: &[Contact],
    config: &'a FractureConfig,
    trace: &mut Option<CrackTrace>,
) -> Result<Cracked<'a>, InputError> {
    Ok(
        match begin(body, contacts, config, config.culling && trace.is_none())? {
            Begun::Held(margin, report) => Cracked::Held(margin, report, None),
            Begun::Vibrates(vibration) => vibrate(body, config, vibration, 0, trace),
        },
    )
}

/// What is known of an impact before the motion of the modes is.
pub(crate) enum Begun {
    /// Too weak for any crack: margin and report.
    Held(f64, ImpactReport),
    /// The modes have to be followed.
    Vibrates(Vibration),
}

/// First stage: bounds free of time, if they may `refuse` it, force pulse and time steps.
pub(crate) fn begin(
    body: &Body,
    contacts: &[Contact],
    config: &FractureConfig,
    refuse: bool,
) -> Result<Begun, InputError> {
    contacts.iter().try_for_each(Contact::validate)?;
    config.validate()?;
    let mut report = report_on(body);
    report.approach_energy = contact::approach_energy(contacts);
    let clock = Instant::now();

    // Most contacts end here (beyond the paper: contact/refusal.rs).
    if refuse && let Some(refusal) = contact::refused(body, contacts, config) {
        return Ok(held(refusal, report, clock));
    }

    let vibration = if config.has_complement() {
        integrated(body, contacts, config, &mut report)
    } else {
        given(body, contacts, config, &mut report)
    };
    report.timings.response = clock.elapsed().as_secs_f64();
    Ok(match vibration {
        Some(vibration) => Begun::Vibrates(Vibration {
            report,
            ..vibration
        }),
        None => Begun::Held(f64::INFINITY, report),
    })
}

/// Contact → force pulse → modal response [G12 §4.1-4.3]: impulses are given, and only modes answer. None where nothing pushes.
fn given(
    body: &Body,
    contacts: &[Contact],
    config: &FractureConfig,
    report: &mut ImpactReport,
) -> Option<Vibration> {
    let asset = &*body.asset;
    let load = contact::modal_load(body, contacts.iter().filter(|c| c.impulse > 0.0));
    if load.touches.is_empty() {
        return None;
    }
    (report.unadjusted_duration, report.contact_duration) =
        durations(asset, &load, contacts, config);
    let pulse = contact::pulse(asset, &load, report.contact_duration, config);
    report.looked_at = LookedAt::Amplitudes;
    report.time_step = pulse.time_step;
    report.time_steps = pulse.total_steps;
    report.most_excited_frequency = contact::most_excited_mode(asset, &load.modal_impulse)
        .map_or(0.0, |i| asset.modes.frequency(i));
    Some(Vibration {
        pressed: load.pressed(),
        modal_impulse: load.modal_impulse,
        pulse,
        report: ImpactReport::default(),
        blow: None,
    })
}

/// Duration of contacts whose impulses are given, s, and what is made of it where it has to be admissible.
fn durations(
    asset: &Asset,
    load: &Load,
    contacts: &[Contact],
    config: &FractureConfig,
) -> (f64, f64) {
    let duration = contact::contact_duration(asset, load, config.duration);
    let longer = if config.admissible_duration {
        contact::admissible_duration(asset, load, contact::approach_energy(contacts), duration)
    } else {
        duration
    };
    (duration, longer)
}

/// The blow, followed with the body. None where nothing pushes.
fn integrated(
    body: &Body,
    contacts: &[Contact],
    config: &FractureConfig,
    report: &mut ImpactReport,
) -> Option<Vibration> {
    let blow = if config.duration == DurationModel::Integrated {
        Blow::of_valid(body, contacts, config)?
    } else {
        // Every contact is a half-sine of its impulse.
        let mut scripts: Vec<Contact> =
            (contacts.iter().filter(|c| c.impulse > 0.0).copied()).collect();
        let load = contact::modal_load(body, &scripts);
        if load.touches.is_empty() {
            return None;
        }
        let (_, duration) = durations(&body.asset, &load, contacts, config);
        let strikers = scripts.iter_mut().filter(|c| !c.is_script());
        strikers.for_each(|c| c.duration = duration as f32);
        Blow::of_valid(body, &scripts, config)?
    };
    let asset = &*body.asset;
    report.unadjusted_duration = blow.hertz_time();
    report.contact_duration = blow.duration();
    report.looked_at = LookedAt::Amplitudes;
    report.time_step = blow.time_step();
    report.time_steps = blow.motion.steps();
    report.contacts = blow.reports();
    let modal_impulse = blow.modal_impulse();
    report.most_excited_frequency =
        contact::most_excited_mode(asset, &modal_impulse).map_or(0.0, |i| asset.modes.frequency(i));
    Some(Vibration {
        pressed: blow.pressed(),
        modal_impulse,
        pulse: blow.pulse(),
        report: ImpactReport::default(),
        blow: Some(Box::new(blow)),
    })
}

/// Of an impact that a bound refused.
fn held(refusal: Refusal, mut report: ImpactReport, clock: Instant) -> Begun {
    report.looked_at = refusal.looked_at;
    report.stress_bound = f64::from(refusal.bound);
    report.timings.response = clock.elapsed().as_secs_f64();
    let margin = report.strength / f64::from(refusal.as_weakest);
    Begun::Held(margin, report)
}

/// Second stage: the motion of the modes, and what it does from time step `first_step` on.
pub(crate) fn vibrate<'a>(
    body: &'a Body,
    config: &'a FractureConfig,
    vibration: Vibration,
    first_step: usize,
    trace: &mut Option<CrackTrace>,
) -> Cracked<'a> {
    let clock = Instant::now();
    let mut vibration = vibration;
    let mut report = std::mem::take(&mut vibration.report);
    let motion = match &mut vibration.blow {
        Some(blow) => std::mem::take(&mut blow.motion),
        None => vibration.motion(body),
    };
    report.timings.response += clock.elapsed().as_secs_f64();
    Cracking {
        body,
        config,
        pressed: vibration.pressed,
        time_step: vibration.pulse.time_step,
        budget: motion.peak_strain_energy,
        motion,
        blow: vibration.blow,
    }
    .run(first_step, report, trace)
}

/// Below this stress bound nothing happens to a body, Pa: no crack starts, and none of its old ones moves.
pub(crate) fn harmless(body: &Body) -> f32 {
    let strength = body.resistance.weakest as f32 * (1.0 - MARGIN);
    if body.state().is_intact() {
        strength
    } else {
        strength.min(front_limit(body))
    }
}

/// A report with what is known of every load.
pub(crate) fn report_on(body: &Body) -> ImpactReport {
    ImpactReport {
        strength: body.resistance.weakest,
        weak_points: body.weak_tets().len(),
        ..ImpactReport::default()
    }
}

/// Stress wave → cracks `[G12 §4.4, §5]` → which nodes hang together `[G12 §6.1]`, for any motion of the body.
pub(crate) struct Cracking<'a> {
    pub(crate) body: &'a Body,
    pub(crate) config: &'a FractureConfig,
    pub(crate) motion: Motion,
    /// Surface triangles under a contact.
    pub(crate) pressed: Vec<u32>,
    /// Time step of the motion, s.
    pub(crate) time_step: f64,
    /// Energy that the cracks may spend, with the ledger, J.
    pub(crate) budget: f64,
    /// The blow that the motion comes from: it ends when the wall under it is gone.
    pub(crate) blow: Option<Box<Blow>>,
}

impl<'a> Cracking<'a> {
    /// Runs all cracks, where it is known that nothing happens before time step `first_step`.
    pub(crate) fn run(
        mut self,
        first_step: usize,
        mut report: ImpactReport,
        trace: &mut Option<CrackTrace>,
    ) -> Cracked<'a> {
        let (body, config) = (self.body, self.config);
        let budget = if config.energy_ledger {
            self.budget
        } else {
            f64::INFINITY
        };
        let mut system = CrackSystem::new(body, config, budget);
        let mut looked = Looked::default();
        // From the beginning of its batch, so that every batch is whole.
        let mut step = first_step / STRIDE * STRIDE;
        while let Some((next, contact, compliance)) =
            self.follow(step, &mut system, &mut looked, &mut report)
        {
            let Some(blow) = &mut self.blow else { break };
            let now = next as f64 * self.time_step;
            blow.weaken(body, contact, compliance, now);
            self.motion = std::mem::take(&mut blow.motion);
            report.contacts = blow.reports();
            report.contact_duration = blow.duration();
            report.time_steps = self.motion.steps();
            step = next;
        }
        report.peak_elastic_energy = self.motion.peak_energy;
        report.peak_strain_energy = self.motion.peak_strain_energy;
        self.end(system, looked, report, trace)
    }

    /// Runs the cracks from a time step on: to the end of the motion, or to a time step before which cracks have weakened the wall under a
    /// contact, whose number comes with it, and what the wall then gives way by, m/N.
    fn follow(
        &mut self,
        first_step: usize,
        system: &mut CrackSystem<'a>,
        looked: &mut Looked,
        report: &mut ImpactReport,
    ) -> Option<(usize, usize, f64)> {
        let (body, config, motion) = (self.body, self.config, &self.motion);
        let mut displacement = DisplacementBatch::new(&body.asset);
        let mut culling = Culling::new(body, config, motion);
        let mut field = StressField::new(body, config, motion, &self.pressed, &mut displacement);
        let mut suspects = Suspects::default();
        let mut roots = [0.0; BATCH];
        let mut weakened = None;
        for step in first_step..motion.steps() {
            let k = lane(step);
            field.step = step;
            if step % STRIDE == 0 {
                if step > first_step
                    && let Some(blow) = self.blow.as_ref().filter(|b| b.pushes_at(step))
                    && let Some((contact, compliance)) = blow.weakened(system)
                {
                    weakened = Some((step, contact, compliance));
                    break;
                }
                // Bounds, then the points that they leave, of all steps of the batch.
                let start = Instant::now();
                culling.begin();
                for step in (step..motion.steps()).take(STRIDE) {
                    let k = lane(step);
                    roots[k] = culling.root(motion, step);
                    culling.survive(motion, step, roots[k], k);
                }
                field.displacement.seek(motion, step);
                suspects.find(body, &mut field, culling.survivors(), looked.peak);
                report.timings.stress += start.elapsed().as_secs_f64();
            }
            system.wake(roots[k]);
            if !culling.survives(k) && system.is_quiet() {
                continue;
            }
            report.looked_at = LookedAt::Stresses;
            let start = Instant::now();
            let times = [step, step + 1].map(|step| motion.begin(step, self.time_step));
            looked.peak = crack(system, &mut field, &suspects, times, looked.peak);
            report.timings.cracks += start.elapsed().as_secs_f64();
        }
        looked.asked_clusters |= culling.asked_clusters;
        looked.passed_over = looked.passed_over.max(culling.passed_over);
        looked.as_weakest = looked.as_weakest.max(culling.as_weakest);
        weakened
    }

    /// What came of it.
    fn end(
        self,
        system: CrackSystem<'a>,
        looked: Looked,
        mut report: ImpactReport,
        trace: &mut Option<CrackTrace>,
    ) -> Cracked<'a> {
        let body = self.body;
        let peak = looked.peak;
        if let Some(first) = system.cracks.get(system.old_cracks) {
            report.first_crack_time = first.elements.first().map(|cut| cut.time);
            report.first_crack_point = Some(first.frame.origin - body.origin().as_vec3());
        }
        if report.looked_at == LookedAt::Amplitudes && looked.asked_clusters {
            report.looked_at = LookedAt::Clusters;
        }
        report.peak_stress = f64::from(peak.tension);
        if peak.tension > 0.0 {
            let place = body.prepared.centroids[peak.tet as usize].as_dvec3();
            report.peak_point = Some((place - body.origin()).as_vec3());
        }
        report.stress_bound = f64::from(peak.tension.max(looked.passed_over));
        report.cracks = system.cracks.len() - system.old_cracks;
        report.crack_area = system.area;
        report.fracture_energy = system.spent;
        let margin = report.strength / f64::from(peak.as_weakest.max(looked.as_weakest));
        if system.area == 0.0 && trace.is_none() {
            return Cracked::Held(margin, report, None);
        }
        let start = Instant::now();
        let crumb_share = self.config.crumb_share;
        let labels = fragment::label(&system, &body.prepared.index, crumb_share);
        report.timings.labels = start.elapsed().as_secs_f64();
        if let Some(trace) = trace {
            *trace = CrackTrace::of(&system, &labels.of_node);
        }
        report.arrivals = system.arrivals();
        if labels.count < 2 {
            let grown = system.area > 0.0;
            let state = grown.then(|| Box::new(BodyState::of(&system.cracks)));
            Cracked::Held(margin, report, state)
        } else {
            Cracked::Parted(system, labels, report)
        }
    }
}

/// What has been met so far.
#[derive(Clone, Copy, Debug, Default)]
struct Looked {
    peak: Peak,
    asked_clusters: bool,
    /// Largest bound of what was passed over, Pa.
    passed_over: f32,
    /// Largest bound of what was passed over, as the weakest point would feel it, Pa.
    as_weakest: f32,
}

/// Cracks → fragments `[G12 §6]`.
pub(crate) fn pieces(body: &Body, cracked: Cracked<'_>) -> Outcome {
    let (system, labels, mut report) = match cracked {
        Cracked::Parted(system, labels, report) => (system, labels, report),
        Cracked::Held(margin, report, state) => {
            return Outcome::Held {
                margin,
                report,
                state,
            };
        }
    };
    let start = Instant::now();
    let root = &**body.prepared.root.as_ref().unwrap_or(&body.prepared);
    let Built {
        mut fragments,
        undrawn,
        traces,
        fixed,
    } = fragment::build(&system, &labels, root);
    let volume: f64 = fragments.iter().map(|f| f.mass.volume).sum();
    let whole = match body.asset.portion {
        Some(_) => body.asset.mass.volume,
        None => root.index.total_volume,
    };
    report.volume_error = volume / whole - 1.0;
    report.timings.fragments = start.elapsed().as_secs_f64();
    let start = Instant::now();
    if let (Some(surface), Some(undrawn)) = (&body.asset.root().render, undrawn) {
        let mesh = &body.asset.fracture;
        fragment::draw(surface, mesh, root, &mut fragments, undrawn);
        report.timings.drawing = start.elapsed().as_secs_f64();
    }
    for fragment in &mut fragments {
        fragment.mass.centre -= body.origin();
    }
    let breakup = Breakup::new(&system, labels, traces, Arc::new(fixed));
    Outcome::Broke(Box::new(Fracture {
        fragments,
        report,
        breakup: Some(Arc::new(breakup)),
    }))
}
