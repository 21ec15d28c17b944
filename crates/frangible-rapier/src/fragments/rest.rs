//! Pieces that rest, pieces that go, and how long steps take with them.

use rapier3d::dynamics::{RigidBody, RigidBodyHandle, RigidBodyType};

use crate::config::AtRest;
use crate::world::{BreakableWorld, key};

/// Steps over which their time is averaged.
const STEPS: f64 = 32.0;

/// One in so many pieces of debris goes in each step that is too long.
const SHARE: usize = 50;

impl BreakableWorld {
    /// Pieces that go, with what is left of their size as one that shows them shrinks them: from 1 to 0 within
    /// [`WorldConfig::fade_time`](crate::WorldConfig::fade_time). They have no collider and do not move.
    pub fn fading(&self) -> impl Iterator<Item = (RigidBodyHandle, f32)> {
        let (now, time) = (self.time(), f64::from(self.config.fade_time));
        let left = move |since: f64| (1.0 - (now - since) / time).clamp(0.0, 1.0) as f32;
        let fading = self.state.fading.iter();
        fading.map(move |&(handle, since)| (handle, left(since)))
    }

    /// Does with pieces that have rested for long what [`AtRest`] says.
    pub(crate) fn retire(&mut self) {
        if self.config.at_rest == AtRest::Sleep {
            return;
        }
        let now = self.time();
        let pieces: Vec<RigidBodyHandle> = self.siblings.fragments().collect();
        let mut rested = Vec::new();
        for handle in pieces {
            let Some(body) = self.physics.bodies.get(handle).filter(|b| b.is_dynamic()) else {
                self.state.asleep.remove(&key(handle));
                continue;
            };
            let slept = if body.is_sleeping() {
                now - *self.state.asleep.entry(key(handle)).or_insert(now)
            } else {
                self.state.asleep.remove(&key(handle));
                0.0
            };
            // A heap sleeps when all of it may; one that creeps keeps the others awake.
            let stayed = f64::from(self.state.places.stayed(handle));
            if slept.max(stayed) >= f64::from(self.config.rest_time)
                && !self.falls(body)
                && !self.leans_on_what_moves(body)
            {
                rested.push(handle);
            }
        }
        for &handle in &rested {
            self.state.asleep.remove(&key(handle));
            match self.config.at_rest {
                AtRest::Go => self.let_go(handle),
                AtRest::Merge => {}
                _ => {
                    if let Some(body) = self.physics.bodies.get_mut(handle) {
                        body.set_body_type(RigidBodyType::Fixed, false);
                    }
                }
            }
        }
        if self.config.at_rest == AtRest::Merge {
            self.merge(&rested);
        }
    }

    /// Whether a piece moves as one whose support has gone does after a step: it has not left its place yet.
    fn falls(&self, piece: &RigidBody) -> bool {
        let a_step = self.physics.gravity.length() * self.config.dt;
        piece.linvel().length() > 0.5 * a_step
    }

    /// Whether a piece touches a body that can move and is no piece itself: it would stay in the air when that body leaves.
    fn leans_on_what_moves(&self, piece: &RigidBody) -> bool {
        let physics = &self.physics;
        piece.colliders().iter().any(|&own| {
            let mut pairs = physics.narrow_phase.contact_pairs_with(own);
            pairs.any(|pair| {
                let other = if pair.collider1 == own {
                    pair.collider2
                } else {
                    pair.collider1
                };
                let body = physics.colliders.get(other).and_then(|c| c.parent());
                pair.has_any_active_contact()
                    && body.is_some_and(|handle| {
                        let moves = physics.bodies.get(handle).is_some_and(|b| !b.is_fixed());
                        moves && self.siblings.origin(handle).is_none()
                    })
            })
        })
    }

    /// Lets a piece go: at once, or it is no body any more and fades.
    pub(crate) fn let_go(&mut self, handle: RigidBodyHandle) {
        self.state.surfaces.remove(&key(handle));
        self.state.breakables.remove(&key(handle));
        self.state.rubble.strike_off(handle);
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

    /// Removes what has faded.
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
