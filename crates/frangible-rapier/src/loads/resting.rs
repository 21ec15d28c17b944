//! Fracture under resting contacts, tested at every step `[G12 §7.3.3]`.
//!
//! After a step, each breakable body that is awake or supported is passed to [`frangible::internals::rest()`] with the forces of its
//! resting contacts: impulse divided by time step, including friction. Contacts that approach faster than the impact speed are
//! excluded. The impulses of a single step are noisy (an object put down at 0.1 m/s presses for one step of 1/240 s with three
//! times its weight), so the load is the smallest of the last [`STEADY`] steps: a body breaks only if each of them would have broken it.
//! The last of these steps starts with a copy of the world and is repeated with fragments, as after an impact. If steps are shorter than
//! [`INTERVAL`], only one step per interval is tested.
//!
//! A load that lasts weakens bodies with static fatigue. Each body has a clock ([`LoadClock`]); an unchanged load is tested again whenever the
//! strength may have fallen by a hundredth, and a sleeping body is woken when the load may break it.
//!
//! The force that separates overlapping bodies is not a load: it depends on the engine's iterations, and between immovable bodies it grows from
//! step to step. Resting bodies hardly overlap, so a body with a contact deeper than [`OVERLAP`] is treated as unloaded until the overlap is
//! resolved.

use std::collections::BTreeMap;

use frangible::glam::Vec3;
use frangible::internals::outcome::LookedAt;
use frangible::internals::{Force, LoadClock, rest_margin_at_least};
use frangible::{Body, Contact, Outcome, Striker};
use rapier3d::dynamics::{RigidBody, RigidBodyHandle};
use rapier3d::pipeline::PhysicsWorld;

use crate::calm::motions::Before;
use crate::config::WorldConfig;
use crate::contact::contacts::{Impact, Point, approach, merged_by_partner, points_on};
use crate::counts::held;
use crate::error::WorldError;
use crate::event::HeldEvent;
use crate::world::{BreakableWorld, Key, key};

/// Steps in a row that must each break a body, or crack it.
const STEADY: u32 = 4;

/// Time from one look at the loads to the next, s, or one step: four looks span several swings of most bodies.
const INTERVAL: f32 = 1.0 / 240.0;

/// Looks for which a body that held after a full computation is not asked again: that one costs milliseconds.
const PAUSE: u32 = 8;

/// Depth of another body in one that carries something, at most, as a share of the engine's tolerance of lengths: 0.1 mm by default. A stack
/// that fell by half a millimetre overlaps by 0.02 mm at most.
const OVERLAP: f32 = 0.2;

/// Forces at most: more are merged with their neighbours, since the quick bound looks at no more. Stress at a distance
/// from the forces changes little (Saint-Venant); their sum stays, and so does their moment where they are parallel.
const MOST_FORCES: usize = 16;

/// Safety factor, by a bound that costs next to nothing, from which on a body is not looked at closer.
const EASE: f64 = 1.5;

/// Load of a body: forces of its resting contacts, and gravity.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Load {
    pub(crate) forces: Vec<Force>,
    pub(crate) gravity: Vec3,
    pub(crate) partners: Vec<RigidBodyHandle>,
}

impl Load {
    /// The load as the cause of a break: pushes of one step, without blow.
    pub(crate) fn cause(&self, dt: f32) -> Impact {
        let contact = |f: &Force| {
            let (normal, size) = (f.force.normalize_or(Vec3::Y), f.force.length());
            Contact {
                impulse: size * dt,
                ..Contact::strike(f.point, normal, 0.0, Striker::rigid())
            }
        };
        Impact {
            contacts: self.forces.iter().map(contact).collect(),
            partners: Vec::new(),
            strikers: self.partners.clone(),
        }
    }
}

/// A body's load, and what came of it.
#[derive(Clone, Debug)]
pub(crate) struct Burden {
    load: Load,
    margin: f64,
    /// Number of consecutive steps that would have broken or cracked the body.
    over: u32,
    /// Number of checks until the next evaluation.
    pause: u32,
    /// Number of consecutive checks in which the quick bound was not sufficient; only a lasting load is analysed further.
    hard: u32,
    /// Time for which the load has lasted.
    clock: LoadClock,
}

impl Default for Burden {
    fn default() -> Self {
        Self {
            load: Load::default(),
            margin: f64::INFINITY,
            over: 0,
            pause: 0,
            hard: 0,
            clock: LoadClock::default(),
        }
    }
}

/// No less than the sizes of all forces on a body in the step just taken add up to, N.
fn most_force_on(rigid: &RigidBody, physics: &PhysicsWorld) -> f32 {
    let colliders = rigid.colliders().iter();
    let pairs = colliders.flat_map(|&c| physics.narrow_phase.contact_pairs_with(c));
    let manifolds = pairs.flat_map(|pair| pair.solver_manifolds());
    let impulse: f32 = manifolds
        .map(|m| {
            let normal: f32 = m.points.iter().map(|p| p.data.impulse.max(0.0)).sum();
            normal * (1.0 + m.data.friction)
        })
        .sum();
    impulse / physics.integration_parameters.dt
}

