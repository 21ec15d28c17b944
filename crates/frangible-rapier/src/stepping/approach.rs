//! Search for the breakable bodies that may be hit in the coming step: only they make a copy of the world worth its cost.
//!
//! A contact approaches faster than the threshold only if one of its two bodies has a point faster than half
//! of it. So: find the fast bodies (one bound per body), then the breakables whose swept bounds meet those of
//! a fast body, or that are fast and near anything. A world at rest costs one pass over the velocities.

use rapier3d::dynamics::{RigidBody, RigidBodyHandle};
use rapier3d::geometry::Aabb;
use rapier3d::parry::bounding_volume::BoundingVolume;
use rapier3d::pipeline::PhysicsWorld;

use crate::world::{BreakableWorld, key};

impl BreakableWorld {
    /// Returns the breakable bodies that may be hit hard enough to be tested, or fail under their load, within this time, s. While there are
    /// none, steps may be longer.
    pub fn near_within(&mut self, seconds: f32) -> Vec<RigidBodyHandle> {
        let dt = std::mem::replace(&mut self.physics.integration_parameters.dt, seconds);
        let near = self.near();
        self.physics.integration_parameters.dt = dt;
        near
    }

    /// Breakable bodies that may be hit in the coming step, or break under their load; in the order of handles.
    pub(super) fn near(&self) -> Vec<RigidBodyHandle> {
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
}

/// Handles of breakables (in the given order) that may be hit at `speed` m/s or more in the next step.
fn candidates(
    physics: &PhysicsWorld,
    breakables: impl Iterator<Item = RigidBodyHandle>,
    speed: f32,
) -> Vec<RigidBodyHandle> {
    let fast = |body: &RigidBody| is_fast(body, 0.5 * speed);
    let movers: Vec<(RigidBodyHandle, Option<Aabb>)> = physics
        .bodies
        .iter()
        .filter(|(_, body)| moves(body) && fast(body))
        .map(|(handle, body)| (handle, swept_bounds(physics, body)))
        .collect();
    if movers.is_empty() {
        return Vec::new();
    }
    breakables
        .filter(|&handle| {
            let Some(body) = physics.bodies.get(handle) else {
                return false;
            };
            let Some(bounds) = swept_bounds(physics, body) else {
                return false;
            };
            let meets = |other: &Option<Aabb>| other.is_some_and(|other| other.intersects(&bounds));
            movers
                .iter()
                .any(|(other, aabb)| *other != handle && meets(aabb))
                || fast(body)
                    && physics.colliders.iter().any(|(_, collider)| {
                        collider.parent() != Some(handle) && meets(&Some(collider.compute_aabb()))
                    })
        })
        .collect()
}

/// Returns true if the next step moves a body.
pub(crate) fn moves(body: &RigidBody) -> bool {
    body.is_dynamic_or_kinematic() && body.is_enabled() && !body.is_sleeping()
}

/// Returns true if a body has a point that may be so fast, m/s.
pub(crate) fn is_fast(body: &RigidBody, speed: f32) -> bool {
    let points =
        body.linvel().length() + body.angvel().length() * body.mass_properties().max_extent();
    // NaN counts as fast: whatever meets it is looked at.
    points.is_nan() || points >= speed
}

/// Bounds of the body's enabled colliders over the coming step, widened by what Rapier looks ahead.
pub(crate) fn swept_bounds(physics: &PhysicsWorld, body: &RigidBody) -> Option<Aabb> {
    let parameters = &physics.integration_parameters;
    let margin = 2.0 * (parameters.prediction_distance() + parameters.allowed_linear_error());
    let next = body.predict_position_using_velocity_and_forces(parameters.dt);
    let mut bounds: Option<Aabb> = None;
    for &handle in body.colliders() {
        let Some(collider) = physics.colliders.get(handle).filter(|c| c.is_enabled()) else {
            continue;
        };
        let local = collider.position_wrt_parent().copied().unwrap_or_default();
        let swept = collider
            .shape()
            .compute_swept_aabb(&(*body.position() * local), &(next * local));
        let swept = swept.loosened(margin);
        bounds = Some(bounds.map_or(swept, |all| all.merged(&swept)));
    }
    bounds
}
