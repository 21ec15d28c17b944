//! A copy of the world's state, to undo a step.

use rapier3d::dynamics::{
    ImpulseJointSet, IslandManager, MultibodyJointSet, RigidBodySet, SoftBodySet,
};
use rapier3d::geometry::{BroadPhaseBvh, ColliderSet, NarrowPhase};
use rapier3d::pipeline::PhysicsWorld;

use crate::fragments::siblings::Siblings;

/// Everything a step changes. Rapier's pipeline and its solver for fast bodies are left out: what they remember of earlier steps is forgotten
/// when the state is restored.
pub(crate) struct Snapshot {
    pub(crate) bodies: RigidBodySet,
    colliders: ColliderSet,
    narrow_phase: NarrowPhase,
    islands: IslandManager,
    broad_phase: BroadPhaseBvh,
    impulse_joints: ImpulseJointSet,
    multibody_joints: MultibodyJointSet,
    soft_bodies: SoftBodySet,
    siblings: Siblings,
}

impl Snapshot {
    pub(crate) fn take(physics: &PhysicsWorld, siblings: &Siblings) -> Self {
        Self {
            bodies: physics.bodies.clone(),
            colliders: physics.colliders.clone(),
            narrow_phase: physics.narrow_phase.clone(),
            islands: physics.islands.clone(),
            broad_phase: physics.broad_phase.clone(),
            impulse_joints: physics.impulse_joints.clone(),
            multibody_joints: physics.multibody_joints.clone(),
            soft_bodies: physics.soft_bodies.clone(),
            siblings: siblings.clone(),
        }
    }

    pub(crate) fn restore(&self, physics: &mut PhysicsWorld, siblings: &mut Siblings) {
        physics.bodies = self.bodies.clone();
        physics.colliders = self.colliders.clone();
        physics.narrow_phase = self.narrow_phase.clone();
        physics.islands = self.islands.clone();
        physics.broad_phase = self.broad_phase.clone();
        physics.impulse_joints = self.impulse_joints.clone();
        physics.multibody_joints = self.multibody_joints.clone();
        physics.soft_bodies = self.soft_bodies.clone();
        *siblings = self.siblings.clone();
        forget_last_step(physics);
    }
}

/// Makes Rapier forget what it remembers of the step before. It keeps a list of the fixed colliders and one of the joints of bodies that are
/// awake, and takes them up again for as long as it sees no change. Sets that are put back bring no change with them, so that these lists would
/// name colliders and joints of another state: some that are missing, and not those that are there.
fn forget_last_step(physics: &mut PhysicsWorld) {
    physics.ccd_solver.invalidate_fixed_targets_cache();
    let old = std::mem::take(&mut physics.physics_pipeline);
    #[cfg(feature = "parallel")]
    physics.physics_pipeline.set_thread_pool(old.thread_pool());
    physics.physics_pipeline.counters = old.counters;
}
