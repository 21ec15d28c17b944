//! What came of a scene.

use frangible::{Contact, ImpactReport};
use frangible_export::Recording;

/// What came of a scene.
#[derive(Clone, Debug)]
pub struct Run {
    /// The animation.
    pub recording: Recording,
    /// The breaks, in the order of time.
    pub breaks: Vec<BreakRecord>,
    /// The hardest impact on each body that did not break it, if any, in the order of the bodies.
    pub held: Vec<HeldRecord>,
    /// Whether everything but projectiles lay still at the end.
    pub at_rest: bool,
    /// Simulated time, s.
    pub simulated: f64,
    /// Wall-clock time of the rigid bodies, without the fracture, s.
    pub rigid_seconds: f64,
}

/// An impact that did not break the body.
#[derive(Clone, Debug)]
pub struct HeldRecord {
    /// Number of the body, from 0.
    pub body: usize,
    /// The contacts, body frame.
    pub contacts: Vec<Contact>,
    /// What the fracture found.
    pub report: ImpactReport,
}

/// One break of a run.
#[derive(Clone, Debug)]
pub struct BreakRecord {
    /// Number of the body, from 0.
    pub body: usize,
    /// Simulated time, s.
    pub time: f64,
    /// The contacts, body frame.
    pub contacts: Vec<Contact>,
    /// How the break came about.
    pub report: ImpactReport,
    /// Masses of the pieces, kg, falling.
    pub masses: Vec<f64>,
    /// Sum of the pieces' volumes, m³.
    pub volume: f64,
    /// Energy taken from the motion for the cracks, J.
    pub energy_paid: f64,
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
