//! Resting loads: a body that carries too much breaks `[G12 §7.3.3]`.
//!
//! After a step each breakable body that is awake, or held, is put to [`frangible::internals::rest()`] with the normal forces of its
//! contacts: the impulse of the last substep / its length. (Avian's sum over the step counts each substep twice, once with its push-out and
//! once without.) Contacts that approach faster than the impact speed are not among them, and friction is left out: Avian does not say in
//! which direction it acts. A single step's impulses are noisy, so a body breaks only when each of [`STEADY`] looks in a row would have
//! broken it.

use avian3d::dynamics::solver::islands::WakeBody;
use avian3d::prelude::*;
use bevy::prelude::*;
use frangible::internals::outcome::LookedAt;
use frangible::internals::{Force, LoadClock, rest, rest_margin_at_least};
use frangible::{Outcome, glam};

use super::ImpactSpeed;
use crate::break_apart::{conclude, fail};
use crate::meshes::into;
use crate::{BreakableBody, Fracturing};

/// Looks in a row that must each break a body, or crack it.
const STEADY: u32 = 4;

/// Time from one look to the next, s, or one step: four looks span several swings of most bodies.
const INTERVAL: f32 = 1.0 / 240.0;

/// Looks for which a body that held after a full computation is not asked again: that one costs milliseconds.
const PAUSE: u32 = 8;

/// Forces at most: more are merged with their neighbours, since the quick bound looks at no more.
const MOST_FORCES: usize = 16;

/// A body whose margin is at least this, by a bound that costs next to nothing, is not analysed further.
const EASE: f64 = 1.5;

/// Component with the load on a breakable body.
#[derive(Component, Clone, Debug)]
pub struct Carries {
    /// Lower bound of strength over stress, from its resting contacts and, for a supported body, its weight. Infinite without load.
    pub margin: f64,
    forces: Vec<Force>,
    gravity: glam::Vec3,
    /// Looks in a row that would have broken or cracked it.
    over: u32,
    /// Looks until it is asked again.
    pause: u32,
    /// Looks in a row at which the quick bound did not clear it: only a load that lasts is analysed further.
    hard: u32,
    /// Time for which the load has lasted, for static fatigue.
    clock: LoadClock,
}

impl Default for Carries {
    fn default() -> Self {
        Self {
            margin: f64::INFINITY,
            forces: Vec::new(),
            gravity: glam::Vec3::NAN,
            over: 0,
            pause: 0,
            hard: 0,
            clock: LoadClock::default(),
        }
    }
}

/// Normal forces on a body in the step just taken, body frame.
fn forces_on<'a>(
    body: Entity,
    to_body: Quat,
    pairs: impl Iterator<Item = &'a ContactPair>,
    substep: f32,
    impact_speed: f32,
) -> Vec<Force> {
    let mut forces = Vec::new();
    for pair in pairs {
        let first = pair.body1 == Some(body);
        for manifold in &pair.manifolds {
            let normal = if first {
                -manifold.normal
            } else {
                manifold.normal
            };
            for point in &manifold.points {
                let impulse = point.warm_start_normal_impulse;
                if impulse > 0.0 && -point.normal_speed <= impact_speed {
                    let anchor = if first { point.anchor1 } else { point.anchor2 };
                    forces.push(Force {
                        point: into(to_body * anchor),
                        force: into(to_body * normal * (impulse / substep)),
                    });
                }
            }
        }
    }
    // Doubled up to a metre: stress at a distance from the forces changes little (Saint-Venant).
    let mut apart = 5e-4;
    while forces.len() > MOST_FORCES && apart < 1.0 {
        forces = merged(forces, apart);
        apart *= 2.0;
    }
    forces
}

/// Forces nearer than this are one, in the middle of their sizes.
fn merged(forces: Vec<Force>, apart: f32) -> Vec<Force> {
    let mut kept: Vec<Force> = Vec::new();
    for force in forces {
        let same = |k: &&mut Force| {
            k.point.distance(force.point) <= apart && k.force.dot(force.force) > 0.0
        };
        match kept.iter_mut().find(same) {
            Some(kept) => {
                let [a, b] = [kept.force.length(), force.force.length()];
                kept.point = kept.point.lerp(force.point, b / (a + b));
                kept.force += force.force;
            }
            None => kept.push(force),
        }
    }
    kept
}

/// A breakable body, its motion, and the load that it carries.
type Bearing = (
    Entity,
    &'static mut BreakableBody,
    &'static mut Carries,
    &'static RigidBody,
    &'static Position,
    &'static Rotation,
    Option<&'static GravityScale>,
    Option<&'static RigidBodyColliders>,
    Has<Sleeping>,
);

