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
    /// An impact.
    Impact,
    /// A sustained load: resting contacts, and the weight of a supported body.
    Rest,
    /// [`BreakableWorld::blast`](crate::BreakableWorld::blast).
    Blast,
    /// [`BreakableWorld::fracture_at`](crate::BreakableWorld::fracture_at).
    Script,
}

/// Event: a body broke.
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
    /// Impulse joints of the body that moved to no fragment and were removed. The others are attached to fragments now, with the same
    /// handles.
    pub released_joints: Vec<ImpulseJointHandle>,
    /// The pieces, their meshes and the report.
    pub fracture: Arc<Fracture>,
    /// The contacts that broke the body, body frame. For a sustained load, the pushes of one step, with speed 0 and with friction included in
    /// the normal. Empty for a blast or a scripted blow.
    pub contacts: Vec<Contact>,
    /// Bodies that hit it or loaded it, except those removed or broken in the same step.
    pub strikers: Vec<RigidBodyHandle>,
    /// Pose of the body when it broke, at the start of the step.
    pub pose: Pose,
    /// Velocity of its centre of mass at that time, m/s.
    pub linvel: Vector,
    /// Angular velocity at that time, rad/s.
    pub angvel: Vector,
    /// Kinetic energy spent on cracks, J: first the energy that the blow put into vibration, then relative motion. At most
    /// `fracture.report.fracture_energy`, less if the pieces hardly move relative to each other.
    pub energy_paid: f64,
    /// Kinetic energy before the step, J: of the body and of all bodies that it pushed in the step, directly or indirectly; for a break after
    /// the step, of the body and its strikers; for a blast or scripted blow, of the body alone.
    pub kinetic_before: f64,
    /// Kinetic energy of all these after the step, J, the pieces in place of the bodies; of a blast or scripted blow, of the fragments
    /// before the step moves them. Together with `cracks_together` at most `kinetic_before` + `work`, but for rounding.
    pub kinetic_after: f64,
    /// Work of gravity on them in the step where it speeds them up, or of the blast or scripted blow, J.
    pub work: f64,
    /// Fracture energy of the body and of those of the others that broke in the same step, J.
    pub cracks_together: f64,
}

impl BreakEvent {
    /// Number of breaks that led to the body that broke: 0 for an original body.
    #[must_use]
    pub fn generation(&self) -> u32 {
        match self.fracture.clump(0) {
            Some(clump) => clump.generation() - 1,
            None => self
                .asset
                .portion()
                .map_or(0, |portion| portion.generation()),
        }
    }
}

/// Event: an impact, blast or scripted blow that did not break a body, or a sustained load that cracked it without breaking it. Recorded
/// on request.
#[derive(Clone, Debug)]
pub struct HeldEvent {
    /// Number of the step, from 0.
    pub step: u64,
    /// The body that was hit.
    pub body: RigidBodyHandle,
    /// The contacts, body frame; see [`BreakEvent::contacts`].
    pub contacts: Vec<Contact>,
    /// Strength over an upper bound of the stress: a lower bound of the factor by which the blow could have been harder.
    pub margin: f64,
    /// Report of the fracture.
    pub report: ImpactReport,
    /// The new state of cracks, if cracks ran; already applied to the body.
    pub state: Option<BodyState>,
}
