//! THE step: bodies break inside it.
//!
//! Theory §4a and §6. A step that may see an impact (see `approach.rs`) begins with a copy of the world. After it, each
//! impact is put to the fracture. If a body broke: back to the copy, fragments in its place with the velocities
//! from before the impact, the blow's own impulse between the pieces and the striker, and the step is taken again, so that the
//! striker meets fragments instead of a body that is gone, and the engine resolves only what still approaches. If the bodies
//! held, the blow's impulses take the place of the engine's (`exchange.rs`). Several bodies may break in a step; a body that is
//! only hit in the repeated step is asked then, up to [`MAX_REPEATS`] times, and its blow counts only in the step that
//! stands. Fragments are not asked in the step of their birth (`pieces.rs`). What bodies carry is asked after
//! every step (`resting.rs`); blasts and scripted blows come before it (`pushes.rs`).

use std::collections::BTreeMap;

use frangible::internals::BodyState;
use frangible::{Fracture, ImpactReport, Outcome};
use rapier3d::dynamics::{RigidBodyHandle, RigidBodySet};
use rapier3d::pipeline::{EventHandler, PhysicsHooks};

use crate::approach::candidates;
use crate::blows::{Meeting, meetings};
use crate::callbacks::{Callbacks, Held, Hooks};
use crate::config::Breaking;
use crate::contacts::{Impact, Surfaces, impact_on};
use crate::error::WorldError;
use crate::event::{BreakCause, BreakEvent, HeldEvent};
use crate::guard::{Centres, centres, put_back};
use crate::judge::{Verdict, verdict};
use crate::replace::Replacement;
use crate::rolling::resist_rolling;
use crate::settle::Broken;
use crate::snapshot::Snapshot;
use crate::timings::{StepTimings, Watch};
use crate::world::{BreakableWorld, Key, key};

/// A step is undone at most so often; a body that would break only after that breaks in a later step.
const MAX_REPEATS: usize = 4;

/// Solver iterations of a step with newborn fragments, in units of an ordinary step's. Measured with 100 fragments:
/// 1, 2, 4 cost 5.0, 7.0, 8.2 ms for the whole breaking step; below 4, pieces left wedged gain energy afterwards.
const BREAK_ITERATIONS: usize = 4;

/// What was asked of the fracture in this step.
#[derive(Default)]
struct Asked {
    broken: Vec<Broken>,
    held: BTreeMap<Key, (Impact, HeldEvent)>,
    /// Blows of the step last taken that held.
    standing: Vec<Meeting>,
    error: Option<WorldError>,
}

/// What an impact or a load does to a body.
struct Answer {
    body: RigidBodyHandle,
    cause: BreakCause,
    impact: Impact,
    verdict: Result<Verdict, WorldError>,
}

impl BreakableWorld {
    /// Advances by one time step; returns the breaks in it.
    ///
    /// # Errors
    /// The fracture refused an asset or a contact. The step is complete and the body whole: go on, or remove it.
    pub fn step(&mut self) -> Result<&[BreakEvent], WorldError> {
        self.step_for(Callbacks::NONE)
    }

    /// [`step`](Self::step) with hooks and an event handler of the caller's own, as Rapier's pipeline takes them.
    ///
    /// A step in which a body breaks is undone and taken again. Events of an undone step are dropped; those of the step that stands come
    /// once it does, in the order in which Rapier spoke. Hooks are asked in every step taken. Colliders of fragments inherit
    /// what hooks and events their body's collider asked for, and have [`ActiveHooks::MODIFY_SOLVER_CONTACTS`] of our own, so
    /// `modify_solver_contacts` is asked of fragments in any case.
    ///
    /// # Errors
    /// Those errors that [`step`](Self::step) has.
    ///
    /// [`ActiveHooks::MODIFY_SOLVER_CONTACTS`]: rapier3d::pipeline::ActiveHooks::MODIFY_SOLVER_CONTACTS
    pub fn step_with(
        &mut self,
        hooks: &dyn PhysicsHooks,
        events: &dyn EventHandler,
    ) -> Result<&[BreakEvent], WorldError> {
        self.step_for(Callbacks { hooks, events })
    }

    fn step_for(&mut self, caller: Callbacks<'_>) -> Result<&[BreakEvent], WorldError> {
        let mut watch = Watch::start();
        self.timings = StepTimings::default();
        self.events.clear();
        self.held.clear();
        self.forget_removed();
        self.siblings.step = self.steps;
        self.siblings.relaxation =
            self.config.overlap_relaxation * self.physics.integration_parameters.dt;
        self.join_pieces();
        let pushed = self.apply_pushes();
        self.timings.upkeep += watch.lap();
        let done = match self.config.breaking {
            Breaking::InsideStep => self.step_breaking_inside(caller),
            Breaking::AfterStep { budget, delay } => self.step_then_break(budget, delay, caller),
        };
        self.steps += 1;
        pushed.and(done).map(|()| &*self.events)
    }

