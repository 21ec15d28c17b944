//! THE pipeline: contacts in, outcome out, one call per stage in the paper's order.

use std::sync::Arc;

use glam::Vec3;
use web_time::Instant;

use crate::blow::Blow;
use crate::body::Body;
use crate::config::{DurationModel, FractureConfig};
use crate::contact::{self, Contact, Pulse};
use crate::cracking::{Cracked, Cracking, Moves};
use crate::dice::dice;
use crate::error::InputError;
use crate::fragment::{self, Breakup, Built};
use crate::motion::{self, Motion};
use crate::outcome::{Fracture, ImpactReport, LookedAt, Outcome};
use crate::refuse;
use crate::trace::CrackTrace;

/// Computes the outcome of an impact on a body. The body itself is not changed; the caller replaces a broken body by its fragments.
///
/// `contacts` are all contacts of this impact on this body, in its body frame (origin at the centre of mass).
/// The modes are those of the unbroken body, the single basis of `[G12 §7.3.1]`. In an integrated blow, pieces that separate move
/// independently, which changes the motion of the body. Most contacts are far below the strength; these cost a lookup of the closest surface
/// triangle, seldom O(modes), and no allocation.
///
/// # Errors
/// A contact with NaN, a negative impulse or no direction; the errors of [`FractureConfig::validate`].
pub fn impact(
    body: &Body,
    contacts: &[Contact],
    config: &FractureConfig,
) -> Result<Outcome, InputError> {
    Ok(match Vibration::begin(body, contacts, config)? {
        Stage::Held(outcome) => outcome,
        Stage::Vibrates(vibration) => vibration.end(body, config, 0),
    })
}

/// Like [`impact()`], with a trace of the cracks element by element, for tests and the comparison with the paper. The motion is always
/// computed over time, so the report has the time steps of harmless impacts too.
///
/// # Errors
/// The errors of [`impact()`].
pub fn impact_traced(
    body: &Body,
    contacts: &[Contact],
    config: &FractureConfig,
) -> Result<(Outcome, CrackTrace), InputError> {
    let mut trace = Some(CrackTrace::default());
    let outcome = match begin(body, contacts, config, false)? {
        Stage::Held(outcome) => outcome,
        Stage::Vibrates(vibration) => pieces(body, vibration.crack(body, config, 0, &mut trace)),
    };
    Ok((outcome, trace.unwrap_or_default()))
}

/// Returns true if an impact would break a body into pieces. Like [`impact`], but without making the pieces.
///
/// # Errors
/// The errors of [`impact()`].
pub fn would_break(
    body: &Body,
    contacts: &[Contact],
    config: &FractureConfig,
) -> Result<bool, InputError> {
    Ok(match Vibration::begin(body, contacts, config)? {
        Stage::Held(_) => false,
        Stage::Vibrates(vibration) => vibration.would_break(body, config, 0),
    })
}

/// Result of the first stage of an impact.
#[derive(Clone, Debug)]
pub enum Stage {
    /// The impact is over: its impulses are too weak for any crack.
    Held(Outcome),
    /// Its modes have to be followed over time.
    Vibrates(Vibration),
}

/// An impact whose modes have to be followed over time.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Vibration {
    /// Surface triangles under its contacts: their flaws are pressed together, see [`Body::weak_place`].
    pub pressed: Vec<u32>,
    /// Report of the impact so far.
    pub report: ImpactReport,
    /// The force on the modes.
    pub drive: Drive,
}

/// The force on the modes of a body.
#[derive(Clone, Debug)]
pub enum Drive {
    /// A half-sine of given impulses, which the modes alone answer.
    Pulse {
        /// Modal impulse of every mode, N·s/√kg.
        modal_impulse: Vec<f64>,
        /// The pulse of unit impulse and its time steps.
        pulse: Pulse,
    },
    /// A blow, followed with the body.
    Blow(Box<Blow>),
}

impl Vibration {
    /// Begins an impact: everything of [`impact()`](crate::impact()) before the motion of the modes.
    ///
    /// # Errors
    /// The errors of [`impact()`](crate::impact()).
    pub fn begin(
        body: &Body,
        contacts: &[Contact],
        config: &FractureConfig,
    ) -> Result<Stage, InputError> {
        begin(body, contacts, config, config.culling)
    }

