//! A copy of the world's state, to undo a step.

use rapier3d::dynamics::{
    ImpulseJointSet, IslandManager, MultibodyJointSet, RigidBodySet, SoftBodySet,
};
use rapier3d::geometry::{BroadPhaseBvh, ColliderSet, NarrowPhase};
use rapier3d::pipeline::PhysicsWorld;

use crate::fragments::siblings::Siblings;

/// Everything a step changes. Rapier's pipelines hold only workspaces, so leaving them out still gives the same bits.
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
    }
}