/// Returns true if a body is asked at all: a fixed one without supports has no modes for its hold.
fn carries(body: &Body, rigid: &RigidBody) -> bool {
    rigid.is_enabled() && (rigid.is_dynamic() || rigid.is_fixed() && body.asset().is_supported())
}

/// Forces on the body in the step just taken, none where it overlaps something; with `before`, without those of impacts.
fn load_on(
    handle: RigidBodyHandle,
    rigid: &RigidBody,
    physics: &PhysicsWorld,
    before: Option<&impl Before>,
    config: &WorldConfig,
) -> Load {
    let dt = physics.integration_parameters.dt;
    let before = before.filter(|b| b.body(handle).is_some());
    let frame = before.and_then(|b| b.body(handle)).unwrap_or(rigid);
    let mut points = points_on(handle, rigid, physics);
    let deepest = OVERLAP * physics.integration_parameters.allowed_linear_error();
    points.retain(|p| p.impulse > 0.0);
    if points.iter().any(|p| p.gap < -deepest) {
        points.clear();
    }
    if let Some(before) = before {
        points.retain(|p| {
            let partner = p.other.and_then(|other| before.body(other));
            let speed = approach(frame, partner, p.position, p.normal);
            speed <= config.impact_speed
        });
    }
    let mut distance = config.merge_distance.max(1e-5);
    let mut groups = merged_by_partner(points, distance);
    // Doubled up to a metre: what then is left differs in direction.
    while groups.iter().map(Vec::len).sum::<usize>() > MOST_FORCES && distance < 1.0 {
        distance *= 2.0;
        let points: Vec<Point> = groups.into_iter().flatten().collect();
        groups = merged_by_partner(points, distance);
    }
    let mut load = Load {
        gravity: rigid.rotation().inverse() * (physics.gravity * rigid.gravity_scale()),
        ..Load::default()
    };
    for group in groups {
        load.partners.extend(group[0].other);
        load.forces.extend(group.iter().map(|p| Force {
            point: p.position,
            force: (p.normal * p.impulse + p.friction) / dt,
        }));
    }
    load
}

impl BreakableWorld {
    /// Lower bound of a body's safety factor under its current load: strength over an upper bound of the stress from its resting contacts and,
    /// for a supported body, its weight. Infinite without load. `None` for a body that is not breakable or has not been tested yet
    /// ([`crate::WorldConfig::resting_loads`] off, or no step yet).
    #[must_use]
    pub fn rest_margin(&self, handle: RigidBodyHandle) -> Option<f64> {
        self.state.burdens.get(&key(handle)).map(|b| b.margin)
    }

    /// Forgets all loads: something but the load has changed.
    pub(crate) fn weigh_anew(&mut self) {
        for burden in self.state.burdens.values_mut() {
            burden.load.gravity = Vec3::NAN;
        }
    }

    /// Forgets the load of one body.
    pub(crate) fn weigh_anew_one(&mut self, handle: RigidBodyHandle) {
        if let Some(burden) = self.state.burdens.get_mut(&key(handle)) {
            burden.load.gravity = Vec3::NAN;
        }
    }

    /// Returns true if loads are looked at after the coming step.
    pub(crate) fn weighs_now(&self) -> bool {
        self.config.resting_loads && self.state.steps.is_multiple_of(self.stride())
    }

    /// Steps from one look at the loads to the next.
    fn stride(&self) -> u64 {
        let stride = (INTERVAL / self.physics.integration_parameters.dt).round();
        (stride as u64).max(1)
    }

    /// Bodies that the coming step may break by their load.
    pub(crate) fn overloaded(&self) -> impl Iterator<Item = RigidBodyHandle> {
        let over = self
            .state
            .burdens
            .iter()
            .filter(|(_, b)| b.over + 1 >= STEADY);
        over.map(|(&(i, g), _)| RigidBodyHandle::from_raw_parts(i, g))
    }

    /// Outcome of an overloaded body's load in the step just taken; `None` when it is not overloaded.
    pub(crate) fn breaking_load(
        &self,
        handle: RigidBodyHandle,
        body: &Body,
        before: &impl Before,
    ) -> Option<Result<(Impact, Outcome), WorldError>> {
        let burden = self.state.burdens.get(&key(handle))?;
        let rigid = self.physics.bodies.get(handle)?;
        if burden.over + 1 < STEADY || !carries(body, rigid) {
            return None;
        }
        let load = load_on(handle, rigid, &self.physics, Some(before), &self.config);
        let outcome = self.rest_after(burden.clock, body, &load);
        let dt = self.physics.integration_parameters.dt;
        Some(outcome.map(|o| (load.cause(dt), o)).map_err(Into::into))
    }

    /// Outcome of a load that has lasted since its clock began.
    fn rest_after(
        &self,
        clock: LoadClock,
        body: &Body,
        load: &Load,
    ) -> Result<Outcome, frangible::InputError> {
        let mut config = self.config.fracture.clone();
        config.load_duration += clock.duration();
        (self.rest_function)(body, &load.forces, load.gravity, &config)
    }

