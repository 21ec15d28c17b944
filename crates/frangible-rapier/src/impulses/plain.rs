//! Rapier's bodies as plain numbers ([`frangible::internals::rigid`]), and back.

use frangible::glam::DMat3;
use frangible::internals::rigid::{self, Rigid};
use rapier3d::dynamics::{RigidBody, RigidBodyHandle, RigidBodySet, RigidBodyVelocity};

use crate::impulses::motion::{centre, world_inertia};

/// A body as plain numbers. Locked axes do not give way, and nothing moves a body that is not dynamic.
pub(crate) fn plain(body: &RigidBody) -> Rigid {
    let motion = [
        centre(body),
        body.linvel().as_dvec3(),
        body.angvel().as_dvec3(),
    ];
    if !body.is_dynamic() || !body.is_enabled() {
        return Rigid::immovable(motion);
    }
    let free = Rigid::free(f64::from(body.mass()), world_inertia(body), motion);
    if body.locked_axes().is_empty() || !free.gives_way() {
        return free;
    }
    let mass = body.mass_properties();
    let turned = frangible::glam::Vec3::AXES
        .map(|axis| (mass.effective_world_inv_inertia * axis).as_dvec3());
    Rigid {
        inverse_mass: mass.effective_inv_mass.as_dvec3().min_element(),
        inverse_inertia: DMat3::from_cols(turned[0], turned[1], turned[2]),
        ..free
    }
}

/// Several bodies with their handles, to be changed and put back.
pub(crate) struct Plain {
    handles: Vec<RigidBodyHandle>,
    pub(crate) bodies: Vec<Rigid>,
}

impl Plain {
    /// Takes the bodies of these handles that exist.
    pub(crate) fn of(set: &RigidBodySet, handles: &[RigidBodyHandle]) -> Self {
        let there = handles
            .iter()
            .filter_map(|&h| Some((h, plain(set.get(h)?))));
        let (handles, bodies) = there.unzip();
        Self { handles, bodies }
    }

    /// Sets the bodies' velocities, and wakes those that move otherwise than before.
    pub(crate) fn put_back(&self, set: &mut RigidBodySet) {
        for (&handle, body) in self.handles.iter().zip(&self.bodies) {
            let velocity = RigidBodyVelocity {
                linvel: body.linear.as_vec3(),
                angvel: body.angular.as_vec3(),
            };
            if let Some(there) = set.get_mut(handle)
                && body.gives_way()
                && (there.linvel(), there.angvel()) != (velocity.linvel, velocity.angvel)
            {
                there.set_vels(velocity, true);
            }
        }
    }
}

/// Takes up to `energy` J from the motion of fragments and strikers against each other. Returns the energy taken, J.
pub(crate) fn take_energy(
    set: &mut RigidBodySet,
    fragments: &[RigidBodyHandle],
    strikers: &[RigidBodyHandle],
    energy: f64,
) -> f64 {
    let mut group = Plain::of(set, &[fragments, strikers].concat());
    let taken = rigid::take_energy(&mut group.bodies, energy);
    group.put_back(set);
    taken
}
