//! Merged pieces that come loose: those that can break and lie in the way of something fast, and those that lie on them.
//!
//! A piece in a rubble has no contacts of its own that could be judged. So before the step that may hit it, it becomes a body again, and
//! the step is one like any other. Pieces that cannot break stay where they are, as the floor does.

use std::collections::BTreeMap;

use rapier3d::dynamics::{RigidBody, RigidBodyHandle};
use rapier3d::geometry::{Aabb, ColliderSet};
use rapier3d::parry::bounding_volume::BoundingVolume;

use crate::stepping::approach::{is_fast, moves, swept_bounds};
use crate::world::{BreakableWorld, key};

impl BreakableWorld {
    /// Makes a merged piece, and the pieces that lie on it, separate bodies again. Returns true if it was merged. The same happens at the next
    /// step to a piece that is removed from [`BreakableWorld::physics`] or made dynamic there.
    pub fn loosen(&mut self, piece: RigidBodyHandle) -> bool {
        let merged = self.state.rubble.contains(piece);
        self.loosen_with_load(vec![piece]);
        self.rebuild_rubble();
        merged
    }

    /// Makes a piece a body again that is in a rubble, but leaves the rubble as it is.
    fn loosen_one(&mut self, piece: RigidBodyHandle) {
        if self.state.rubble.strike_off(piece) {
            self.state.places.disturb(&mut self.physics, piece);
            self.set_collides(piece, true);
        }
    }

    /// Loosens pieces that the coming step may break.
    pub(crate) fn loosen_hit(&mut self) {
        if self.state.rubble.len() == 0 {
            return;
        }
        let bodies = &self.physics.bodies;
        // The step itself makes a body that falls faster.
        let speed = self.config.impact_speed - self.physics.gravity.length() * self.config.dt;
        // The bodies that it may hit are fixed. Chips break nothing.
        let counts = |(handle, body): &(RigidBodyHandle, &RigidBody)| {
            moves(body)
                && is_fast(body, speed)
                && (body.mass() >= self.config.debris_mass
                    || self.siblings.origin(*handle).is_none())
        };
        let ways = bodies.iter().filter(counts);
        let ways = ways.filter_map(|(_, body)| swept_bounds(&self.physics, body));
        let breakables = &self.state.breakables;
        let mut hit = Vec::new();
        for way in ways {
            let pieces = self.merged_in(&way).into_iter();
            hit.extend(pieces.filter(|&piece| breakables.contains_key(&key(piece))));
        }
        if !hit.is_empty() {
            self.loosen_with_load(hit);
            self.rebuild_rubble();
        }
    }

    /// Loosens the pieces for which this is true.
    pub(crate) fn loosen_where(&mut self, is_loose: impl Fn(&RigidBody, &ColliderSet) -> bool) {
        let physics = &self.physics;
        let loose = |&piece: &RigidBodyHandle| {
            let body = physics.bodies.get(piece);
            body.is_some_and(|body| is_loose(body, &physics.colliders))
        };
        let loose: Vec<RigidBodyHandle> = self.state.rubble.pieces().filter(loose).collect();
        self.loosen_with_load(loose);
        self.rebuild_rubble();
    }

    /// Loosens pieces, and those that lie on them. Pieces that are no longer in the world leave the rubble in the same way.
    pub(super) fn loosen_with_load(&mut self, mut pieces: Vec<RigidBodyHandle>) {
        let parameters = &self.physics.integration_parameters;
        let margin = 2.0 * parameters.prediction_distance();
        let error = parameters.allowed_linear_error();
        let up = -self.physics.gravity.normalize_or_zero();
        let top = |b: Aabb| b.center().dot(up) + b.half_extents().dot(up.abs());
        while let Some(piece) = pieces.pop() {
            let Some(bounds) = self.state.rubble.bounds(piece) else {
                continue;
            };
            self.loosen_one(piece);
            // A long piece that leans on a small one may have its centre below that one's, but not its upper end.
            let height = top(bounds) + error;
            let near = self.merged_in(&bounds.loosened(margin)).into_iter();
            let rubble = &self.state.rubble;
            pieces.extend(near.filter(|&p| rubble.bounds(p).is_some_and(|b| top(b) > height)));
        }
    }

    /// Merged pieces whose bounds meet these.
    fn merged_in(&self, bounds: &Aabb) -> Vec<RigidBodyHandle> {
        let mut found = BTreeMap::new();
        for rubble in self.state.rubble.all.values() {
            let collider = self.physics.colliders.get(rubble.collider);
            let Some((collider, compound)) =
                collider.and_then(|c| Some((c, c.shape().as_compound()?)))
            else {
                continue;
            };
            // Its axes are the world's.
            let shift = -collider.translation();
            let local = Aabb::new(bounds.mins + shift, bounds.maxs + shift);
            let parts = compound.bvh().intersect_aabb(&local);
            let pieces = parts.filter_map(|part| rubble.parts.get(part as usize));
            let merged = pieces.filter(|&&piece| self.state.rubble.contains(piece));
            found.extend(merged.map(|&piece| (key(piece), piece)));
        }
        found.into_values().collect()
    }
}
