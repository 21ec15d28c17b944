//! Breaks after the step, within a budget: for scenes of hundreds of bodies.
//!
//! The step stands. A whole body takes its blow, and gives way to its fragments when its turn comes, at the motion it has
//! then: momentum, angular momentum and energy are those of the whole body, and the cracks' energy is taken from the
//! motion as ever. Work is counted in tetrahedra, not in time, so that the same bodies break in the same step on any machine.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use rapier3d::dynamics::{RigidBody, RigidBodyHandle};

use crate::contacts::{Impact, Surfaces, impact_on};
use crate::counts::held;
use crate::error::WorldError;
use crate::event::{BreakCause, HeldEvent};
use crate::guard::put_back;
use crate::judge::{Case, Verdict, verdict};
use crate::motion::kinetic_energy;
use crate::settle::Broken;
use crate::timings::Watch;
use crate::toll::take_energy;
use crate::world::{BreakableWorld, Key, key};

/// Bodies as they were before the step, those that were hit and what hit them.
pub(crate) type HitBodies = BTreeMap<Key, RigidBody>;

/// A body that waits to be put to the fracture, and its hardest blow so far.
#[derive(Clone, Debug)]
pub(crate) struct Waiting {
    pub(crate) body: RigidBodyHandle,
    pub(crate) impact: Impact,
    /// Tetrahedra to look at; none where a quick bound refuses the impact.
    pub(crate) cost: usize,
}

impl BreakableWorld {
    /// Bodies that were hit and wait for their turn, the first in line first: see
    /// [`Breaking::AfterStep`](crate::Breaking::AfterStep).
    pub fn waiting(&self) -> impl Iterator<Item = RigidBodyHandle> {
        let judged = self.cases.iter().map(|case| case.body);
        judged.chain(self.waiting.iter().map(|w| w.body))
    }

    /// A step of Rapier, and what it broke.
    pub(crate) fn step_then_break(
        &mut self,
        budget: usize,
        delay: usize,
    ) -> Result<(), WorldError> {
        let mut watch = Watch::start();
        self.motions.note(&self.physics.bodies);
        let weighs = self.weighs_now();
        let overloaded: Vec<RigidBodyHandle> = if weighs {
            self.overloaded().collect()
        } else {
            Vec::new()
        };
        let centres = self.guarded_centres();
        self.timings.upkeep += watch.lap();
        self.advance();
        watch.lap();
        put_back(&mut self.physics, &centres);
        self.timings.upkeep += watch.lap();
        let before = self.hit_bodies(&overloaded);
        let blows = self.blows(&before);
        self.queue(blows);
        self.timings.contacts += watch.lap();
        self.upkeep();
        watch.lap();
        let weighed = if weighs {
            self.weigh(Some(&before))
        } else {
            Ok(())
        };
        self.timings.loads += watch.lap();
        let mut done = Ok(());
        for handle in overloaded {
            done = done.and(self.give_way_to_load(handle, &before));
        }
        done.and(self.serve(budget, delay))
            .and(self.conclude())
            .and(weighed)
    }

    /// Bodies that may have been hit in the step just taken, with what touches them; and the overloaded ones.
    fn hit_bodies(&self, overloaded: &[RigidBodyHandle]) -> HitBodies {
        let physics = &self.physics;
        let parent = |c| physics.colliders.get(c).and_then(|c| c.parent());
        let breakable = |h: &RigidBodyHandle| self.breakables.contains_key(&key(*h));
        let mut hit: BTreeSet<Key> = overloaded.iter().map(|&h| key(h)).collect();
        for pair in physics.narrow_phase.contact_pairs() {
            let (a, b) = (parent(pair.collider1), parent(pair.collider2));
            if self.motions.may_meet_at(self.config.impact_speed, a, b)
                && [a, b].iter().flatten().any(breakable)
                && pair.has_any_active_contact()
            {
                hit.extend(
                    [a, b]
                        .iter()
                        .flatten()
                        .filter(|h| breakable(h))
                        .map(|&h| key(h)),
                );
            }
        }
        let mut bodies = HitBodies::new();
        let mut note = |handle: RigidBodyHandle| {
            if !bodies.contains_key(&key(handle))
                && let Some(body) = self.motions.body_before(physics, handle)
            {
                bodies.insert(key(handle), body);
            }
        };
        for (index, generation) in hit {
            let handle = RigidBodyHandle::from_raw_parts(index, generation);
            note(handle);
            let colliders = physics
                .bodies
                .get(handle)
                .map_or(&[][..], |b| b.colliders());
            for &collider in colliders {
                for pair in physics.narrow_phase.contact_pairs_with(collider) {
                    [pair.collider1, pair.collider2]
                        .into_iter()
                        .filter_map(parent)
                        .for_each(&mut note);
                }
            }
        }
        bodies
    }

