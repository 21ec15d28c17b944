//! Bodies taken as one rigid body, and impulses on it.

use frangible::glam::{DMat3, DVec3};
use rapier3d::dynamics::{RigidBody, RigidBodyHandle, RigidBodySet, RigidBodyVelocity};

use crate::impulses::motion::{centre, world_inertia};

/// An impulse, N·s, and its moment about the centre of mass of what gets it, N·m·s.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Kick {
    pub(crate) linear: DVec3,
    pub(crate) moment: DVec3,
}

impl Kick {
    /// Sums up impulses at points, about a centre.
    pub(crate) fn about(centre: DVec3, pushes: impl Iterator<Item = (DVec3, DVec3)>) -> Self {
        let mut kick = Self::default();
        for (point, impulse) in pushes {
            kick.linear += impulse;
            kick.moment += (point - centre).cross(impulse);
        }
        kick
    }

    pub(crate) fn scaled(self, factor: f64) -> Self {
        Self {
            linear: self.linear * factor,
            moment: self.moment * factor,
        }
    }
}

/// One or more bodies that move as one.
#[derive(Clone, Debug)]
pub(crate) struct Cluster {
    /// None where it cannot be moved.
    members: Vec<RigidBodyHandle>,
    /// Centre of mass, m.
    pub(crate) centre: DVec3,
    /// Velocity there, m/s.
    pub(crate) linear: DVec3,
    /// Angular velocity, rad/s.
    pub(crate) angular: DVec3,
    inverse_mass: f64,
    inverse_inertia: DMat3,
}

impl Cluster {
    /// What cannot be moved, and stands still.
    pub(crate) fn earth() -> Self {
        Self {
            members: Vec::new(),
            centre: DVec3::ZERO,
            linear: DVec3::ZERO,
            angular: DVec3::ZERO,
            inverse_mass: 0.0,
            inverse_inertia: DMat3::ZERO,
        }
    }

    /// A single body; locked axes do not give way, and what is not dynamic is moved by nothing.
    pub(crate) fn single(handle: RigidBodyHandle, body: &RigidBody) -> Self {
        let own = Self {
            centre: centre(body),
            linear: body.linvel().as_dvec3(),
            angular: body.angvel().as_dvec3(),
            ..Self::earth()
        };
        if !body.is_dynamic() || !body.is_enabled() {
            return own;
        }
        let mass = body.mass_properties();
        let (inverse_mass, inverse_inertia) = if body.locked_axes().is_empty() {
            (1.0 / f64::from(body.mass()), world_inertia(body).inverse())
        } else {
            let turned =
                |axis: DVec3| (mass.effective_world_inv_inertia * axis.as_vec3()).as_dvec3();
            (
                mass.effective_inv_mass.as_dvec3().min_element(),
                DMat3::from_cols(turned(DVec3::X), turned(DVec3::Y), turned(DVec3::Z)),
            )
        };
        if !(inverse_mass.is_finite() && inverse_inertia.is_finite()) {
            return own;
        }
        Self {
            members: vec![handle],
            inverse_mass,
            inverse_inertia,
            ..own
        }
    }

    /// Makes one cluster of dynamic bodies, with their mass, momentum and angular momentum.
    pub(crate) fn of(bodies: &RigidBodySet, members: &[RigidBodyHandle]) -> Option<Self> {
        let all = || members.iter().map(|&h| &bodies[h]);
        let mass: f64 = all().map(|b| f64::from(b.mass())).sum();
        let about = all()
            .map(|b| centre(b) * f64::from(b.mass()))
            .sum::<DVec3>()
            / mass;
        let linear = all()
            .map(|b| b.linvel().as_dvec3() * f64::from(b.mass()))
            .sum::<DVec3>()
            / mass;
        let (mut inertia, mut spin) = (DMat3::ZERO, DVec3::ZERO);
        for body in all() {
            let (m, r, own) = (
                f64::from(body.mass()),
                centre(body) - about,
                world_inertia(body),
            );
            // Steiner: m (r² 1 − r rᵀ).
            let outer = DMat3::from_cols(r * r.x, r * r.y, r * r.z);
            inertia += own + (DMat3::from_diagonal(DVec3::splat(r.length_squared())) - outer) * m;
            spin += own * body.angvel().as_dvec3() + r.cross(body.linvel().as_dvec3() - linear) * m;
        }
        let inverse_inertia = inertia.inverse();
        let angular = inverse_inertia * spin;
        (linear.is_finite() && angular.is_finite()).then(|| Self {
            members: members.to_vec(),
            centre: about,
            linear,
            angular,
            inverse_mass: 1.0 / mass,
            inverse_inertia,
        })
    }

    /// Rate at which a kick works on its motion, J.
    pub(crate) fn work(&self, kick: Kick) -> f64 {
        kick.linear.dot(self.linear) + kick.moment.dot(self.angular)
    }

    /// What a kick changes velocity and angular velocity by.
    pub(crate) fn answer(&self, kick: Kick) -> (DVec3, DVec3) {
        (
            kick.linear * self.inverse_mass,
            self.inverse_inertia * kick.moment,
        )
    }

    /// How much it gives way to a kick: twice the energy that the kick brings to it at rest, J.
    pub(crate) fn give(&self, kick: Kick) -> f64 {
        let (linear, angular) = self.answer(kick);
        kick.linear.dot(linear) + kick.moment.dot(angular)
    }

    /// Lets a kick act, on all members as on one body.
    pub(crate) fn kick(&mut self, bodies: &mut RigidBodySet, kick: Kick) {
        let (linear, angular) = self.answer(kick);
        self.linear += linear;
        self.angular += angular;
        for &handle in &self.members {
            let Some(body) = bodies.get_mut(handle) else {
                continue;
            };
            let arm = if self.members.len() > 1 {
                centre(body) - self.centre
            } else {
                DVec3::ZERO
            };
            let linvel = body.linvel().as_dvec3() + linear + angular.cross(arm);
            let angvel = body.angvel().as_dvec3() + angular;
            body.set_vels(
                RigidBodyVelocity {
                    linvel: linvel.as_vec3(),
                    angvel: angvel.as_vec3(),
                },
                true,
            );
        }
    }
}

/// The largest share s of a kick, 0..=1, that adds at most `allowed` J: s · work + ½ s² · give.
pub(crate) fn affordable(work: f64, give: f64, allowed: f64) -> f64 {
    if work + 0.5 * give <= allowed {
        return 1.0;
    }
    // Exact in both limits, no difference of large numbers where work is negative.
    let root = (work * work + 2.0 * give * allowed).max(0.0).sqrt();
    let share = if work > 0.0 {
        2.0 * allowed / (work + root)
    } else {
        (root - work) / give
    };
    if share.is_finite() {
        share.clamp(0.0, 1.0)
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_affordable_share_of_a_kick_spends_what_is_allowed() {
        for (work, give, allowed) in [
            (1.0, 2.0, 0.5),
            (-1.0, 4.0, 0.0),
            (-1.0, 4.0, 0.3),
            (3.0, 0.0, 1.0),
            (2.0, 1e-9, 1.0),
        ] {
            let s = affordable(work, give, allowed);
            let spent = s * work + 0.5 * s * s * give;
            assert!((spent - allowed).abs() < 1e-9, "{s} spends {spent} J");
        }
        assert_eq!(affordable(-1.0, 0.5, 0.0), 1.0);
        assert_eq!(affordable(1.0, 0.5, 0.0), 0.0);
        assert_eq!(affordable(0.0, 0.0, 0.0), 1.0);
    }
}
