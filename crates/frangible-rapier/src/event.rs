//! What happened in a step.

use std::sync::Arc;

use frangible::{Asset, BodyState, Contact, Fracture, ImpactReport};
use rapier3d::dynamics::RigidBodyHandle;
use rapier3d::math::{Pose, Vector};

/// A body broke.
#[derive(Clone, Debug)]
pub struct BreakEvent {
    /// Number of the step, from 0.
    pub step: u64,
    /// Handle of the body that broke; it is no longer in the world.
    pub parent: RigidBodyHandle,
    /// What the body was.
    pub asset: Arc<Asset>,
    /// The new bodies, in the order of [`Fracture::fragments`]. Debris may be removed again later.
    pub fragments: Vec<RigidBodyHandle>,
    /// The pieces, their meshes and the report.
    pub fracture: Arc<Fracture>,
    /// The contacts that broke it, body frame.
    pub contacts: Vec<Contact>,
    /// What hit it: bodies, without those removed or broken in the same step.
    pub strikers: Vec<RigidBodyHandle>,
    /// Pose of the body when it broke, at the start of the step.
    pub pose: Pose,
    /// Velocity of its centre of mass then, m/s.
    pub linvel: Vector,
    /// Angular velocity then, rad/s.
    pub angvel: Vector,
    /// Energy taken from the motion for the cracks, J: at most `fracture.report.fracture_energy`, less when the
    /// pieces hardly moved against each other.
    pub energy_paid: f64,
}

/// An impact that broke nothing; recorded on request.
#[derive(Clone, Debug)]
pub struct HeldEvent {
    /// Number of the step, from 0.
    pub step: u64,
    /// The body that was hit.
    pub body: RigidBodyHandle,
    /// The contacts, body frame.
    pub contacts: Vec<Contact>,
    /// Strength over the bound of the stress: how many times as hard the blow could have been, at least.
    pub margin: f64,
    /// What the fracture found.
    pub report: ImpactReport,
    /// Its cracks from now on, where new ones ran; the body has them already.
    pub state: Option<BodyState>,
}
