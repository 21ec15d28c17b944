//! The last guard against tunnelling: no centre of mass ever goes through a fixed surface.
//!
//! Rapier's sweep stops a fast body before a fixed one, but ignores pairs that touch already: a piece that lies
//! on a thin floor and is struck from above is pushed through it within a step. So after a step each fragment
//! and breakable that moved is traced by a ray from its old centre to its new one. If the ray meets a fixed
//! collider, the body is put back in front of it and loses the velocity into it; the floor takes that momentum.
//! A body whose centre of mass lies outside its own shape (a ring) is let through: the ring may fall over a post.

use rapier3d::dynamics::{RigidBody, RigidBodyHandle};
use rapier3d::geometry::Ray;
use rapier3d::math::Vector;
use rapier3d::pipeline::{PhysicsWorld, QueryFilter};

/// Motions shorter than this in a step are not traced, m: contacts deal with them.
const SHORT: f32 = 5e-4;

/// Handles and centres of mass before the step, of the bodies to guard.
pub(crate) type Centres = Vec<(RigidBodyHandle, Vector)>;

/// Centres of those bodies that may move.
pub(crate) fn centres(
    physics: &PhysicsWorld,
    bodies: impl Iterator<Item = RigidBodyHandle>,
) -> Centres {
    bodies
        .filter_map(|handle| {
            let body = physics
                .bodies
                .get(handle)
                .filter(|b| b.is_dynamic() && !b.is_sleeping())?;
            Some((handle, body.center_of_mass()))
        })
        .collect()
}

/// Puts back what went through a fixed surface since `before`.
pub(crate) fn put_back(physics: &mut PhysicsWorld, before: &Centres) {
    let mut moves = Vec::new();
    {
        let queries = physics.broad_phase.as_query_pipeline(
            physics.narrow_phase.query_dispatcher(),
            &physics.bodies,
            &physics.colliders,
            QueryFilter::only_fixed().exclude_sensors(),
        );
        for &(handle, old) in before {
            let Some(body) = physics.bodies.get(handle) else {
                continue;
            };
            let way = body.center_of_mass() - old;
            let length = way.length();
            if length.is_nan() || length <= SHORT {
                continue;
            }
            let ray = Ray::new(old, way / length);
            let Some((wall, hit)) = queries.cast_ray_and_get_normal(&ray, length, true) else {
                continue;
            };
            // A ray that starts inside has no normal; contacts push such a body out.
            if hit.time_of_impact <= 0.0
                || hit.normal.dot(ray.dir) >= 0.0
                || !meets(physics, body, wall)
            {
                continue;
            }
            let room = inner_radius(physics, body).min(hit.time_of_impact);
            moves.push((
                handle,
                old + ray.dir * hit.time_of_impact + hit.normal * room,
                hit.normal,
            ));
        }
    }
    for (handle, centre, normal) in moves {
        let Some(body) = physics.bodies.get_mut(handle) else {
            continue;
        };
        let shift = centre - body.center_of_mass();
        body.set_translation(body.translation() + shift, true);
        let inward = body.linvel().dot(normal).min(0.0);
        body.set_linvel(body.linvel() - normal * inward, true);
    }
}

/// True when the body collides with the wall at all, and its centre of mass lies inside it.
fn meets(
    physics: &PhysicsWorld,
    body: &RigidBody,
    wall: rapier3d::geometry::ColliderHandle,
) -> bool {
    let Some(wall) = physics.colliders.get(wall) else {
        return false;
    };
    let colliders = body
        .colliders()
        .iter()
        .filter_map(|&c| physics.colliders.get(c));
    let mut colliders = colliders.filter(|c| {
        !c.is_sensor()
            && c.collision_groups().test(wall.collision_groups())
            && c.solver_groups().test(wall.solver_groups())
    });
    colliders.any(|c| {
        c.shape()
            .contains_point(c.position(), body.center_of_mass())
    })
}

fn inner_radius(physics: &PhysicsWorld, body: &RigidBody) -> f32 {
    let colliders = body
        .colliders()
        .iter()
        .filter_map(|&c| physics.colliders.get(c));
    0.5 * colliders
        .map(|c| c.shape().ccd_thickness())
        .fold(f32::INFINITY, f32::min)
        .min(1.0)
}