    fn step_breaking_inside(&mut self, caller: Callbacks<'_>) -> Result<(), WorldError> {
        let mut watch = Watch::start();
        let near = self.near();
        self.timings.copies += watch.lap();
        let (asked, before) = if near.is_empty() {
            let centres = self.guarded_centres();
            self.timings.upkeep += watch.lap();
            self.advance(caller);
            watch.lap();
            put_back(&mut self.physics, &centres);
            self.timings.upkeep += watch.lap();
            (Asked::default(), None)
        } else {
            let (asked, before) = self.step_with_breaks(near, caller);
            (asked, Some(before))
        };
        self.upkeep();
        watch.lap();
        let asked = self.keep_cracks(asked);
        // A break's impulses are no weight either.
        let weighed = if self.weighs_now() && self.events.is_empty() {
            self.weigh(before.as_ref())
        } else {
            Ok(())
        };
        self.timings.loads += watch.lap();
        asked.and(weighed)
    }

    /// Rolling, rest, debris.
    pub(crate) fn upkeep(&mut self) {
        let mut watch = Watch::start();
        // A break's impulses are a blow, not a weight that rolls; its energy is settled already.
        if self.events.is_empty() {
            resist_rolling(&mut self.physics, self.config.rolling_arm);
        }
        if self.config.rest_drift > 0.0 {
            self.places.rest(&mut self.physics, self.config.rest_drift);
        }
        self.part_mortar();
        self.limit_debris(self.config.max_debris);
        self.settle_dust();
        self.timings.upkeep += watch.lap();
    }

    /// Bodies that held keep the cracks they got.
    fn keep_cracks(&mut self, mut asked: Asked) -> Result<(), WorldError> {
        for (_, event) in asked.held.values() {
            if let Some(state) = &event.state
                && let Err(error) = self.crack(event.body, state)
            {
                asked.error.get_or_insert(error);
            }
        }
        if asked.held.values().any(|(_, event)| event.state.is_some()) {
            self.weigh_anew();
        }
        if self.config.record_held {
            self.held
                .extend(asked.held.into_values().map(|(_, event)| event));
        }
        asked.error.map_or(Ok(()), Err)
    }

    /// Gives a body the cracks that a blow or load left.
    pub(crate) fn crack(
        &mut self,
        handle: RigidBodyHandle,
        state: &BodyState,
    ) -> Result<(), WorldError> {
        if let Some(body) = self.breakables.get_mut(&key(handle)) {
            body.set_state(state.clone())?;
            self.expect_weaker(handle);
        }
        Ok(())
    }

    /// Breakable bodies that may be hit in the coming step, or break under what they carry; in the order of handles.
    fn near(&self) -> Vec<RigidBodyHandle> {
        let mut near = candidates(&self.physics, self.breakables(), self.config.impact_speed);
        if self.weighs_now() {
            let overloaded = self.overloaded().filter(|&h| self.breakable(h).is_some());
            let new: Vec<RigidBodyHandle> = overloaded.filter(|h| !near.contains(h)).collect();
            if !new.is_empty() {
                near.extend(new);
                near.sort_by_key(|&h| key(h));
            }
        }
        near
    }

    /// Breakable bodies that may be hit hard enough to be looked at, or give way to what they carry, within so many seconds:
    /// as long as there are none, steps may be coarse.
    pub fn near_within(&mut self, seconds: f32) -> Vec<RigidBodyHandle> {
        let dt = std::mem::replace(&mut self.physics.integration_parameters.dt, seconds);
        let near = self.near();
        self.physics.integration_parameters.dt = dt;
        near
    }

    pub(crate) fn advance(&mut self, caller: Callbacks<'_>) {
        // Fragments of a blast are newborn when the step begins.
        if self.events.is_empty() {
            self.advance_plainly(caller);
        } else {
            self.advance_finely(caller);
        }
    }

    fn advance_plainly(&mut self, caller: Callbacks<'_>) {
        let mut watch = Watch::start();
        let hooks = Hooks {
            own: caller.hooks,
            siblings: &self.siblings,
        };
        self.physics.step_with_events(&hooks, caller.events);
        self.timings.rigid += watch.lap();
    }

