//! Friction's part of contact impulses.
//!
//! With [`FrictionModel::Coulomb`] Rapier keeps the tangential impulse of each point over the whole step, along a basis
//! that follows from the normal: it is read. Its default, `Simplified`, has one friction per up to four points and keeps
//! only that of the last substep, the same vector at each of them. In a resting contact every substep is alike, so the whole
//! is that × substeps, shared by normal impulse. A blow is over before the last substep, so its friction is found otherwise:
//! it acts against the slide before the step (Coulomb); a body with a single partner shows its size by the momentum
//! that its normal impulses and gravity do not explain. With more partners at once it is μ × the normal impulse. It is never more than ends the
//! slide: if a body falls straight down, the direction of the slide is rounding. (Rapier applies restitution after friction, so that the first
//! is a little less than the second.)

use frangible::Contact;
use rapier3d::dynamics::{FrictionModel, IntegrationParameters, RigidBody};
use rapier3d::geometry::{ContactManifold, TrackedContact};
use rapier3d::math::Vector;
use rapier3d::utils::OrthonormalBasis;

use crate::contact::contacts::{Point, weighted_mean};
use crate::contact::partner::inverse_effective_mass;

/// Friction impulse of a whole step on the **first** collider's body at this point, world axes, N·s, as the solver
/// left it. Exact with the Coulomb model; with the simplified one only where all substeps are alike.
pub(crate) fn solver_friction(
    manifold: &ContactManifold,
    point: &TrackedContact<rapier3d::geometry::ContactData>,
    parameters: &IntegrationParameters,
) -> Vector {
    let data = &point.data;
    match parameters.friction_model {
        FrictionModel::Coulomb => {
            let direction = -manifold.data.normal;
            let tangent = direction.orthonormal_vector();
            tangent * data.tangent_impulse.x + direction.cross(tangent) * data.tangent_impulse.y
        }
        FrictionModel::Simplified => {
            let shared = data.warmstart_tangent_world;
            let group = manifold
                .points
                .iter()
                .map(|p| &p.data)
                .filter(|d| d.impulse > 0.0 && d.warmstart_tangent_world == shared);
            let total: f32 = group.map(|d| d.impulse).sum();
            let substeps = parameters.num_solver_iterations as f32;
            let whole = shared * (substeps * data.impulse / total);
            // If nothing slides, Rapier divides zero by zero.
            if !whole.is_finite() {
                return Vector::ZERO;
            }
            // A landing has most of its normal impulse early: no more than Coulomb's law gives.
            whole.clamp_length_max(manifold.data.friction * data.impulse)
        }
    }
}

/// Gives the contacts of one pair the friction of their blow; `coefficient` is the pair's. `unexplained` is the impulse on
/// the body, N·s, body frame, that must have been friction, where that is known.
///
/// The slide is that of the impulses' centre before the step. Friction acts against it, is at most μ × the normal impulse,
/// and is spread over the contacts as the normal impulses are. One impulse ends the slide when it is |slide| / (tᵀ K t).
pub(crate) fn rub(
    contacts: &mut [Contact],
    body: &RigidBody,
    partner: Option<&RigidBody>,
    coefficient: f32,
    unexplained: Option<Vector>,
) {
    let Some((point, normal, total)) = weighted_mean(contacts) else {
        return;
    };
    let world = *body.position() * point;
    let other = partner.map_or(Vector::ZERO, |p| p.velocity_at_point(world));
    let relative = body.rotation().inverse() * (other - body.velocity_at_point(world));
    let slide = relative - normal * relative.dot(normal);
    let Some(direction) = slide.try_normalize() else {
        return;
    };
    let across = *body.rotation() * direction;
    let k = inverse_effective_mass(body, world, across)
        + partner.map_or(0.0, |p| inverse_effective_mass(p, world, across));
    let unexplained = unexplained.map_or(f32::INFINITY, |impulse| impulse.dot(direction));
    let size = unexplained.min(slide.length() / k).min(coefficient * total);
    if size.is_finite() && size > 0.0 {
        for contact in contacts {
            contact.friction = direction * (size * contact.impulse / total);
        }
    }
}

/// The impulse on a dynamic body in a step, N·s, that its normal impulses and gravity do not explain; body frame.
pub(crate) fn unexplained(
    before: &RigidBody,
    after: &RigidBody,
    gravity: Vector,
    dt: f32,
    points: &[Point],
) -> Option<Vector> {
    if !before.is_dynamic() {
        return None;
    }
    let fall = gravity * (before.gravity_scale() * dt);
    let gained = before.mass() * (after.linvel() - before.linvel() - fall);
    let normal: Vector = points.iter().map(|p| p.normal * p.impulse).sum();
    Some(before.rotation().inverse() * gained - normal)
}
