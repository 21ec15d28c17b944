//! Application of a result after the step: fragments replace the body at its current pose.
//!
//! The fragments start with the motion of the whole body, which includes the engine's impulse. If the impact is of the same step, the engine's
//! impulse is reverted and the impulse of the fracture model applied; then the energy of the cracks is taken, first from the energy lost in
//! the impact, then from the motion.

use rapier3d::dynamics::RigidBodyHandle;

use super::hit::HitBodies;
use crate::contact::contacts::Impact;
use crate::error::WorldError;
use crate::fragments::replace::Replacement;
use crate::impulses::blows::Meeting;
use crate::impulses::exchange::Families;
use crate::impulses::motion::kinetic_energy;
use crate::impulses::plain::take_energy;
use crate::impulses::settle::Broken;
use crate::stepping::answer::{Answer, Verdict};
use crate::world::{BreakableWorld, key};

impl BreakableWorld {
    /// Breaks an overloaded body that its load of the step just taken breaks.
    pub(super) fn give_way_to_load(
        &mut self,
        handle: RigidBodyHandle,
        before: &HitBodies,
    ) -> Result<(), WorldError> {
        let Some(answer) = self.judge_load(handle, before) else {
            return Ok(());
        };
        self.count(&answer);
        // A body that only cracks is dealt with when all loads are looked at.
        if let Ok(Verdict::Held(_)) = answer.verdict {
            return Ok(());
        }
        let obeyed = self.obey(answer, &[], &Families::new(), before);
        obeyed.map(|_| ())
    }

    /// Does what an answer says; returns the fragments of a body that broke. `blow`: what its contacts gave, where that is known
    /// in the step of the blow; `families`: what became of bodies that broke before it.
    pub(super) fn obey(
        &mut self,
        answer: Answer,
        blow: &[Meeting],
        families: &Families,
        before: &HitBodies,
    ) -> Result<Option<Vec<RigidBodyHandle>>, WorldError> {
        let Answer {
            body: handle,
            cause,
            impact,
            verdict,
        } = answer;
        let (fracture, parts) = match verdict? {
            Verdict::Held(outcome) => {
                return self.take_note(handle, impact, outcome).map(|()| None);
            }
            Verdict::Broke(fracture, parts) => (fracture, parts),
        };
        if !self.has_room(&fracture, 0, handle) {
            return Ok(None);
        }
        let Some(parent) = self.physics.bodies.get(handle).cloned() else {
            return Ok(None);
        };
        let Replacement {
            fragments,
            released,
        } = self.replace(handle, &parts);
        self.bind_film(&fracture, &fragments);
        let mut strikers = impact.strikers.clone();
        strikers.retain(|&s| self.physics.bodies.contains(s));
        // A striker that broke before has left its pieces in its place.
        let others: Vec<RigidBodyHandle> = (impact.strikers.iter())
            .flat_map(|&s| self.what_became_of(Some(s), families))
            .collect();
        let whole = kinetic_energy(&parent) + self.kinetic_energy_of(&others);
        let lost = self.replace_blows(&fracture, &fragments, blow, families, before);
        let cracks = fracture.report.fracture_energy;
        let lost = lost.clamp(0.0, cracks);
        let toll = cracks - lost;
        let paid = take_energy(&mut self.physics.bodies, &fragments, &others, toll);
        let after = self.kinetic_energy_of(&fragments) + self.kinetic_energy_of(&others);
        // Energy that the engine's blow took, and the blow that broke the body gave back, was there before the step.
        let moved = [handle].into_iter().chain(impact.strikers.iter().copied());
        let then: f64 = moved
            .filter_map(|h| before.get(&key(h)))
            .map(kinetic_energy)
            .sum();
        let first = if blow.is_empty() {
            whole
        } else {
            whole.max(then)
        };
        let made = fragments.clone();
        let broken = Broken {
            parent: handle,
            cause,
            fracture,
            parts,
            impact: Impact { strikers, ..impact },
            fragments,
            released,
            blow: Vec::new(),
            lost,
            alone: false,
        };
        if self.record(broken, Some(&parent), lost + paid)
            && let Some(event) = self.events.last_mut()
        {
            event.kinetic_before = first;
            event.kinetic_after = after;
        }
        Ok(Some(made))
    }

    fn kinetic_energy_of(&self, bodies: &[RigidBodyHandle]) -> f64 {
        let bodies = bodies.iter().filter_map(|&h| self.physics.bodies.get(h));
        bodies.map(kinetic_energy).sum()
    }

    /// The body held: its new cracks are its own from now on.
    fn take_note(
        &mut self,
        handle: RigidBodyHandle,
        impact: Impact,
        outcome: frangible::Outcome,
    ) -> Result<(), WorldError> {
        let Some(event) = self.held_event(handle, impact.contacts, outcome) else {
            return Ok(());
        };
        let state = event.state.clone();
        if self.config.record_held {
            self.held.push(event);
        }
        let Some(state) = state else { return Ok(()) };
        self.weigh_anew_one(handle);
        self.crack(handle, &state)
    }
}