    pub(crate) fn guarded_centres(&self) -> Centres {
        centres(
            &self.physics,
            (self.siblings.fragments())
                .filter(|&h| self.breakable(h).is_none())
                .chain(self.breakables()),
        )
    }

    /// A step with fragments just born: a blow runs through a chain of them, one link per solver iteration. With
    /// too few a piece between floor and chain is squeezed through a thin floor.
    fn advance_finely(&mut self, caller: Callbacks<'_>) {
        let iterations = self.physics.integration_parameters.num_solver_iterations;
        self.physics.integration_parameters.num_solver_iterations = BREAK_ITERATIONS * iterations;
        self.advance_plainly(caller);
        self.physics.integration_parameters.num_solver_iterations = iterations;
    }

    /// The step, and the bodies as they were before it.
    fn step_with_breaks(
        &mut self,
        mut near: Vec<RigidBodyHandle>,
        caller: Callbacks<'_>,
    ) -> (Asked, RigidBodySet) {
        let mut watch = Watch::start();
        let base = Snapshot::take(&self.physics, &self.siblings);
        self.snapshots += 1;
        let mut asked = Asked::default();
        let mut before: Option<RigidBodySet> = None;
        let mut centres = self.guarded_centres();
        self.timings.copies += watch.lap();
        let mut said = Held::default();
        let hooks = caller.hooks;
        self.advance(Callbacks {
            hooks,
            events: &said,
        });
        for _ in 0..MAX_REPEATS {
            if !self.ask(&near, before.as_ref().unwrap_or(&base.bodies), &mut asked) {
                break;
            }
            watch.lap();
            near.retain(|&handle| asked.broken.iter().all(|b| b.parent != handle));
            self.undone_steps += 1;
            self.timings.undone += std::mem::take(&mut self.timings.rigid);
            said.forget();
            base.restore(&mut self.physics, &mut self.siblings);
            self.timings.copies += watch.lap();
            for broken in &mut asked.broken {
                let Replacement {
                    fragments,
                    released,
                } = self.replace(broken.parent, &broken.parts);
                (broken.fragments, broken.released) = (fragments, released);
            }
            self.pass_blows(&mut asked.broken);
            self.timings.fragments += watch.lap();
            before = Some(self.physics.bodies.clone());
            centres = self.guarded_centres();
            self.timings.copies += watch.lap();
            self.advance_finely(Callbacks {
                hooks,
                events: &said,
            });
        }
        said.tell(caller.events, &self.physics);
        let standing = std::mem::take(&mut asked.standing);
        self.give_blows(standing, before.as_ref().unwrap_or(&base.bodies));
        watch.lap();
        put_back(&mut self.physics, &centres);
        self.timings.upkeep += watch.lap();
        self.settle(std::mem::take(&mut asked.broken), &base.bodies);
        self.timings.fragments += watch.lap();
        (asked, base.bodies)
    }

    /// Puts the impacts of the step just taken to the fracture; true when a body broke.
    fn ask(&mut self, near: &[RigidBodyHandle], before: &RigidBodySet, asked: &mut Asked) -> bool {
        let mut watch = Watch::start();
        let (blows, loads, mut standing) = self.questions(near, before, asked);
        self.timings.contacts += watch.lap();
        let verdicts = self.judge(&blows);
        for (rest, contacts, verdict) in loads
            .iter()
            .map(|load| (true, &load.impact, &load.verdict))
            .chain(
                blows
                    .iter()
                    .zip(&verdicts)
                    .map(|(blow, v)| (false, &blow.1, v)),
            )
            .filter_map(|(rest, impact, v)| Some((rest, impact.contacts.len(), v.as_ref().ok()?)))
        {
            let of = if rest {
                &mut self.rest_counts
            } else {
                &mut self.impact_counts
            };
            of.count(contacts, verdict.held());
        }
        let mut answers: Vec<Answer> = loads;
        answers.extend(
            blows
                .into_iter()
                .zip(verdicts)
                .map(|((body, impact), verdict)| Answer {
                    body,
                    cause: BreakCause::Impact,
                    impact,
                    verdict,
                }),
        );
        answers.sort_by_key(|answer| key(answer.body));
        let blows = answers.iter().filter(|a| a.cause == BreakCause::Impact);
        standing.extend(blows.map(|answer| answer.body));
        self.timings.fracture += watch.lap();
        let mut news = false;
        for answer in answers {
            news |= self.hear(answer, before, asked);
        }
        asked.standing.clear();
        if !news {
            standing.sort_by_key(|&handle| key(handle));
            for handle in standing {
                if let Some((impact, event)) = asked.held.get(&key(handle)) {
                    let meetings = self.meetings(handle, before, impact, &event.report);
                    asked.standing.extend(meetings);
                }
            }
        }
        news
    }

