//! Breaks after the step, within a budget: for scenes of hundreds of bodies.
//!
//! The step stands. A whole body takes its blow, and gives way to its fragments when its turn comes, at the motion it has
//! then: momentum, angular momentum and energy are those of the whole body, and the cracks' energy is taken from the
//! motion as ever. Where the verdict comes in the step of the blow, the blow's impulse takes the place of the engine's
//! (`exchange.rs`); a body that waited, or was judged elsewhere, keeps what the engine gave it, since by then the bodies are
//! elsewhere. Work is counted in tetrahedra, not in time, so that the same bodies break in the same step on any machine.
//!
//! A heap costs what its colliders have parts, so the cell shares of a piece are merged to 12 of at most 48 points each.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use rapier3d::dynamics::{RigidBody, RigidBodyHandle};

use crate::callbacks::Callbacks;
use crate::calm::guard::put_back;
use crate::contact::contacts::{Impact, Surfaces, impact_on};
use crate::counts::held;
use crate::error::WorldError;
use crate::event::{BreakCause, HeldEvent};
use crate::fragments::replace::Replacement;
use crate::impulses::blows::{Meeting, meetings, share_out};
use crate::impulses::exchange::Families;
use crate::impulses::motion::kinetic_energy;
use crate::impulses::plain::take_energy;
use crate::impulses::settle::Broken;
use crate::stepping::judge::{Case, Verdict, verdict};
use crate::timings::Watch;
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
    /// Number of the step of the blow.
    pub(crate) step: u64,
}

impl BreakableWorld {
    /// Bodies that were hit and wait for their turn, the first in line first: see
    /// [`Breaking::AfterStep`](crate::Breaking::AfterStep).
    pub fn waiting(&self) -> impl Iterator<Item = RigidBodyHandle> {
        let judged = self.cases.iter().map(|case| case.body);
        judged.chain(self.state.waiting.iter().map(|w| w.body))
    }

    /// A step of Rapier, and what it broke.
    pub(crate) fn step_then_break(
        &mut self,
        budget: usize,
        delay: usize,
        caller: Callbacks<'_>,
    ) -> Result<(), WorldError> {
        let mut watch = Watch::start();
        self.state.motions.note(&self.physics.bodies);
        let weighs = self.weighs_now();
        let overloaded: Vec<RigidBodyHandle> = if weighs {
            self.overloaded().collect()
        } else {
            Vec::new()
        };
        let centres = self.guarded_centres();
        self.timings.upkeep += watch.lap();
        self.advance(caller);
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
        done.and(self.serve(budget, delay, &before))
            .and(self.conclude())
            .and(weighed)
    }

    /// Bodies that may have been hit in the step just taken, with what touches them; and the overloaded ones.
    fn hit_bodies(&self, overloaded: &[RigidBodyHandle]) -> HitBodies {
        let physics = &self.physics;
        let parent = |c| physics.colliders.get(c).and_then(|c| c.parent());
        let breakable = |h: &RigidBodyHandle| self.state.breakables.contains_key(&key(*h));
        let mut hit: BTreeSet<Key> = overloaded.iter().map(|&h| key(h)).collect();
        for pair in physics.narrow_phase.contact_pairs() {
            let (a, b) = (parent(pair.collider1), parent(pair.collider2));
            if self
                .state
                .motions
                .may_meet_at(self.config.impact_speed, a, b)
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
                && let Some(body) = self.state.motions.body_before(physics, handle)
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
            bodies: &self.state.surfaces,
            colliders: &self.state.collider_surfaces,
            breakables: &self.state.breakables,
        };
        let hit = before
            .keys()
            .filter(|key| self.state.breakables.contains_key(key));
        let blows = hit.map(|&(index, generation)| {
            let body = RigidBodyHandle::from_raw_parts(index, generation);
            let impact = impact_on(body, &self.physics, before, &surfaces, &self.config);
            let cost = self.work(body, &impact);
            Waiting {
                body,
                impact,
                cost,
                step: self.state.steps,
            }
        });
        blows.filter(|w| !w.impact.contacts.is_empty()).collect()
    }

