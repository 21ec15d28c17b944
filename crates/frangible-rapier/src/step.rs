//! THE step: bodies break inside it.
//!
//! Theory §6. A step that may see an impact (see `approach.rs`) begins with a copy of the world. After it, each
//! impact is put to the fracture. If a body broke: back to the copy, fragments in its place with the velocities
//! from before the impact, and the step is taken again, so that the striker meets fragments instead of a body
//! that is gone. Several bodies may break in a step; a body that is only hit in the repeated step is asked then,
//! up to [`MAX_REPEATS`] times. Fragments are not asked: they do not break again yet. What bodies carry is asked after
//! every step (`resting.rs`); blasts and scripted blows come before it (`pushes.rs`).

use std::collections::BTreeMap;
use std::sync::Arc;

use frangible::{Fracture, Outcome};
use rapier3d::dynamics::{RigidBodyHandle, RigidBodySet};

use crate::approach::candidates;
use crate::contacts::{Impact, Surfaces, impact_on};
use crate::error::WorldError;
use crate::event::{BreakCause, BreakEvent, HeldEvent};
use crate::guard::{Centres, centres, put_back};
use crate::replace::Parts;
use crate::rolling::resist_rolling;
use crate::settle::Broken;
use crate::snapshot::Snapshot;
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
    error: Option<WorldError>,
}

