//! Merged pieces that come loose: those that can break and lie in the way of something fast, and what lies on them.
//!
//! A piece in a rubble has no contacts of its own that could be judged. So before the step that may hit it, it becomes a body again, and
//! the step is one like any other. Pieces that cannot break stay where they are, as the floor does.

use rapier3d::dynamics::{RigidBody, RigidBodyHandle};
use rapier3d::geometry::{Aabb, ColliderSet};
use rapier3d::parry::bounding_volume::BoundingVolume;

use crate::stepping::approach::{is_fast, moves, swept_bounds};
use crate::world::{BreakableWorld, key};

impl BreakableWorld {
    /// Makes a merged piece a body of its own again, with those that lie on it; whether it was merged.
    ///
    /// To let one piece alone come loose, make it dynamic in [`BreakableWorld::physics`].
    pub fn loosen(&mut self, piece: RigidBodyHandle) -> bool {
        let merged = self.state.rubble.contains(piece);
        self.loosen_with_load(vec![piece]);
        self.rebuild_rubble();
        merged
    }

    /// Makes a piece a body again that is in a rubble, but leaves the rubble as it is.
    pub(super) fn loosen_one(&mut self, piece: RigidBodyHandle) {
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
        // What it may hit is fixed. Chips break nothing.
        let counts = |body: &RigidBody| {
            moves(body)
                && is_fast(body, self.config.impact_speed)
                && (!body.is_dynamic() || body.mass() >= self.config.debris_mass)
        };
        let ways = bodies.iter().filter(|(_, body)| counts(body));
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

    /// Loosens pieces, and those that lie on them.
    fn loosen_with_load(&mut self, mut pieces: Vec<RigidBodyHandle>) {
        let up = -self.physics.gravity;
        let margin = 2.0 * self.physics.integration_parameters.prediction_distance();
        while let Some(piece) = pieces.pop() {
            if !self.state.rubble.contains(piece) {
                continue;
            }
            self.loosen_one(piece);
            let bodies = &self.physics.bodies;
            let height = |piece| {
                bodies
                    .get(piece)
                    .map(|b: &RigidBody| b.center_of_mass().dot(up))
            };
            let own = bodies
                .get(piece)
                .and_then(|b| swept_bounds(&self.physics, b));
            let (Some(bounds), Some(here)) = (own, height(piece)) else {
                continue;
            };
            let near = self.merged_in(&bounds.loosened(margin)).into_iter();
            pieces.extend(near.filter(|&other| height(other).is_some_and(|there| there > here)));
        }
    }

    /// Merged pieces whose bounds meet these.
    fn merged_in(&self, bounds: &Aabb) -> Vec<RigidBodyHandle> {
        let mut found = Vec::new();
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
            for piece in parts.filter_map(|part| rubble.parts.get(part as usize)) {
                if self.state.rubble.contains(*piece) && !found.contains(piece) {
                    found.push(*piece);
                }
            }
        }
        found.sort_by_key(|&piece| key(piece));
        found
    }
}