/// Asks all bodies that carry something new, and breaks those that carry too much.
pub(super) fn weigh(
    mut bodies: Query<Bearing>,
    collisions: Collisions,
    (gravity, substeps): (Res<Gravity>, Res<SubstepCount>),
    (config, impact_speed, time): (Res<Fracturing>, Res<ImpactSpeed>, Res<Time>),
    mut since: Local<f32>,
    mut commands: Commands,
) {
    let dt = time.delta_secs();
    *since += dt;
    if dt <= 0.0 || *since < INTERVAL - 0.5 * dt {
        return;
    }
    let seconds = f64::from(std::mem::take(&mut *since));
    let substep = dt / substeps.0 as f32;
    for (entity, mut body, mut carries, kind, place, turn, scale, colliders, asleep) in &mut bodies
    {
        let held = kind.is_static() && body.0.asset().is_supported();
        if !(kind.is_dynamic() || held) {
            continue;
        }
        if asleep && carries.over == 0 {
            let assumed = config.0.load_duration;
            carries.clock.sleep(seconds);
            if carries.clock.is_due(&body.0, assumed)
                && carries.clock.margin(&body.0, assumed, carries.margin) <= 1.0
            {
                commands.queue(WakeBody(entity));
            }
            continue;
        }
        let to_body = turn.0.inverse();
        let gravity = to_body * gravity.0 * scale.map_or(1.0, |scale| scale.0);
        let colliders = colliders.into_iter().flat_map(|all| all.iter());
        let pairs = colliders.flat_map(|collider| collisions.collisions_with(collider));
        let forces = forces_on(entity, to_body, pairs, substep, impact_speed.0);
        let total = forces.iter().map(|f| f.force.length()).sum();
        carries.clock.advance(seconds, total);
        match carries.look(
            &body,
            forces,
            total,
            into(gravity),
            kind.is_dynamic(),
            &config,
        ) {
            Some(Ok(outcome)) => {
                let pose = Transform::from_translation(place.0).with_rotation(turn.0);
                conclude(&mut commands, entity, &mut body, pose, Ok(outcome));
            }
            Some(Err(error)) => fail(&mut commands, entity, &error),
            None => {}
        }
    }
}

impl Carries {
    /// Checks a load. Returns its effect once it had one for long enough.
    fn look(
        &mut self,
        body: &BreakableBody,
        forces: Vec<Force>,
        total: f32,
        gravity: glam::Vec3,
        free: bool,
        config: &Fracturing,
    ) -> Option<Result<Outcome, frangible::InputError>> {
        if forces.is_empty() && free {
            *self = Self::default();
            return None;
        }
        if self.over == 0 {
            let lasted = config.0.load_duration + self.clock.duration();
            let margin = rest_margin_at_least(&body.0, total, gravity.length(), lasted);
            if margin >= EASE {
                self.clock.test();
                *self = Self {
                    margin,
                    clock: self.clock,
                    ..Self::default()
                };
                return None;
            }
            // A knock that does not last is no load.
            self.hard = self.hard.saturating_add(1);
            if self.hard < STEADY {
                return None;
            }
        }
        self.pause = self.pause.saturating_sub(1);
        let due = self.clock.is_due(&body.0, config.0.load_duration);
        let known = self.over == 0 && (&self.forces, self.gravity) == (&forces, gravity) && !due;
        if known || self.pause > 0 {
            return None;
        }
        let mut fracture = config.0.clone();
        fracture.load_duration += self.clock.duration();
        let outcome = rest(&body.0, &forces, gravity, &fracture);
        self.clock.test();
        (self.forces, self.gravity) = (forces, gravity);
        match &outcome {
            Ok(Outcome::Held {
                margin,
                report,
                state,
            }) => {
                self.margin = *margin;
                self.over = if state.is_some() { self.over + 1 } else { 0 };
                if state.is_none() && report.looked_at != LookedAt::Impulses {
                    self.pause = PAUSE;
                }
            }
            Ok(broke) => {
                let report = broke.report();
                self.margin = (report.strength / report.stress_bound).min(1.0);
                self.over += 1;
            }
            Err(_) => (self.over, self.pause) = (STEADY, PAUSE),
        }
        let lasts = self.over >= STEADY;
        if lasts {
            (self.over, self.pause) = (0, PAUSE);
        }
        lasts.then_some(outcome)
    }
}