    /// Blows on the breakable ones among these bodies, in the order of their handles.
    fn blows(&self, before: &HitBodies) -> Vec<Waiting> {
        let surfaces = Surfaces {
            bodies: &self.surfaces,
            colliders: &self.collider_surfaces,
            breakables: &self.breakables,
        };
        let hit = before
            .keys()
            .filter(|key| self.breakables.contains_key(key));
        let blows = hit.map(|&(index, generation)| {
            let body = RigidBodyHandle::from_raw_parts(index, generation);
            let impact = impact_on(body, &self.physics, before, &surfaces, &self.config);
            let cost = self.work(body, &impact);
            Waiting { body, impact, cost }
        });
        blows.filter(|w| !w.impact.contacts.is_empty()).collect()
    }

    /// New blows go to the end of the line; a harder one on a body that waits takes the place of the old one.
    fn queue(&mut self, blows: Vec<Waiting>) {
        let size = |impact: &Impact| impact.contacts.iter().map(|c| c.impulse).sum::<f32>();
        for blow in blows {
            match self.waiting.iter_mut().find(|w| w.body == blow.body) {
                Some(known) if size(&blow.impact) > size(&known.impact) => *known = blow,
                Some(_) => {}
                None => self.waiting.push_back(blow),
            }
        }
    }

    /// Puts those first in line to the fracture: at once, or elsewhere until `delay` steps from now.
    fn serve(&mut self, budget: usize, delay: usize) -> Result<(), WorldError> {
        let mut watch = Watch::start();
        let mut line: VecDeque<Waiting> = std::mem::take(&mut self.waiting);
        line.retain(|w| self.breakables.contains_key(&key(w.body)));
        let (mut cheap, mut dear, mut later) = (Vec::new(), Vec::new(), VecDeque::new());
        let mut work = 0_usize;
        for Waiting { body, impact, cost } in line {
            let busy = self.cases.iter().any(|case| case.body == body);
            if cost == 0 && !busy {
                cheap.push((body, impact));
            } else if !busy && (work == 0 || work.saturating_add(cost) <= budget) {
                work += cost;
                dear.push((body, impact));
            } else {
                // First come, first served: whoever comes after one that must wait for the budget waits too.
                work = if busy { work } else { usize::MAX };
                later.push_back(Waiting { body, impact, cost });
            }
        }
        self.waiting = later;
        let mut done = Ok(());
        if delay == 0 {
            cheap.extend(dear);
        } else {
            let due = self.steps + delay as u64;
            for (body, impact) in dear {
                match self.judge_elsewhere(body, impact, due) {
                    Ok(case) => self.cases.push_back(case),
                    Err(error) => done = done.and(Err(error)),
                }
            }
        }
        let verdicts = self.judge(&cheap);
        self.timings.fracture += watch.lap();
        for ((body, impact), verdict) in cheap.into_iter().zip(verdicts) {
            if let Ok(verdict) = &verdict {
                let contacts = impact.contacts.len();
                self.impact_counts.count(contacts, verdict.held());
            }
            let obeyed = verdict.and_then(|v| self.obey(body, BreakCause::Impact, impact, v));
            done = done.and(obeyed);
        }
        self.timings.fragments += watch.lap();
        done
    }

