//! Rolling resistance: without it a ball on a hard plane rolls for ever.
//!
//! The two surfaces of a rolling contact are pressed flat a little ahead of where they leave each other, so the
//! pressure acts a distance b ahead of the contact's normal: a torque b·N against the bodies' rotation relative
//! to each other. b is [`crate::WorldConfig::rolling_arm`]. The torque acts on both bodies, so angular momentum
//! stays; it never turns the rotation around, so energy only falls.

use rapier3d::dynamics::{RigidBody, RigidBodyHandle};
use rapier3d::math::Vector;
use rapier3d::pipeline::PhysicsWorld;

/// Slows the relative rotation of all pairs pressed against each other in the step just taken; `arm` in m.
pub(crate) fn resist_rolling(physics: &mut PhysicsWorld, arm: f32) {
    if arm <= 0.0 {
        return;
    }
    let mut pressed = Vec::new();
    for pair in physics.narrow_phase.contact_pairs() {
        let parent = |c| physics.colliders.get(c).and_then(|c| c.parent());
        let awake = |c| {
            let body = parent(c).and_then(|h| physics.bodies.get(h));
            body.is_some_and(|b| b.is_dynamic() && !b.is_sleeping())
        };
        if !awake(pair.collider1) && !awake(pair.collider2) {
            continue;
        }
        let points = pair.solver_manifolds().iter().flat_map(|m| &m.points);
        let impulse: f32 = points.map(|p| p.data.impulse.max(0.0)).sum();
        if impulse > 0.0 {
            pressed.push((
                parent(pair.collider1),
                parent(pair.collider2),
                arm * impulse,
            ));
        }
    }
    for (a, b, most) in pressed {
        resist(physics, a, b, most);
    }
}

/// Takes up to the angular impulse `most`, N·m·s, from the rotation of a relative to b.
fn resist(
    physics: &mut PhysicsWorld,
    a: Option<RigidBodyHandle>,
    b: Option<RigidBodyHandle>,
    most: f32,
) {
    let body = |handle: Option<RigidBodyHandle>| handle.and_then(|h| physics.bodies.get(h));
    let (first, second) = (body(a), body(b));
    let awake = |body: &RigidBody| body.is_dynamic() && !body.is_sleeping();
    if !first.is_some_and(awake) && !second.is_some_and(awake) {
        return;
    }
    let spin = |body: Option<&RigidBody>| body.map_or(Vector::ZERO, RigidBody::angvel);
    let yields = |body: Option<&RigidBody>, torque: Vector| {
        body.filter(|b| awake(b)).map_or(Vector::ZERO, |b| {
            b.mass_properties().effective_world_inv_inertia * torque
        })
    };
    let relative = spin(first) - spin(second);
    let Some(axis) = relative.try_normalize() else {
        return;
    };
    let (turn_a, turn_b) = (yields(first, axis), yields(second, axis));
    let ease = axis.dot(turn_a + turn_b);
    if ease.is_nan() || ease <= 0.0 {
        return;
    }
    let taken = most.min(relative.length() / ease);
    for (handle, turn) in [(a, -turn_a * taken), (b, turn_b * taken)] {
        let Some(body) = handle
            .and_then(|h| physics.bodies.get_mut(h))
            .filter(|b| awake(b))
        else {
            continue;
        };
        body.set_angvel(body.angvel() + turn, false);
    }
}