    /// What a blow that was integrated says of the impulses between a body and its strikers.
    fn meetings(
        &self,
        handle: RigidBodyHandle,
        before: &RigidBodySet,
        impact: &Impact,
        report: &ImpactReport,
    ) -> Vec<Meeting> {
        let model = self.config.fracture.duration;
        before.get(handle).map_or_else(Vec::new, |body| {
            meetings(handle, body.position(), impact, report, model)
        })
    }

    /// Blows to be put to the fracture, what overloads do, and bodies whose blow is known to hold.
    fn questions(
        &self,
        near: &[RigidBodyHandle],
        before: &RigidBodySet,
        asked: &Asked,
    ) -> (
        Vec<(RigidBodyHandle, Impact)>,
        Vec<Answer>,
        Vec<RigidBodyHandle>,
    ) {
        let (mut blows, mut loads, mut standing) = (Vec::new(), Vec::new(), Vec::new());
        let surfaces = Surfaces {
            bodies: &self.surfaces,
            colliders: &self.collider_surfaces,
            breakables: &self.breakables,
        };
        for &handle in near {
            let Some(body) = self.breakables.get(&key(handle)) else {
                continue;
            };
            let impact = impact_on(handle, &self.physics, before, &surfaces, &self.config);
            let known = asked.held.get(&key(handle));
            if !impact.contacts.is_empty() && known.is_none_or(|(known, _)| *known != impact) {
                blows.push((handle, impact));
                continue;
            }
            if !impact.contacts.is_empty() {
                standing.push(handle);
            }
            if let Some(load) = self.breaking_load(handle, body, before) {
                let (impact, verdict) = match load {
                    Ok((load, outcome)) => (load, verdict(outcome, &self.config)),
                    Err(error) => (impact, Err(error)),
                };
                loads.push(Answer {
                    body: handle,
                    cause: BreakCause::Rest,
                    impact,
                    verdict,
                });
            }
        }
        (blows, loads, standing)
    }

    /// Takes note of an answer; true when it broke the body.
    fn hear(&mut self, answer: Answer, before: &RigidBodySet, asked: &mut Asked) -> bool {
        let handle = answer.body;
        let (fracture, parts) = match answer.verdict {
            Ok(Verdict::Broke(fracture, parts)) => (fracture, parts),
            Ok(Verdict::Held(outcome)) => {
                if answer.cause == BreakCause::Impact {
                    self.remember_held(handle, answer.impact, outcome, asked);
                }
                return false;
            }
            Err(error) => {
                asked.error.get_or_insert(error);
                return false;
            }
        };
        let taken = asked.broken.iter().map(|b| b.fracture.fragments.len());
        if !self.has_room(&fracture, taken.sum(), handle) {
            return false;
        }
        let blow = self.meetings(handle, before, &answer.impact, &fracture.report);
        asked.broken.push(Broken {
            parent: handle,
            cause: answer.cause,
            fracture,
            parts,
            impact: answer.impact,
            fragments: Vec::new(),
            released: Vec::new(),
            blow,
            lost: 0.0,
        });
        asked.held.remove(&key(handle));
        true
    }

    /// Whether there is room for a body's fragments besides those `taken` already in this step.
    pub(crate) fn has_room(
        &mut self,
        fracture: &Fracture,
        taken: usize,
        handle: RigidBodyHandle,
    ) -> bool {
        let limit = self.config.max_bodies;
        let room = limit.saturating_sub(self.physics.bodies.len()) + self.debris.len();
        let fits = fracture.fragments.len() + taken <= room;
        if !fits {
            self.refused_breaks += 1;
            let name = self.breakable(handle).map_or("", |b| &b.asset().name);
            log::warn!(
                "{} fragments of `{name}` exceed `max_bodies`; it stays whole",
                fracture.fragments.len()
            );
        }
        fits
    }

    fn remember_held(
        &self,
        body: RigidBodyHandle,
        impact: Impact,
        outcome: Outcome,
        asked: &mut Asked,
    ) {
        let Outcome::Held {
            margin,
            report,
            state,
        } = outcome
        else {
            return;
        };
        let event = HeldEvent {
            step: self.steps,
            body,
            contacts: impact.contacts.clone(),
            margin,
            report,
            state: state.map(|s| *s),
        };
        asked.held.insert(key(body), (impact, event));
    }
}
