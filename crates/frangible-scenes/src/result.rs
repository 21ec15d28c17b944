//! Result of playing a scene.

use frangible::glam::Vec3;
use frangible::{Contact, ImpactReport};
use frangible_rapier::BreakCause;
use frangible_recording::Recording;
use frangible_sound::Sounding;

use crate::output::Simplified;

/// Result of playing a scene.
#[derive(Clone, Debug)]
pub struct Run {
    /// The animation.
    pub recording: Recording,
    /// Triangles and error of [`Drawing::Light`](crate::Drawing::Light); zero with the full drawing.
    pub simplified: Simplified,
    /// The sound source of each node of the recording.
    pub soundings: Vec<Sounding>,
    /// The breaks, in the order of time.
    pub breaks: Vec<BreakRecord>,
    /// For each body in order, the hardest impact that did not break it, if any.
    pub held: Vec<HeldRecord>,
    /// All blows on bodies and pieces that were tested for fracture, in the order of time.
    pub blows: Vec<BlowRecord>,
    /// True if everything except projectiles was at rest at the end.
    pub at_rest: bool,
    /// Simulated time, s.
    pub simulated: f64,
    /// Wall-clock time of the rigid bodies, without the fracture, s.
    pub rigid_seconds: f64,
    /// Wall-clock time of each frame of 1/60 s with all its steps, breaks included, s.
    pub frame_seconds: Vec<f64>,
}

/// An impact that did not break the body.
#[derive(Clone, Debug)]
pub struct HeldRecord {
    /// Number of the body, from 0.
    pub body: usize,
    /// Simulated time, s.
    pub time: f64,
    /// The contacts, body frame.
    pub contacts: Vec<Contact>,
    /// Strength over the stress, or over an upper bound of it: see [`frangible::Outcome::Held`].
    pub margin: f64,
    /// Report of the fracture.
    pub report: ImpactReport,
}

/// One of the blows of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BlowRecord {
    /// Number of the body, from 0.
    pub body: usize,
    /// Generation of the struck body: 0 for the body itself, 1 for a piece of it, 2 for a piece of that piece.
    pub generation: u32,
    /// Simulated time, s.
    pub time: f64,
    /// Largest approach speed of its contacts, m/s.
    pub approach_speed: f64,
    /// Kinetic energy of approach, J.
    pub approach_energy: f64,
    /// True if the body broke.
    pub broke: bool,
    /// Strength over the stress, or over an upper bound of it, if the body held.
    pub margin: Option<f64>,
}

impl BlowRecord {
    pub(crate) fn new(
        body: usize,
        generation: u32,
        time: f64,
        contacts: &[Contact],
        report: &ImpactReport,
        margin: Option<f64>,
    ) -> Self {
        let speeds = contacts.iter().map(|c| c.approach_speed);
        Self {
            body,
            generation,
            time,
            approach_speed: f64::from(speeds.fold(0.0_f32, f32::max)),
            approach_energy: report.approach_energy,
            broke: margin.is_none(),
            margin,
        }
    }
}

/// One break of a run.
#[derive(Clone, Debug)]
pub struct BreakRecord {
    /// Number of the body, from 0.
    pub body: usize,
    /// Generation of the broken body: 0 for the body itself, 1 for a piece of it, 2 for a piece of that piece.
    pub generation: u32,
    /// Simulated time, s.
    pub time: f64,
    /// The contacts, body frame.
    pub contacts: Vec<Contact>,
    /// Report of the break.
    pub report: ImpactReport,
    /// Masses of the pieces in descending order, kg.
    pub masses: Vec<f64>,
    /// Sum of the pieces' volumes, m³.
    pub volume: f64,
    /// Energy taken from the motion for the cracks, J.
    pub energy_paid: f64,
    /// Cause of the break.
    pub cause: BreakCause,
    /// Kinetic energy before the step of the break, J: of the body and of all bodies that it pushed in that step, directly or indirectly.
    pub kinetic_before: f64,
    /// Kinetic energy of the pieces and of the others after that step, J.
    pub kinetic_after: f64,
    /// Work of gravity on them in that step, J.
    pub work: f64,
    /// Fracture energy of the body and of those of the others that broke in the same step, J.
    pub cracks_together: f64,
}

/// Rounding of energies that are sums of f32, relative.
const ROUNDING: f64 = 1e-5;

impl BreakRecord {
    /// Describes a violation of energy conservation by the break, or returns `None`. The approach energy must not exceed the kinetic energy, the
    /// strain energy must not exceed the approach energy (plus friction), the crack energy must exceed neither, and kinetic and crack energy
    /// together must not exceed the kinetic energy before.
    #[must_use]
    pub fn energy_created(&self) -> Option<String> {
        let r = &self.report;
        let impact = self.cause == BreakCause::Impact;
        let above = |what: f64, limit: f64| what > limit * (1.0 + ROUNDING) + f64::MIN_POSITIVE;
        let (strain, approach, cracks) =
            (r.peak_strain_energy, r.approach_energy, r.fracture_energy);
        let slides = self.contacts.iter().any(|c| c.friction != Vec3::ZERO);
        if impact && !slides && above(strain, approach) {
            return Some(format!(
                "{strain} J of strain energy from an approach energy of {approach} J"
            ));
        }
        if impact && above(cracks, approach) {
            return Some(format!(
                "{cracks} J of crack energy from an approach energy of {approach} J"
            ));
        }
        if above(cracks, strain) {
            return Some(format!(
                "{cracks} J of crack energy from {strain} J of strain energy"
            ));
        }
        let before = self.kinetic_before + self.work.max(0.0);
        if impact && above(r.approach_energy, before) {
            let approach = r.approach_energy;
            return Some(format!(
                "{approach} J of approach energy from {before} J of kinetic energy and work"
            ));
        }
        // Cracks under a resting load are paid by the work of gravity that bent the body before.
        let after = self.kinetic_after + if impact { self.cracks_together } else { 0.0 };
        above(after, before).then(|| {
            format!(
                "{after} J of kinetic and crack energy from {before} J of kinetic energy and work"
            )
        })
    }
}

impl Run {
    /// The break of a body, if it broke.
    #[must_use]
    pub fn break_of(&self, body: usize) -> Option<&BreakRecord> {
        self.breaks.iter().find(|b| b.body == body)
    }

    /// The hardest impact that a body withstood.
    #[must_use]
    pub fn held_by(&self, body: usize) -> Option<&HeldRecord> {
        self.held.iter().find(|h| h.body == body)
    }
}