    /// New blows go to the end of the line; a harder one on a body that waits takes the place of the old one.
    fn queue(&mut self, blows: Vec<Waiting>) {
        let size = |impact: &Impact| impact.contacts.iter().map(|c| c.impulse).sum::<f32>();
        for blow in blows {
            match self.state.waiting.iter_mut().find(|w| w.body == blow.body) {
                Some(known) if size(&blow.impact) > size(&known.impact) => *known = blow,
                Some(_) => {}
                None => self.state.waiting.push_back(blow),
            }
        }
    }

    /// Puts those first in line to the fracture: at once, or elsewhere until `delay` steps from now.
    fn serve(&mut self, budget: usize, delay: usize, before: &HitBodies) -> Result<(), WorldError> {
        let mut watch = Watch::start();
        let mut line: VecDeque<Waiting> = std::mem::take(&mut self.state.waiting);
        line.retain(|w| self.state.breakables.contains_key(&key(w.body)));
        let (mut cheap, mut dear, mut later) = (Vec::new(), Vec::new(), VecDeque::new());
        let mut work = 0_usize;
        let mut fresh: BTreeSet<Key> = BTreeSet::new();
        for waiting in line {
            let busy = self.cases.iter().any(|case| case.body == waiting.body);
            let Waiting {
                body, cost, step, ..
            } = waiting;
            if step == self.state.steps {
                fresh.insert(key(body));
            }
            if cost == 0 && !busy {
                cheap.push((body, waiting.impact));
            } else if !busy && (work == 0 || work.saturating_add(cost) <= budget) {
                work += cost;
                dear.push((body, waiting.impact));
            } else {
                // First come, first served: whoever comes after one that must wait for the budget waits too.
                work = if busy { work } else { usize::MAX };
                later.push_back(waiting);
            }
        }
        self.state.waiting = later;
        let mut done = Ok(());
        if delay == 0 {
            cheap.extend(dear);
        } else {
            let due = self.state.steps + delay as u64;
            for (body, impact) in dear {
                match self.judge_elsewhere(body, impact, due) {
                    Ok(case) => self.cases.push_back(case),
                    Err(error) => done = done.and(Err(error)),
                }
            }
        }
        let verdicts = self.judge(&cheap);
        self.timings.fracture += watch.lap();
        let mut blows = self.fresh_blows(&cheap, &verdicts, &fresh, before);
        let mut families = Families::new();
        for ((body, impact), verdict) in cheap.into_iter().zip(verdicts) {
            if let Ok(verdict) = &verdict {
                let contacts = impact.contacts.len();
                self.state.impact_counts.count(contacts, verdict.held());
            }
            let blow = blows.remove(&key(body)).unwrap_or_default();
            let obeyed = verdict.and_then(|v| {
                self.obey(
                    body,
                    BreakCause::Impact,
                    impact,
                    v,
                    &blow,
                    &families,
                    before,
                )
            });
            match obeyed {
                Ok(Some(fragments)) => {
                    families.insert(key(body), fragments);
                }
                Ok(None) => {}
                Err(error) => done = done.and(Err(error)),
            }
        }
        self.timings.fragments += watch.lap();
        done
    }

    /// What blows of the step just taken say of the impulses between bodies: those that held give it at once, those of bodies
    /// that break are returned. A verdict that comes later finds the bodies elsewhere: there the engine's blow stands.
    fn fresh_blows(
        &mut self,
        questions: &[(RigidBodyHandle, Impact)],
        verdicts: &[Result<Verdict, WorldError>],
        fresh: &BTreeSet<Key>,
        before: &HitBodies,
    ) -> BTreeMap<Key, Vec<Meeting>> {
        let model = self.config.fracture.duration;
        let (mut held, mut broke) = (Vec::new(), BTreeMap::new());
        for ((handle, impact), verdict) in questions.iter().zip(verdicts) {
            let Some(body) = before.get(&key(*handle)) else {
                continue;
            };
            if !fresh.contains(&key(*handle)) {
                continue;
            }
            let pose = body.position();
            match verdict {
                Ok(Verdict::Held(outcome)) => {
                    held.extend(meetings(*handle, pose, impact, outcome.report(), model));
                }
                Ok(Verdict::Broke(fracture, _)) => {
                    let blow = meetings(*handle, pose, impact, &fracture.report, model);
                    broke.insert(key(*handle), blow);
                }
                Err(_) => {}
            }
        }
        // Of two bodies that met, the one that breaks says how long the other pushed.
        held.retain(|m: &Meeting| m.partner.is_none_or(|p| !broke.contains_key(&key(p))));
        share_out(&mut broke.values_mut().flatten().collect::<Vec<_>>());
        self.give_blows(held, before);
        broke
    }

