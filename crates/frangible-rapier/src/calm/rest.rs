//! Rest: a body that stays in its place may sleep.
//!
//! Rapier lets a body sleep when it moved less than a threshold in **every** step of half a second. A jagged piece
//! stands on corners that take turns, so single steps exceed any threshold while the piece goes nowhere, and one such
//! piece keeps the whole heap awake. Here a body that touches something and of which no point went farther than
//! [`crate::WorldConfig::rest_drift`] within [`REST_TIME`] may sleep.
//!
//! In a heap of hundreds some piece always creeps, pushed by the rounding of its contacts. So a body that has not been faster than [`MOVES`] for seconds may
//! creep farther, up to [`PATIENCE`] times as far. And single steps may turn a small piece fast, which Rapier does not let sleep whatever its threshold:
//! the rotation of a body that stays in its place is limited to what does.

use std::collections::BTreeMap;

use rapier3d::dynamics::{RigidBody, RigidBodyHandle};
use rapier3d::math::{Pose, Vector};
use rapier3d::pipeline::PhysicsWorld;

use crate::world::{Key, key};

/// Time that a body has to stay in its place before it may sleep, s.
const REST_TIME: f32 = 0.4;

/// A body that leaves its place with a mean speed above this moves, and one below creeps, m/s.
const MOVES: f32 = 0.1;

/// Time for which a body may touch nothing, s: one that rocks hops. One that falls is 5 mm away by then, and on its way.
const HOP: f32 = 0.03;

/// Multiple of the drift that a body may have in the end, after one second of creeping for each one.
const PATIENCE: f32 = 6.0;

/// Rotation of a body that may sleep, rad/s: Rapier's own limit is π/2.
const LEAST_SPIN: f32 = 1.5;

/// Sleep threshold of a body that stays in its place, length units per second: more than corners taking turns.
const LENIENT: f32 = 10.0;

#[derive(Clone, Copy, Debug)]
struct Place {
    pose: Pose,
    since: f32,
    /// Time since it moved, and since it touched anything, s.
    calm: f32,
    apart: f32,
    /// Farthest point of the body's shapes from its origin, m.
    reach: f32,
    /// The body's own sleep threshold while it has the lenient one.
    threshold: Option<f32>,
    /// Velocity after the last step, and its mean over the last two, m/s.
    velocity: Vector,
    mean: Vector,
}

/// Places that bodies have kept of late.
#[derive(Clone, Debug, Default)]
pub(crate) struct Places {
    places: BTreeMap<Key, Place>,
}

impl Places {
    /// Time for which a body has touched something and stayed in its place, s, up to now or until it fell asleep.
    pub(crate) fn stayed(&self, body: RigidBodyHandle) -> f32 {
        self.places.get(&key(body)).map_or(0.0, |place| place.since)
    }

    /// Mean velocity over the last two steps, m/s: a body that stands on corners that take turns moves to and fro, and its mean is small.
    pub(crate) fn mean_velocity(&self, body: RigidBodyHandle) -> Vector {
        (self.places.get(&key(body))).map_or(Vector::ZERO, |place| place.mean)
    }

    /// A body begins to rest anew.
    pub(crate) fn disturb(&mut self, physics: &mut PhysicsWorld, handle: RigidBodyHandle) {
        let Some(place) = self.places.remove(&key(handle)) else {
            return;
        };
        if let (Some(threshold), Some(body)) = (place.threshold, physics.bodies.get_mut(handle)) {
            body.activation_mut().normalized_linear_threshold = threshold;
        }
    }

    /// Lets bodies sleep that stayed in their place; `drift` in m. Rapier puts a heap to sleep when all of it may: a body that
    /// slept among moving ones would not be held up by the floor.
    pub(crate) fn rest(&mut self, physics: &mut PhysicsWorld, drift: f32) {
        let bodies = &physics.bodies;
        self.places.retain(|&(index, generation), place| {
            let body = bodies.get(RigidBodyHandle::from_raw_parts(index, generation));
            let now = body.map_or(Vector::ZERO, RigidBody::linvel);
            place.mean = 0.5 * (place.velocity + now);
            place.velocity = now;
            body.is_some()
        });
        let dt = physics.integration_parameters.dt;
        let (mut thresholds, mut turning) = (Vec::new(), Vec::new());
        let awake = |b: &RigidBody| b.is_dynamic() && b.is_enabled() && !b.is_sleeping();
        for (handle, body) in bodies.iter().filter(|(_, b)| awake(b)) {
            let here = || Place {
                pose: *body.position(),
                since: 0.0,
                calm: 0.0,
                apart: 0.0,
                reach: reach(body, physics),
                threshold: None,
                velocity: body.linvel(),
                mean: body.linvel(),
            };
            let place = self.places.entry(key(handle)).or_insert_with(here);
            let own = body.activation().normalized_linear_threshold;
            // A body that may not sleep says so by a negative threshold.
            let way = way(place, body);
            let allowed = drift * (1.0 + place.calm).min(PATIENCE);
            place.apart = if touches(body, physics) {
                0.0
            } else {
                place.apart + dt
            };
            if own < 0.0 || way > allowed || place.apart > HOP {
                if way > MOVES * (place.since + dt) {
                    place.calm = 0.0;
                }
                place.calm += dt;
                let threshold = place.threshold.take();
                thresholds.extend(threshold.map(|threshold| (handle, threshold, false)));
                (place.pose, place.since) = (*body.position(), 0.0);
                continue;
            }
            (place.since, place.calm) = (place.since + dt, place.calm + dt);
            if place.since < REST_TIME {
                continue;
            }
            if place.threshold.is_none() {
                place.threshold = Some(own);
                thresholds.push((handle, LENIENT, true));
            } else if body.angvel().length() > LEAST_SPIN {
                turning.push(handle);
            }
        }
        for handle in turning {
            if let Some(body) = physics.bodies.get_mut(handle) {
                body.set_angvel(body.angvel().clamp_length_max(LEAST_SPIN), false);
            }
        }
        for (handle, threshold, rests) in thresholds {
            let Some(body) = physics.bodies.get_mut(handle) else {
                continue;
            };
            let activation = body.activation_mut();
            activation.normalized_linear_threshold = threshold;
            activation.time_since_can_sleep = if rests {
                activation.time_until_sleep
            } else {
                0.0
            };
        }
    }
}

/// The longest way a point of the body may have gone since it came to this place, m.
fn way(place: &Place, body: &RigidBody) -> f32 {
    let (from, now) = (&place.pose, body.position());
    let turn = now.rotation * from.rotation.inverse();
    let half_sine = turn.xyz().length();
    (now.translation - from.translation).length() + 2.0 * half_sine * place.reach
}

fn reach(body: &RigidBody, physics: &PhysicsWorld) -> f32 {
    let colliders = body
        .colliders()
        .iter()
        .filter_map(|&c| physics.colliders.get(c));
    let reach = colliders.map(|c| {
        let sphere = c.shape().compute_local_bounding_sphere();
        sphere.center.length() + sphere.radius
    });
    reach.fold(0.0, f32::max)
}

fn touches(body: &RigidBody, physics: &PhysicsWorld) -> bool {
    body.colliders().iter().any(|&c| {
        physics
            .narrow_phase
            .contact_pairs_with(c)
            .any(|p| p.has_any_active_contact())
    })
}
