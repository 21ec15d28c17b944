//! Motions of bodies before the step, which distinguish impacts from resting contacts without a copy of the world.

use std::collections::BTreeMap;

use rapier3d::dynamics::{RigidBody, RigidBodyHandle, RigidBodySet, RigidBodyVelocity};
use rapier3d::math::{Pose, Vector};
use rapier3d::pipeline::PhysicsWorld;

use crate::world::{Key, key};

/// Bodies as they were before the step.
pub(crate) trait Before {
    fn body(&self, handle: RigidBodyHandle) -> Option<&RigidBody>;
}

impl Before for RigidBodySet {
    fn body(&self, handle: RigidBodyHandle) -> Option<&RigidBody> {
        self.get(handle)
    }
}

impl Before for BTreeMap<Key, RigidBody> {
    fn body(&self, handle: RigidBodyHandle) -> Option<&RigidBody> {
        self.get(&key(handle))
    }
}

#[derive(Clone, Copy, Debug)]
struct Motion {
    handle: RigidBodyHandle,
    pose: Pose,
    linvel: Vector,
    angvel: Vector,
    /// Upper bound of the speed of its points relative to the centre of mass, m/s.
    spin: f32,
}

/// Pose and velocity of every body that is not fixed, by index.
#[derive(Clone, Debug, Default)]
pub(crate) struct Motions(Vec<Option<Motion>>);

impl Motions {
    /// Replaces the motions of before by the present ones.
    pub(crate) fn note(&mut self, bodies: &RigidBodySet) {
        self.0.clear();
        for (handle, body) in bodies.iter().filter(|(_, b)| !b.is_fixed()) {
            let index = handle.into_raw_parts().0 as usize;
            if self.0.len() <= index {
                self.0.resize(index + 1, None);
            }
            let (linvel, angvel) = (body.linvel(), body.angvel());
            let reach = body.mass_properties().max_extent();
            self.0[index] = Some(Motion {
                handle,
                pose: *body.position(),
                linvel,
                angvel,
                spin: angvel.length() * reach,
            });
        }
    }

    fn of(&self, handle: RigidBodyHandle) -> Option<&Motion> {
        let motion = self.0.get(handle.into_raw_parts().0 as usize)?;
        motion.as_ref().filter(|m| m.handle == handle)
    }

    /// Returns true if two bodies may have come nearer at `speed`, m/s; no body counts as a still one.
    pub(crate) fn may_meet_at(
        &self,
        speed: f32,
        a: Option<RigidBodyHandle>,
        b: Option<RigidBodyHandle>,
    ) -> bool {
        let motion = |h: Option<RigidBodyHandle>| {
            let motion = h.and_then(|h| self.of(h));
            motion.map_or((Vector::ZERO, 0.0), |m| (m.linvel, m.spin))
        };
        let ((v, a), (w, b)) = (motion(a), motion(b));
        let most = (v - w).length() + a + b;
        // NaN counts as fast: whatever meets it is looked at.
        most.is_nan() || most >= speed
    }

    /// The body as it was.
    pub(crate) fn body_before(
        &self,
        physics: &PhysicsWorld,
        handle: RigidBodyHandle,
    ) -> Option<RigidBody> {
        let mut body = physics.bodies.get(handle)?.clone();
        if let Some(motion) = self.of(handle) {
            body.set_position(motion.pose, false);
            let (linvel, angvel) = (motion.linvel, motion.angvel);
            body.set_vels(RigidBodyVelocity { linvel, angvel }, false);
        }
        Some(body)
    }
}
