//! Energy, momentum and rest of the whole world.

use frangible::glam::{DMat3, DVec3};
use rapier3d::dynamics::RigidBody;

use crate::world::BreakableWorld;

/// Inertia tensor about the centre of mass in world axes, kg·m².
pub(crate) fn world_inertia(body: &RigidBody) -> DMat3 {
    let local = body.mass_properties().local_mprops;
    let frame = (*body.rotation() * local.principal_inertia_local_frame)
        .as_dquat()
        .normalize();
    let axes = DMat3::from_quat(frame);
    axes * DMat3::from_diagonal(local.principal_inertia().as_dvec3()) * axes.transpose()
}

/// Translation and rotation together, J.
pub(crate) fn kinetic_energy(body: &RigidBody) -> f64 {
    if !body.is_dynamic() {
        return 0.0;
    }
    let (v, w) = (body.linvel().as_dvec3(), body.angvel().as_dvec3());
    0.5 * f64::from(body.mass()) * v.length_squared() + 0.5 * w.dot(world_inertia(body) * w)
}

/// Centre of mass in the world, m.
pub(crate) fn centre(body: &RigidBody) -> DVec3 {
    (*body.position() * body.local_center_of_mass()).as_dvec3()
}

impl BreakableWorld {
    fn dynamic(&self) -> impl Iterator<Item = &RigidBody> {
        self.physics
            .bodies
            .iter()
            .map(|(_, body)| body)
            .filter(|body| body.is_dynamic() && body.is_enabled())
    }

    /// Kinetic energy of all dynamic bodies, J.
    #[must_use]
    pub fn kinetic_energy(&self) -> f64 {
        self.dynamic().map(kinetic_energy).sum()
    }

    /// Momentum of all dynamic bodies, N·s.
    #[must_use]
    pub fn momentum(&self) -> DVec3 {
        self.dynamic()
            .map(|body| body.linvel().as_dvec3() * f64::from(body.mass()))
            .sum()
    }

    /// Angular momentum of all dynamic bodies about the world's origin, N·m·s.
    #[must_use]
    pub fn angular_momentum(&self) -> DVec3 {
        self.dynamic()
            .map(|body| {
                let momentum = body.linvel().as_dvec3() * f64::from(body.mass());
                centre(body).cross(momentum) + world_inertia(body) * body.angvel().as_dvec3()
            })
            .sum()
    }

    /// True when every dynamic body sleeps.
    #[must_use]
    pub fn at_rest(&self) -> bool {
        self.dynamic().all(RigidBody::is_sleeping)
    }
}
