//! Events of a step.

use std::sync::Arc;

use frangible::internals::BodyState;
use frangible::{Asset, Contact, Fracture, ImpactReport};
use rapier3d::dynamics::{ImpulseJointHandle, RigidBodyHandle};
use rapier3d::math::{Pose, Vector};

/// Cause of a break.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum BreakCause {
    /// It was hit, or hit something.
    Impact,
    /// The load that it carried: resting contacts, and its own weight when it is held.
    Rest,
    /// [`BreakableWorld::blast`](crate::BreakableWorld::blast).
    Blast,
    /// [`BreakableWorld::fracture_at`](crate::BreakableWorld::fracture_at).
    Script,
}

/// A body broke.
#[derive(Clone, Debug)]
pub struct BreakEvent {
    /// Number of the step, from 0.
    pub step: u64,
    /// Handle of the body that broke; it is no longer in the world.
    pub parent: RigidBodyHandle,
    /// Cause of the break.
    pub cause: BreakCause,
    /// Asset of the body that broke.
    pub asset: Arc<Asset>,
    /// The new bodies, in the order of [`Fracture::fragments`]. Debris may be removed again later.
    pub fragments: Vec<RigidBodyHandle>,
    /// Impulse joints of the body that no fragment holds; they are no longer in the world. The others are a fragment's now, with the same
    /// handles.
    pub released_joints: Vec<ImpulseJointHandle>,
    /// The pieces, their meshes and the report.
    pub fracture: Arc<Fracture>,
    /// The contacts that broke it, body frame. Of a resting load: the pushes of one step, speed 0, friction within the
    /// normal. Empty for a blast and a scripted blow.
    pub contacts: Vec<Contact>,
    /// Bodies that hit it, or lay on it, without those removed or broken in the same step.
    pub strikers: Vec<RigidBodyHandle>,
    /// Pose of the body when it broke, at the start of the step.
    pub pose: Pose,
    /// Velocity of its centre of mass then, m/s.
    pub linvel: Vector,
    /// Angular velocity then, rad/s.
    pub angvel: Vector,
    /// Energy taken from the motion for the cracks, J: what the blow took into vibration first, then a toll. At most
    /// `fracture.report.fracture_energy`, less when the pieces hardly moved against each other.
    pub energy_paid: f64,
    /// Kinetic energy before the step, of the body and of all that it pushed in the step, directly or through others, J; of a break after
    /// the step, of the body and of what hit it; of a blast or scripted blow, of the body alone.
    pub kinetic_before: f64,
    /// Kinetic energy of all these after the step, J, the pieces in place of the bodies; of a blast or scripted blow, of the fragments
    /// before the step moves them. Together with `cracks_together` at most `kinetic_before` + `work`, but for rounding.
    pub kinetic_after: f64,
    /// Work of gravity on them in the step where it speeds them up, or of the blast or scripted blow, J.
    pub work: f64,
    /// Fracture energy of the body and of those of the others that broke in the same step, J.
    pub cracks_together: f64,
}

/// An impact, blast or scripted blow that broke nothing, or a resting load that cracked a body without parting it;
/// recorded on request.
#[derive(Clone, Debug)]
pub struct HeldEvent {
    /// Number of the step, from 0.
    pub step: u64,
    /// The body that was hit.
    pub body: RigidBodyHandle,
    /// The contacts, body frame; as [`BreakEvent::contacts`].
    pub contacts: Vec<Contact>,
    /// Strength over the bound of the stress: how many times as hard the blow could have been, at least.
    pub margin: f64,
    /// Report of the fracture.
    pub report: ImpactReport,
    /// Its cracks from now on, where new ones ran; the body has them already.
    pub state: Option<BodyState>,
}