    /// Asks all bodies that carry something new; gives cracks to those that cracked.
    pub(crate) fn weigh(&mut self, before: Option<&impl Before>) -> Result<(), WorldError> {
        let mut error = Ok(());
        let mut burdens: BTreeMap<Key, Burden> = std::mem::take(&mut self.state.burdens);
        burdens.retain(|key, _| self.state.breakables.contains_key(key));
        let handles: Vec<RigidBodyHandle> = self.breakables().collect();
        for handle in handles {
            if let Err(problem) = self.weigh_one(handle, before, &mut burdens) {
                error = error.and(Err(problem));
            }
        }
        self.state.burdens = burdens;
        error
    }

    fn weigh_one(
        &mut self,
        handle: RigidBodyHandle,
        before: Option<&impl Before>,
        burdens: &mut BTreeMap<Key, Burden>,
    ) -> Result<(), WorldError> {
        let (Some(body), Some(rigid)) = (
            self.state.breakables.get(&key(handle)),
            self.physics.bodies.get(handle),
        ) else {
            return Ok(());
        };
        if !carries(body, rigid) {
            return Ok(());
        }
        let assumed = self.config.fracture.load_duration;
        let dt = f64::from(self.physics.integration_parameters.dt);
        let seconds = dt * self.stride() as f64;
        let known = burdens.contains_key(&key(handle));
        if rigid.is_sleeping()
            && let Some(burden) = burdens.get_mut(&key(handle)).filter(|b| b.over == 0)
        {
            burden.clock.sleep(seconds);
            let due = burden.clock.is_due(body, assumed);
            if due && burden.clock.margin(body, assumed, burden.margin) <= 1.0 {
                self.physics.wake_up(handle, true);
            }
            return Ok(());
        }
        let burden = burdens.entry(key(handle)).or_default();
        let total = most_force_on(rigid, &self.physics);
        burden.clock.advance(seconds, total);
        if self.weighs_quickly && burden.over == 0 {
            let gravity = self.physics.gravity.length() * rigid.gravity_scale().abs();
            let lasted = assumed + burden.clock.duration();
            let margin = rest_margin_at_least(body, total, gravity, lasted);
            burden.hard = match (margin >= EASE, known) {
                (true, _) => 0,
                // The first load of a body is looked at in any case.
                (false, false) => STEADY,
                (false, true) => burden.hard.saturating_add(1),
            };
            if margin >= EASE {
                self.state.rest_counts.count(0, Some(LookedAt::Impulses));
            }
            if burden.hard < STEADY {
                // A knock that does not last is no load.
                burden.margin = if margin >= EASE {
                    margin
                } else {
                    burden.margin
                };
                burden.load.gravity = Vec3::NAN;
                burden.clock.test();
                return Ok(());
            }
        }
        let load = load_on(handle, rigid, &self.physics, before, &self.config);
        let due = burden.clock.is_due(body, assumed);
        let known = burden.over == 0 && burden.load == load && !due;
        burden.pause = burden.pause.saturating_sub(1);
        if known || burden.pause > 0 {
            return Ok(());
        }
        if load.forces.is_empty() && rigid.is_dynamic() {
            (burden.margin, burden.over, burden.load) = (f64::INFINITY, 0, load);
            return Ok(());
        }
        let asked = self.rest_after(burden.clock, body, &load);
        burden.clock.test();
        if let Ok(outcome) = &asked {
            self.state
                .rest_counts
                .count(load.forces.len(), held(outcome));
        }
        let dt = self.physics.integration_parameters.dt;
        let contacts = |load: &Load| load.cause(dt).contacts;
        match asked {
            Ok(Outcome::Held {
                margin,
                report,
                state,
            }) => {
                burden.margin = margin;
                burden.over = if state.is_some() { burden.over + 1 } else { 0 };
                if report.looked_at != LookedAt::Impulses && state.is_none() {
                    burden.pause = PAUSE;
                }
                if let (Some(state), true) = (state, burden.over >= STEADY) {
                    (burden.over, burden.pause) = (0, PAUSE);
                    let event = HeldEvent {
                        step: self.state.steps,
                        body: handle,
                        contacts: contacts(&load),
                        margin,
                        report,
                        state: Some((*state).clone()),
                    };
                    burden.load = load;
                    if self.config.record_held {
                        self.held.push(event);
                    }
                    return self.crack(handle, &state);
                }
            }
            Ok(outcome) => {
                let report = outcome.report();
                burden.margin = (report.strength / report.stress_bound).min(1.0);
                burden.over += 1;
                // The body should have broken in this step: there was no room for its fragments.
                if burden.over > STEADY {
                    (burden.over, burden.pause) = (0, PAUSE);
                }
            }
            Err(problem) => {
                burden.pause = PAUSE;
                return Err(problem.into());
            }
        }
        burden.load = load;
        Ok(())
    }
}
