//! Answers of the fracture, and what follows from them.
//!
//! An impact or a load is a question to the fracture, and comes back as an [`Answer`]: the body held, perhaps with new cracks, or it
//! broke into these pieces. Whichever way a world breaks its bodies, the answer is counted, a break needs room for its pieces, and
//! cracks stay with the body.

use std::sync::Arc;

use frangible::internals::BodyState;
use frangible::internals::outcome::LookedAt;
use frangible::{Contact, Fracture, ImpactReport, Outcome};
use rapier3d::dynamics::RigidBodyHandle;

use crate::calm::motions::Before;
use crate::config::WorldConfig;
use crate::contact::contacts::Impact;
use crate::counts::held;
use crate::error::WorldError;
use crate::event::{BreakCause, HeldEvent};
use crate::fragments::replace::Parts;
use crate::impulses::blows::{Meeting, meetings};
use crate::world::{BreakableWorld, key};

/// Effect of an impact on a body.
#[expect(clippy::large_enum_variant, reason = "one per impact, soon gone")]
pub(crate) enum Verdict {
    /// It stays whole.
    Held(Outcome),
    /// Its pieces, and their shapes and masses.
    Broke(Arc<Fracture>, Parts),
}

impl Verdict {
    /// An outcome, with shapes for its pieces.
    ///
    /// # Errors
    /// A piece whose mass or moment of inertia is no positive number.
    pub(super) fn new(outcome: Outcome, config: &WorldConfig) -> Result<Self, WorldError> {
        match outcome {
            Outcome::Broke(fracture) if fracture.fragments.len() > 1 => {
                let parts = Parts::new(&fracture, config)?;
                Ok(Self::Broke(Arc::new(*fracture), parts))
            }
            outcome => Ok(Self::Held(outcome)),
        }
    }

    /// Depth to which the load was looked at; none where the body broke.
    fn held(&self) -> Option<LookedAt> {
        match self {
            Self::Held(outcome) => held(outcome),
            Self::Broke(..) => None,
        }
    }
}

/// An impact or a load on a body, and what the fracture says of it.
pub(crate) struct Answer {
    pub(super) body: RigidBodyHandle,
    pub(super) cause: BreakCause,
    pub(super) impact: Impact,
    pub(super) verdict: Result<Verdict, WorldError>,
}

impl BreakableWorld {
    /// Counts an answer, unless it is an error.
    pub(super) fn count(&mut self, answer: &Answer) {
        let Ok(verdict) = &answer.verdict else { return };
        let counts = match answer.cause {
            BreakCause::Rest => &mut self.state.rest_counts,
            _ => &mut self.state.impact_counts,
        };
        counts.count(answer.impact.contacts.len(), verdict.held());
    }

    /// Returns true if there is room for a body's fragments besides those `taken` already in this step.
    pub(crate) fn has_room(
        &mut self,
        fracture: &Fracture,
        taken: usize,
        handle: RigidBodyHandle,
    ) -> bool {
        let limit = self.config.max_bodies;
        let debris = self.state.debris.iter();
        let may_go = debris.filter(|&&piece| !self.state.rubble.contains(piece));
        let room = limit.saturating_sub(self.body_count()) + may_go.count();
        let fits = fracture.fragments.len() + taken <= room;
        if !fits {
            self.state.refused_breaks += 1;
            let name = self.breakable(handle).map_or("", |b| b.asset().name());
            log::warn!(
                "{} fragments of `{name}` exceed `max_bodies`; it stays whole",
                fracture.fragments.len()
            );
        }
        fits
    }

    /// Event of a body that held; none where it broke.
    pub(super) fn held_event(
        &self,
        body: RigidBodyHandle,
        contacts: Vec<Contact>,
        outcome: Outcome,
    ) -> Option<HeldEvent> {
        let Outcome::Held {
            margin,
            report,
            state,
        } = outcome
        else {
            return None;
        };
        Some(HeldEvent {
            step: self.state.steps,
            body,
            contacts,
            margin,
            report,
            state: state.map(|s| *s),
        })
    }

    /// Gives a body the cracks that a blow or load left.
    pub(crate) fn crack(
        &mut self,
        handle: RigidBodyHandle,
        state: &BodyState,
    ) -> Result<(), WorldError> {
        if let Some(body) = self.state.breakables.get_mut(&key(handle)) {
            body.set_state(state.clone())?;
            self.expect_weaker(handle);
        }
        Ok(())
    }

    /// Impulses between a body and its strikers, from a blow that was integrated.
    pub(super) fn meetings(
        &self,
        handle: RigidBodyHandle,
        before: &impl Before,
        impact: &Impact,
        report: &ImpactReport,
    ) -> Vec<Meeting> {
        let model = self.config.fracture.duration;
        before.body(handle).map_or_else(Vec::new, |body| {
            meetings(handle, body.position(), impact, report, model)
        })
    }
}
