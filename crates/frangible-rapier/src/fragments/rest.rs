//! Pieces that rest, pieces that are removed, and the time that steps take with them.

use std::collections::BTreeSet;

use rapier3d::dynamics::{RigidBody, RigidBodyHandle, RigidBodyType};

use crate::config::AtRest;
use crate::world::{BreakableWorld, Key, key};

/// Steps over which their time is averaged.
const STEPS: f64 = 32.0;

/// Time between two looks for pieces to merge, s.
const MERGE_TIME: f64 = 0.1;

/// A contact whose normal points down by more than this, as the sine of an angle, presses on a piece from above and does not carry it.
const FROM_ABOVE: f32 = -0.5;

/// While steps take too long, one in this number of pieces of debris goes in each.
const SHARE: usize = 50;

impl BreakableWorld {
    /// Fading pieces with the scale at which to draw them, which falls from 1 to 0 within
    /// [`WorldConfig::fade_time`](crate::WorldConfig::fade_time). They have no collider and do not move.
    pub fn fading(&self) -> impl Iterator<Item = (RigidBodyHandle, f32)> {
        let (now, time) = (self.time(), f64::from(self.config.fade_time));
        let left = move |since: f64| (1.0 - (now - since) / time).clamp(0.0, 1.0) as f32;
        let fading = self.state.fading.iter();
        fading.map(move |&(handle, since)| (handle, left(since)))
    }

    /// Does with pieces that have rested for long what [`AtRest`] says.
    pub(crate) fn retire(&mut self) {
        let rested = match self.config.at_rest {
            AtRest::Sleep => return,
            // A heap that settles piece by piece would be made anew in each step.
            AtRest::Merge if !self.is_time_to_merge() => return,
            _ => self.rested(),
        };
        for &handle in &rested {
            self.state.asleep.remove(&key(handle));
        }
        match self.config.at_rest {
            AtRest::Go => rested.into_iter().for_each(|handle| self.let_go(handle)),
            AtRest::Merge => self.merge(&rested),
            _ => {
                for handle in rested {
                    if let Some(body) = self.physics.bodies.get_mut(handle) {
                        body.set_body_type(RigidBodyType::Fixed, false);
                    }
                }
            }
        }
    }

    /// Returns true if the step that has just been done crosses a multiple of [`MERGE_TIME`].
    fn is_time_to_merge(&self) -> bool {
        let turn = |time: f64| (time / MERGE_TIME).floor();
        turn(self.time()) != turn(self.time() - f64::from(self.config.dt))
    }

    /// Pieces that have lain still for [`WorldConfig::rest_time`](crate::WorldConfig::rest_time) on what stays where it is.
    fn rested(&mut self) -> Vec<RigidBodyHandle> {
        let pieces: Vec<RigidBodyHandle> = self.siblings.fragments().collect();
        let mut still: Vec<RigidBodyHandle> = (pieces.into_iter())
            .filter(|&handle| self.lies_still(handle))
            .collect();
        let mut resting: BTreeSet<Key> = still.iter().map(|&handle| key(handle)).collect();
        // One that stays behind may carry others, which then stay behind as well.
        loop {
            let count = still.len();
            still.retain(|&handle| {
                let rests = !self.is_carried_by_what_may_go(handle, &resting);
                if !rests {
                    resting.remove(&key(handle));
                }
                rests
            });
            if still.len() == count {
                return still;
            }
        }
    }

    /// Returns true if a piece has been asleep, or in its place, for long.
    fn lies_still(&mut self, handle: RigidBodyHandle) -> bool {
        let now = self.time();
        let Some(body) = self.physics.bodies.get(handle).filter(|b| b.is_dynamic()) else {
            self.state.asleep.remove(&key(handle));
            return false;
        };
        let slept = if body.is_sleeping() {
            now - *self.state.asleep.entry(key(handle)).or_insert(now)
        } else {
            self.state.asleep.remove(&key(handle));
            0.0
        };
        // A heap sleeps when all of it may; one that creeps keeps the others awake.
        let stayed = f64::from(self.state.places.stayed(handle));
        slept.max(stayed) >= f64::from(self.config.rest_time)
            && !self.falls(handle)
            && (self.config.at_rest != AtRest::Merge || self.can_merge(handle))
    }

    /// Returns true if a piece moves as one whose support has gone does after a step, before it has left its place. A piece that rocks where it
    /// lies does not fall.
    fn falls(&self, piece: RigidBodyHandle) -> bool {
        let a_step = self.physics.gravity.length() * self.config.dt;
        self.state.places.mean_velocity(piece).length() > 0.25 * a_step
    }

    /// Returns true if a piece lies on, or leans against, a body that may leave it in the air: one that can move and does not rest itself, or one
    /// that is held and can break. A body that only lies on top of it does not count.
    fn is_carried_by_what_may_go(&self, piece: RigidBodyHandle, resting: &BTreeSet<Key>) -> bool {
        let physics = &self.physics;
        let up = -physics.gravity.normalize_or_zero();
        let may_go = |handle: RigidBodyHandle| {
            let fixed = physics.bodies.get(handle).is_none_or(RigidBody::is_fixed);
            if fixed {
                self.state.breakables.contains_key(&key(handle))
            } else {
                !resting.contains(&key(handle))
            }
        };
        let own = physics.bodies.get(piece).map_or(&[][..], |b| b.colliders());
        own.iter().any(|&own| {
            let mut pairs = physics.narrow_phase.contact_pairs_with(own);
            pairs.any(|pair| {
                let (other, side) = if pair.collider1 == own {
                    (pair.collider2, -1.0)
                } else {
                    (pair.collider1, 1.0)
                };
                let carries = pair.manifolds().iter().any(|manifold| {
                    !manifold.points.is_empty() && side * manifold.data.normal.dot(up) > FROM_ABOVE
                });
                let body = physics.colliders.get(other).and_then(|c| c.parent());
                pair.has_any_active_contact() && carries && body.is_some_and(may_go)
            })
        })
    }

    /// Removes a piece: at once, or as one without colliders that fades.
    pub(crate) fn let_go(&mut self, handle: RigidBodyHandle) {
        self.loosen_with_load(vec![handle]);
        self.state.surfaces.remove(&key(handle));
        self.state.breakables.remove(&key(handle));
        if self.config.fade_time <= 0.0 {
            self.physics.remove_body(handle);
            return;
        }
        let Some(body) = self.physics.bodies.get_mut(handle) else {
            return;
        };
        body.set_body_type(RigidBodyType::Fixed, false);
        let colliders = body.colliders().to_vec();
        for collider in colliders {
            self.physics.remove_collider(collider);
        }
        let now = self.time();
        self.state.fading.push_back((handle, now));
    }

    /// Removes pieces that have faded.
    pub(crate) fn fade(&mut self) {
        let (now, time) = (self.time(), f64::from(self.config.fade_time));
        let faded = |&mut (_, since): &mut (RigidBodyHandle, f64)| now - since >= time;
        while let Some((handle, _)) = self.state.fading.pop_front_if(faded) {
            self.physics.remove_body(handle);
        }
    }

    /// Takes note of how long a step took, s. While steps take too long in the mean, one in fifty pieces of debris goes in each.
    pub(crate) fn note_step_time(&mut self, seconds: f64) {
        self.mean_step += (seconds - self.mean_step) / STEPS;
        if self.mean_step > f64::from(self.config.step_time) {
            let count = self.state.debris.len();
            self.limit_debris(count - count.div_ceil(SHARE));
        }
    }
}