    /// Modal impulse and pulse, where they and the modes are the whole motion.
    #[must_use]
    pub fn pulse(&self) -> Option<(&[f64], &Pulse)> {
        match &self.drive {
            Drive::Pulse {
                modal_impulse,
                pulse,
            } => Some((modal_impulse, pulse)),
            Drive::Blow(_) => None,
        }
    }

    /// Amplitudes of the modes over time.
    #[must_use]
    pub fn motion(&self, body: &Body) -> Motion {
        match &self.drive {
            Drive::Pulse {
                modal_impulse,
                pulse,
            } => motion::respond(
                &body.asset.modes,
                &body.asset.material,
                modal_impulse,
                pulse,
            ),
            Drive::Blow(blow) => blow.motion().clone(),
        }
    }

    /// Ends the impact. With `first_step` 0 this is [`impact()`](crate::impact()); time steps before it are passed over.
    ///
    /// If none of those has a weak point's stress above its strength, and the body has no cracks yet, the cracks and
    /// the pieces are the same bit for bit; the report's stresses and the margin are those of the steps looked at.
    #[must_use]
    pub fn end(self, body: &Body, config: &FractureConfig, first_step: usize) -> Outcome {
        pieces(body, self.crack(body, config, first_step, &mut None))
    }

    /// Returns true if the impact would break the body into pieces: [`Self::end`] without making them.
    #[must_use]
    pub fn would_break(self, body: &Body, config: &FractureConfig, first_step: usize) -> bool {
        let (cracking, report) = self.cracking(body, config);
        cracking.parts(first_step, report)
    }

    /// Second stage: the motion of the modes, and the cracks that it opens from time step `first_step` on.
    fn crack<'a>(
        self,
        body: &'a Body,
        config: &'a FractureConfig,
        first_step: usize,
        trace: &mut Option<CrackTrace>,
    ) -> Cracked<'a> {
        let (cracking, report) = self.cracking(body, config);
        cracking.run(first_step, report, trace)
    }

    /// The motion of the modes, ready for its cracks.
    fn cracking<'a>(
        mut self,
        body: &'a Body,
        config: &'a FractureConfig,
    ) -> (Cracking<'a>, ImpactReport) {
        let clock = Instant::now();
        let moves = match self.drive {
            Drive::Blow(blow) => Moves::Blow(blow),
            Drive::Pulse { .. } => Moves::Given(self.motion(body)),
        };
        self.report.timings.response += clock.elapsed().as_secs_f64();
        // Friction pushes as it did in the engine, and what it brings is not followed: cracks have only what the approach brought.
        let most = match &moves {
            Moves::Blow(blow) if blow.is_of_strikers() => self.report.approach_energy,
            _ => f64::INFINITY,
        };
        let cracking = Cracking {
            body,
            config,
            pressed: self.pressed,
            time_step: self.report.time_step,
            budget: moves.motion().peak_strain_energy.min(most),
            moves,
        };
        (cracking, self.report)
    }
}

/// First stage: bounds free of time, if they may `refuse` it, force pulse and time steps.
fn begin(
    body: &Body,
    contacts: &[Contact],
    config: &FractureConfig,
    refuse: bool,
) -> Result<Stage, InputError> {
    contacts.iter().try_for_each(Contact::validate)?;
    config.validate()?;
    let contacts = &*contact::in_one(contacts);
    let mut report = ImpactReport::of(body);
    report.approach_energy = contact::approach_energy(contacts);
    let clock = Instant::now();

    // Most contacts end here (beyond the paper: refuse/impact.rs).
    if refuse && let Some(refusal) = refuse::refused(body, contacts, config) {
        report.looked_at = refusal.looked_at;
        report.stress_bound = f64::from(refusal.bound);
        report.timings.response = clock.elapsed().as_secs_f64();
        let margin = report.strength / f64::from(refusal.as_weakest);
        return Ok(held(margin, report));
    }

    let vibration = match config.duration {
        DurationModel::Integrated => integrated(body, contacts, config, &mut report),
        _ => given(body, contacts, config, &mut report),
    };
    report.timings.response = clock.elapsed().as_secs_f64();
    Ok(match vibration {
        Some(vibration) => Stage::Vibrates(Vibration {
            report,
            ..vibration
        }),
        None => held(f64::INFINITY, report),
    })
}