    /// Does what was decided elsewhere and is due.
    fn conclude(&mut self) -> Result<(), WorldError> {
        let mut watch = Watch::start();
        let mut done = Ok(());
        // What no other thread has begun with is done here, rather than waited for.
        let due = self
            .cases
            .iter()
            .take_while(|case| case.due <= self.state.steps);
        due.for_each(Case::help);
        while let Some(case) = self.cases.pop_front_if(|case| case.due <= self.state.steps) {
            let verdict = case.verdict();
            if let Ok(verdict) = &verdict {
                let contacts = case.impact.contacts.len();
                self.state.impact_counts.count(contacts, verdict.held());
            }
            self.timings.fracture += watch.lap();
            if self.state.breakables.contains_key(&key(case.body)) {
                let (cause, late) = (BreakCause::Impact, HitBodies::new());
                let obeyed = verdict.and_then(|v| {
                    let none = Families::new();
                    self.obey(case.body, cause, case.impact, v, &[], &none, &late)
                });
                done = done.and(obeyed.map(|_| ()));
            }
            self.timings.fragments += watch.lap();
        }
        done
    }

    fn work(&self, handle: RigidBodyHandle, impact: &Impact) -> usize {
        let Some(body) = self.state.breakables.get(&key(handle)) else {
            return 0;
        };
        let cleared = self.clears_quickly
            && frangible::internals::is_harmless(body, &impact.contacts, &self.config.fracture);
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
        let Some(body) = self.state.breakables.get(&key(handle)) else {
            return Ok(());
        };
        let Some(asked) = self.breaking_load(handle, body, before) else {
            return Ok(());
        };
        let (load, outcome) = asked?;
        self.state
            .rest_counts
            .count(load.contacts.len(), held(&outcome));
        match verdict(outcome, &self.config)? {
            // What only cracks is dealt with when all loads are looked at.
            Verdict::Held(_) => Ok(()),
            broke => {
                let none = Families::new();
                let obeyed = self.obey(handle, BreakCause::Rest, load, broke, &[], &none, before);
                obeyed.map(|_| ())
            }
        }
    }

    /// Does what a verdict says; returns the fragments of a body that broke. `blow`: what its contacts gave, where that is known
    /// in the step of the blow; `families`: what became of bodies that broke before it.
    #[expect(clippy::too_many_arguments, reason = "all of one question")]
    fn obey(
        &mut self,
        handle: RigidBodyHandle,
        cause: BreakCause,
        impact: Impact,
        verdict: Verdict,
        blow: &[Meeting],
        families: &Families,
        before: &HitBodies,
    ) -> Result<Option<Vec<RigidBodyHandle>>, WorldError> {
        let (fracture, parts) = match verdict {
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
        let mut strikers = impact.strikers.clone();
        strikers.retain(|&s| self.physics.bodies.contains(s));
        // What met a body that broke before it meets that one's pieces.
        let others: Vec<RigidBodyHandle> = (impact.strikers.iter())
            .flat_map(|&s| self.what_became_of(Some(s), families))
            .collect();
        let energy =
            |world: &Self| world.kinetic_energy_of(&fragments) + world.kinetic_energy_of(&others);
        let whole = kinetic_energy(&parent) + self.kinetic_energy_of(&others);
        let mut lost = 0.0;
        for meeting in blow {
            lost += self.replace_blow(&fracture, &fragments, meeting, families, before);
        }
        let cracks = fracture.report.fracture_energy;
        let lost = lost.clamp(0.0, cracks);
        let toll = cracks - lost;
        let paid = take_energy(&mut self.physics.bodies, &fragments, &others, toll);
        let after = energy(self);
        // What the engine's blow took, and the blow that broke the body gave back, was there before the step.
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
                step: self.state.steps,
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
