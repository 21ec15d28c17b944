//! What stays where it is, rests.
//!
//! Rapier lets a body sleep when it moved less than a threshold in **every** step of half a second. A jagged piece
//! stands on corners that take turns, so single steps exceed any threshold while the piece goes nowhere, and one such
//! piece keeps the whole heap awake. Here a body that touches something and of which no point went farther than
//! [`crate::WorldConfig::rest_drift`] within [`REST_TIME`] is put to sleep.

use std::collections::BTreeMap;

use rapier3d::dynamics::{RigidBody, RigidBodyHandle};
use rapier3d::math::Pose;
use rapier3d::pipeline::PhysicsWorld;

use crate::world::{Key, key};

/// How long a body has to stay in its place, s.
const REST_TIME: f32 = 0.4;

#[derive(Clone, Copy, Debug)]
struct Place {
    pose: Pose,
    since: f32,
}

/// Where bodies have been of late.
#[derive(Debug, Default)]
pub(crate) struct Places {
    places: BTreeMap<Key, Place>,
}

impl Places {
    /// Puts to sleep what stayed in its place; `drift` in m.
    pub(crate) fn rest(&mut self, physics: &mut PhysicsWorld, drift: f32) {
        let bodies = &physics.bodies;
        let awake = |b: &RigidBody| b.is_dynamic() && b.is_enabled() && !b.is_sleeping();
        self.places.retain(|&(i, g), _| bodies.get(RigidBodyHandle::from_raw_parts(i, g)).is_some_and(awake));
        let dt = physics.integration_parameters.dt;
        let mut resting = Vec::new();
        for (handle, body) in bodies.iter().filter(|(_, b)| awake(b)) {
            let here = Place { pose: *body.position(), since: 0.0 };
            let place = self.places.entry(key(handle)).or_insert(here);
            // A body that may not sleep says so by a negative threshold.
            if way(&place.pose, body, physics) > drift || body.activation().normalized_linear_threshold < 0.0 {
                *place = here;
                continue;
            }
            place.since += dt;
            if place.since >= REST_TIME && touches(body, physics) {
                resting.push(handle);
            }
        }
        for handle in resting {
            if let Some(body) = physics.bodies.get_mut(handle) {
                body.sleep();
            }
        }
    }
}

/// The longest way a point of the body may have gone since it had this pose, m.
fn way(from: &Pose, body: &RigidBody, physics: &PhysicsWorld) -> f32 {
    let now = body.position();
    let colliders = body.colliders().iter().filter_map(|&c| physics.colliders.get(c));
    let reach = colliders.map(|c| {
        let sphere = c.shape().compute_local_bounding_sphere();
        sphere.center.length() + sphere.radius
    });
    let turn = now.rotation * from.rotation.inverse();
    let half_sine = turn.xyz().length();
    (now.translation - from.translation).length() + 2.0 * half_sine * reach.fold(0.0, f32::max)
}

fn touches(body: &RigidBody, physics: &PhysicsWorld) -> bool {
    body.colliders().iter().any(|&c| physics.narrow_phase.contact_pairs_with(c).any(|p| p.has_any_active_contact()))
}