fn held(margin: f64, report: ImpactReport) -> Stage {
    Stage::Held(Outcome::Held {
        margin,
        report,
        state: None,
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
    let load = contact::modal_load(body, contacts.iter().filter(|c| c.pushes(config.duration)));
    if load.touches.is_empty() {
        return None;
    }
    let duration = contact::contact_duration(asset, &load, config.duration);
    report.unadjusted_duration = duration;
    // Nothing lengthens a script.
    let strikes = load.touches.iter().any(|t| !t.contact.is_script());
    report.contact_duration = if config.admissible_duration && strikes {
        contact::admissible_duration(asset, &load, report.approach_energy, duration)
    } else {
        duration
    };
    let pulse = contact::pulse(asset, &load, report.contact_duration, config);
    report.looked_at = LookedAt::Amplitudes;
    report.time_step = pulse.time_step;
    report.time_steps = pulse.total_steps;
    report.most_excited_frequency = contact::most_excited_mode(asset, &load.modal_impulse)
        .map_or(0.0, |i| asset.modes.frequency(i));
    Some(Vibration {
        pressed: load.pressed(),
        report: ImpactReport::default(),
        drive: Drive::Pulse {
            modal_impulse: load.modal_impulse,
            pulse,
        },
    })
}

/// The blow, followed with the body. None where nothing pushes.
fn integrated(
    body: &Body,
    contacts: &[Contact],
    config: &FractureConfig,
    report: &mut ImpactReport,
) -> Option<Vibration> {
    let blow = Blow::of_valid(body, contacts, config, None)?;
    let asset = &*body.asset;
    report.approach_energy = blow.approach_energy();
    report.unadjusted_duration = blow.expected_duration();
    report.looked_at = LookedAt::Amplitudes;
    report.time_step = blow.time_step();
    report.take_blow(&blow);
    let modal_impulse = blow.modal_impulse();
    report.most_excited_frequency =
        contact::most_excited_mode(asset, &modal_impulse).map_or(0.0, |i| asset.modes.frequency(i));
    Some(Vibration {
        pressed: blow.pressed(),
        report: ImpactReport::default(),
        drive: Drive::Blow(Box::new(blow)),
    })
}

/// Cracks → fragments `[G12 §6]`.
pub(crate) fn pieces(body: &Body, cracked: Cracked<'_>) -> Outcome {
    let (system, labels, apart, mut report) = match cracked {
        Cracked::Diced(place, since, clumps, report) => {
            return diced(body, place, since, clumps, report);
        }
        Cracked::Parted(system, labels, apart, report) => (system, labels, apart, report),
        Cracked::Held(margin, report, state) => {
            return Outcome::Held {
                margin,
                report,
                state,
            };
        }
    };
    let start = Instant::now();
    let root = &**body.root();
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
        fragment::draw(
            surface,
            root,
            &mut fragments,
            undrawn,
            &system.config.threads,
        );
        report.timings.drawing = start.elapsed().as_secs_f64();
    }
    if let Some(apart) = apart {
        let of_fragments = traces.iter().map(|trace| trace.label);
        let volumes = &body.prepared.index.volumes;
        apart.give_to(&mut fragments, of_fragments, &labels.of_node, volumes);
    }
    for fragment in &mut fragments {
        fragment.mass.centre -= body.origin();
    }
    let film = fragment::film_of(body, &fragments, |node| {
        let label = labels.of_node[node as usize];
        let piece = traces.iter().position(|trace| trace.label == label);
        piece.map(|piece| piece as u32)
    });
    let breakup = Breakup::new(&system, labels, traces, Arc::new(fixed));
    Outcome::Broke(Box::new(Fracture {
        fragments,
        report,
        breakup: Some(Arc::new(breakup)),
        clumps: Vec::new(),
        film,
    }))
}

/// The outcome of a crack that lets a tempered wall go.
fn diced(body: &Body, place: Vec3, since: f64, clumps: usize, mut report: ImpactReport) -> Outcome {
    let start = Instant::now();
    let Some(diced) = dice(body, place, since, clumps) else {
        return Outcome::Held {
            margin: 1.0,
            report,
            state: None,
        };
    };
    report.crack_area = diced.crack_area;
    report.volume_error = diced.volume_error;
    report.timings.fragments = start.elapsed().as_secs_f64();
    let mut fracture = Fracture::new(diced.fragments, report);
    fracture.clumps = diced.clumps;
    Outcome::Broke(Box::new(fracture))
}
