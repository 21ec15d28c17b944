//! Too much debris: the oldest goes. Dust goes soon: it has no collider, and falls through the floor.

use rapier3d::dynamics::RigidBodyHandle;

use crate::world::{BreakableWorld, key};

/// Lifetime of dust, s: it has fallen 5 m by then.
const DUST_TIME: f64 = 1.0;

impl BreakableWorld {
    /// Removes dust that has been there for long.
    pub(crate) fn settle_dust(&mut self) {
        let now = self.time();
        while let Some((handle, _)) = self
            .state
            .dust
            .pop_front_if(|(_, born)| now - *born > DUST_TIME)
        {
            self.physics.remove_body(handle);
            self.state.surfaces.remove(&key(handle));
        }
    }

    /// Removes the oldest debris until at most `limit` pieces are left.
    pub(crate) fn limit_debris(&mut self, limit: usize) {
        while self.state.debris.len() > limit {
            let Some(oldest) = self.state.debris.pop_front() else {
                return;
            };
            self.let_go(oldest);
        }
    }

    /// Drops what the world remembers of bodies that were removed from [`BreakableWorld::physics`].
    pub(crate) fn forget_removed(&mut self) {
        let bodies = &self.physics.bodies;
        let alive = |handle: RigidBodyHandle| bodies.contains(handle);
        let key_alive = |&(index, generation): &(u32, u32)| {
            alive(RigidBodyHandle::from_raw_parts(index, generation))
        };
        self.state.breakables.retain(|key, _| key_alive(key));
        self.state.surfaces.retain(|key, _| key_alive(key));
        self.state.clumps.retain(|key, _| key_alive(key));
        self.state.debris.retain(|&handle| alive(handle));
        self.state.fading.retain(|&(handle, _)| alive(handle));
        self.state.asleep.retain(|key, _| key_alive(key));
        self.siblings.purge(alive);
        self.keep_rubble_true();
    }
}