impl BreakableWorld {
    /// Advances by one time step; returns the breaks in it.
    ///
    /// # Errors
    /// The fracture refused an asset or a contact. The step is complete and the body whole: go on, or remove it.
    pub fn step(&mut self) -> Result<&[BreakEvent], WorldError> {
        self.events.clear();
        self.held.clear();
        self.forget_removed();
        self.siblings.step = self.steps;
        self.siblings.relaxation =
            self.config.overlap_relaxation * self.physics.integration_parameters.dt;
        let pushed = self.apply_pushes();
        let near = self.near();
        let (mut asked, before) = if near.is_empty() {
            let centres = self.guarded_centres();
            self.advance();
            put_back(&mut self.physics, &centres);
            (Asked::default(), None)
        } else {
            let (asked, before) = self.step_with_breaks(near);
            (asked, Some(before))
        };
        // A break's impulses are a blow, not a weight that rolls; its energy is settled already.
        if self.events.is_empty() {
            resist_rolling(&mut self.physics, self.config.rolling_arm);
        }
        if self.config.rest_drift > 0.0 {
            self.places.rest(&mut self.physics, self.config.rest_drift);
        }
        self.limit_debris(self.config.max_debris);
        for (body, (_, event)) in &asked.held {
            if let (Some(body), Some(state)) = (self.breakables.get_mut(body), &event.state)
                && let Err(error) = body.set_state(state.clone())
            {
                asked.error.get_or_insert(error.into());
            }
        }
        if asked.held.values().any(|(_, event)| event.state.is_some()) {
            self.weigh_anew();
        }
        if self.config.record_held {
            self.held
                .extend(asked.held.into_values().map(|(_, event)| event));
        }
        // A break's impulses are no weight either.
        let weighed = if self.weighs_now() && self.events.is_empty() {
            self.weigh(before.as_ref())
        } else {
            Ok(())
        };
        self.steps += 1;
        let asked = asked.error.map_or(Ok(()), Err);
        pushed.and(asked).and(weighed).map(|()| &*self.events)
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

    fn advance(&mut self) {
        // Fragments of a blast are newborn when the step begins.
        if self.events.is_empty() {
            self.physics.step_with_events(&self.siblings, &());
        } else {
            self.advance_finely();
        }
    }

    fn guarded_centres(&self) -> Centres {
        centres(
            &self.physics,
            self.siblings.fragments().chain(self.breakables()),
        )
    }

    /// A step with fragments just born: a blow runs through a chain of them, one link per solver iteration. With
    /// too few a piece between floor and chain is squeezed through a thin floor.
    fn advance_finely(&mut self) {
        let iterations = self.physics.integration_parameters.num_solver_iterations;
        self.physics.integration_parameters.num_solver_iterations = BREAK_ITERATIONS * iterations;
        self.physics.step_with_events(&self.siblings, &());
        self.physics.integration_parameters.num_solver_iterations = iterations;
    }

    /// The step, and the bodies as they were before it.
    fn step_with_breaks(&mut self, mut near: Vec<RigidBodyHandle>) -> (Asked, RigidBodySet) {
        let base = Snapshot::take(&self.physics, &self.siblings);
        self.snapshots += 1;
        let mut asked = Asked::default();
        let mut before: Option<RigidBodySet> = None;
        let mut centres = self.guarded_centres();
        self.advance();
        for _ in 0..MAX_REPEATS {
            if !self.ask(&near, before.as_ref().unwrap_or(&base.bodies), &mut asked) {
                break;
            }
            near.retain(|&handle| asked.broken.iter().all(|b| b.parent != handle));
            self.undone_steps += 1;
            base.restore(&mut self.physics, &mut self.siblings);
            for broken in &mut asked.broken {
                broken.fragments = self.replace(broken.parent, &broken.parts);
            }
            before = Some(self.physics.bodies.clone());
            centres = self.guarded_centres();
            self.advance_finely();
        }
        put_back(&mut self.physics, &centres);
        self.settle(std::mem::take(&mut asked.broken), &base.bodies);
        (asked, base.bodies)
    }

    /// Puts the impacts of the step just taken to the fracture; true when a body broke.
    fn ask(&mut self, near: &[RigidBodyHandle], before: &RigidBodySet, asked: &mut Asked) -> bool {
        let mut news = false;
        for &handle in near {
            let surfaces = Surfaces {
                bodies: &self.surfaces,
                colliders: &self.collider_surfaces,
                breakables: &self.breakables,
            };
            let Some(body) = self.breakables.get(&key(handle)) else {
                continue;
            };
            let impact = impact_on(handle, &self.physics, before, &surfaces, &self.config);
            let unchanged = asked
                .held
                .get(&key(handle))
                .is_some_and(|(known, _)| *known == impact);
            let (cause, impact, outcome) = if impact.contacts.is_empty() || unchanged {
                match self.breaking_load(handle, body, before) {
                    None => continue,
                    Some(Ok((load, outcome))) => {
                        self.rest_counts.count(load.contacts.len(), &outcome);
                        (BreakCause::Rest, load, Ok(outcome))
                    }
                    Some(Err(error)) => (BreakCause::Rest, impact, Err(error)),
                }
            } else {
                let judge = &self.break_function;
                let outcome = judge(body, &impact.contacts, &self.config.fracture);
                if let Ok(outcome) = &outcome {
                    self.impact_counts.count(impact.contacts.len(), outcome);
                }
                (BreakCause::Impact, impact, outcome.map_err(Into::into))
            };
            let fracture = match outcome {
                Ok(Outcome::Broke(fracture)) if fracture.fragments.len() > 1 => *fracture,
                Ok(outcome) => {
                    if cause == BreakCause::Impact {
                        self.remember_held(handle, impact, outcome, asked);
                    }
                    continue;
                }
                Err(error) => {
                    asked.error.get_or_insert(error);
                    continue;
                }
            };
            let fragments = asked.broken.iter().map(|b| b.fracture.fragments.len());
            if !self.has_room(&fracture, fragments.sum(), handle) {
                continue;
            }
            match Parts::new(&fracture, &self.config) {
                Ok(parts) => {
                    asked.broken.push(Broken {
                        parent: handle,
                        cause,
                        fracture: Arc::new(fracture),
                        parts,
                        impact,
                        fragments: Vec::new(),
                    });
                    asked.held.remove(&key(handle));
                    news = true;
                }
                Err(error) => {
                    asked.error.get_or_insert(error);
                }
            }
        }
        news
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
