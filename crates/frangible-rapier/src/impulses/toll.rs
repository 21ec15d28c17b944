//! What the cracks cost, beyond what the blow has already taken, comes from the motion.
//!
//! The group of fragments and strikers has a common rigid motion: the one with its momentum P and angular
//! momentum L. Every body's deviation from it is scaled by √(1 − E/T), T the deviations' kinetic energy: the sum
//! of deviations carries no P and no L, so both stay; the energy falls by E exactly, or by T if E is more
//! (the pieces then move as one). With a striker or a fragment that cannot move, P and L are the Earth's business:
//! then the common motion is its own, so that the toll comes from the fall that broke the body, or from the striker
//! that broke what was held.

use frangible::glam::DVec3;
use rapier3d::dynamics::{RigidBody, RigidBodyHandle, RigidBodySet, RigidBodyVelocity};

use crate::impulses::cluster::Cluster;
use crate::impulses::motion::{centre, world_inertia};

/// A rigid motion: velocity at the origin `about`, and angular velocity.
struct Motion {
    about: DVec3,
    linear: DVec3,
    angular: DVec3,
}

/// Takes up to `energy` J from the group's motion; returns what was taken, J.
pub(crate) fn take_energy(
    bodies: &mut RigidBodySet,
    fragments: &[RigidBodyHandle],
    strikers: &[RigidBodyHandle],
    energy: f64,
) -> f64 {
    if energy.is_nan() || energy <= 0.0 {
        return 0.0;
    }
    let mut group: Vec<RigidBodyHandle> = fragments.iter().chain(strikers).copied().collect();
    group.retain(|&handle| bodies.get(handle).is_some_and(RigidBody::is_dynamic));
    let immovable = fragments
        .iter()
        .chain(strikers)
        .filter_map(|&s| bodies.get(s))
        .find(|s| !s.is_dynamic());
    let Some(common) = immovable
        .map(motion_of)
        .or_else(|| common_motion(bodies, &group))
    else {
        return 0.0;
    };

    let available: f64 = group
        .iter()
        .map(|&h| deviation_energy(&bodies[h], &common))
        .sum();
    if !(available.is_finite() && available > 0.0) {
        return 0.0;
    }
    let scale = (1.0 - energy / available).max(0.0).sqrt();
    for handle in group {
        let Some(body) = bodies.get_mut(handle) else {
            continue;
        };
        let at = common.linear + common.angular.cross(centre(body) - common.about);
        let linvel = at + (body.linvel().as_dvec3() - at) * scale;
        let angvel = common.angular + (body.angvel().as_dvec3() - common.angular) * scale;
        body.set_vels(
            RigidBodyVelocity {
                linvel: linvel.as_vec3(),
                angvel: angvel.as_vec3(),
            },
            true,
        );
    }
    energy.min(available)
}

fn motion_of(body: &RigidBody) -> Motion {
    Motion {
        about: centre(body),
        linear: body.linvel().as_dvec3(),
        angular: body.angvel().as_dvec3(),
    }
}

/// The rigid motion with the group's momentum and angular momentum.
fn common_motion(bodies: &RigidBodySet, group: &[RigidBodyHandle]) -> Option<Motion> {
    let whole = Cluster::of(bodies, group)?;
    Some(Motion {
        about: whole.centre,
        linear: whole.linear,
        angular: whole.angular,
    })
}

fn deviation_energy(body: &RigidBody, common: &Motion) -> f64 {
    let at = common.linear + common.angular.cross(centre(body) - common.about);
    let (u, w) = (
        body.linvel().as_dvec3() - at,
        body.angvel().as_dvec3() - common.angular,
    );
    0.5 * f64::from(body.mass()) * u.length_squared() + 0.5 * w.dot(world_inertia(body) * w)
}
