//! The last contact that mattered, with all it takes to let it happen again.

use std::sync::Arc;

use frangible::{Body, Contact, Fracture, FractureConfig, ImpactReport};
use frangible_rapier::BreakCause;
use frangible_recording::Pose;

/// An impact on a body, and its outcome.
#[derive(Clone, Debug)]
pub struct Blow {
    /// Name of the body that was hit.
    pub name: String,
    /// Its number among the things of the scene.
    pub thing: usize,
    /// Its number among the scene's bodies; none for a piece.
    pub number: Option<usize>,
    /// The body before it, with the cracks it had.
    pub body: Body,
    /// Pose of the body at that time.
    pub pose: Pose,
    /// Contacts, in the body's frame.
    pub contacts: Vec<Contact>,
    /// Cause of the break.
    pub cause: BreakCause,
    /// Settings of the fracture model at that time.
    pub config: FractureConfig,
    /// Numbers of the impact.
    pub report: ImpactReport,
    /// The pieces; none where it held.
    pub fracture: Option<Arc<Fracture>>,
    /// Energy taken from the motion for the cracks, J.
    pub energy_paid: f64,
    /// Simulated time, s.
    pub time: f64,
}

impl Blow {
    /// Impulse of all contacts, N·s.
    #[must_use]
    pub fn impulse(&self) -> f32 {
        self.contacts.iter().map(|contact| contact.impulse).sum()
    }

    /// Pieces it left.
    #[must_use]
    pub fn pieces(&self) -> usize {
        self.fracture.as_ref().map_or(1, |f| f.fragments.len())
    }

    /// Returns true if the fracture can be computed again: it is an impact with contacts.
    #[must_use]
    pub fn is_repeatable(&self) -> bool {
        self.cause == BreakCause::Impact && self.impulse() > 0.0
    }
}