    /// Does what was decided elsewhere and is due.
    fn conclude(&mut self) -> Result<(), WorldError> {
        let mut watch = Watch::start();
        let mut done = Ok(());
        // What no other thread has begun with is done here, rather than waited for.
        let due = self.cases.iter().take_while(|case| case.due <= self.steps);
        due.for_each(Case::help);
        while let Some(case) = self.cases.pop_front_if(|case| case.due <= self.steps) {
            let verdict = case.verdict();
            if let Ok(verdict) = &verdict {
                let contacts = case.impact.contacts.len();
                self.impact_counts.count(contacts, verdict.held());
            }
            self.timings.fracture += watch.lap();
            if self.breakables.contains_key(&key(case.body)) {
                let cause = BreakCause::Impact;
                let obeyed = verdict.and_then(|v| self.obey(case.body, cause, case.impact, v));
                done = done.and(obeyed);
            }
            self.timings.fragments += watch.lap();
        }
        done
    }

    fn work(&self, handle: RigidBodyHandle, impact: &Impact) -> usize {
        let Some(body) = self.breakables.get(&key(handle)) else {
            return 0;
        };
        let cleared = self.clears_quickly
            && frangible::is_harmless(body, &impact.contacts, &self.config.fracture);
        if cleared {
            0
        } else {
            body.asset().embedding.tets.len().max(1)
        }
    }

    fn give_way_to_load(
        &mut self,
        handle: RigidBodyHandle,
        before: &HitBodies,
    ) -> Result<(), WorldError> {
        let Some(body) = self.breakables.get(&key(handle)) else {
            return Ok(());
        };
        let Some(asked) = self.breaking_load(handle, body, before) else {
            return Ok(());
        };
        let (load, outcome) = asked?;
        self.rest_counts.count(load.contacts.len(), held(&outcome));
        match verdict(outcome, &self.config)? {
            // What only cracks is dealt with when all loads are looked at.
            Verdict::Held(_) => Ok(()),
            broke => self.obey(handle, BreakCause::Rest, load, broke),
        }
    }

    fn obey(
        &mut self,
        handle: RigidBodyHandle,
        cause: BreakCause,
        impact: Impact,
        verdict: Verdict,
    ) -> Result<(), WorldError> {
        let (fracture, parts) = match verdict {
            Verdict::Held(outcome) => return self.take_note(handle, impact, outcome),
            Verdict::Broke(fracture, parts) => (fracture, parts),
        };
        if !self.has_room(&fracture, 0, handle) {
            return Ok(());
        }
        let Some(parent) = self.physics.bodies.get(handle).cloned() else {
            return Ok(());
        };
        let fragments = self.replace(handle, &parts);
        let mut strikers = impact.strikers.clone();
        strikers.retain(|&s| self.physics.bodies.contains(s));
        let others = self.kinetic_energy_of(&strikers);
        let toll = fracture.report.fracture_energy;
        let paid = take_energy(&mut self.physics.bodies, &fragments, &strikers, toll);
        let after = self.kinetic_energy_of(&fragments) + self.kinetic_energy_of(&strikers);
        let broken = Broken {
            parent: handle,
            cause,
            fracture,
            parts,
            impact: Impact { strikers, ..impact },
            fragments,
        };
        if self.record(broken, Some(&parent), paid)
            && let Some(event) = self.events.last_mut()
        {
            event.kinetic_before = kinetic_energy(&parent) + others;
            event.kinetic_after = after;
        }
        Ok(())
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
        let frangible::Outcome::Held {
            margin,
            report,
            state,
        } = outcome
        else {
            return Ok(());
        };
        let state = state.map(|s| *s);
        if self.config.record_held {
            self.held.push(HeldEvent {
                step: self.steps,
                body: handle,
                contacts: impact.contacts,
                margin,
                report,
                state: state.clone(),
            });
        }
        let Some(state) = state else { return Ok(()) };
        self.weigh_anew_one(handle);
        self.crack(handle, &state)
    }
}
