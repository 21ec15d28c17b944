//! Conversion of Rapier's contacts to those of an impact.
//!
//! Theory §2: point and direction in the body frame, the impulse on this body, the approach speed from the
//! velocities **before** the step (Rapier keeps only those after it), and the striker's modulus, effective
//! mass, curvature, restitution, and, when it is breakable too, its vibration under the contact. The contacts of a partner that touches at several
//! points say that they share its mass, so that the energy of approach is counted once. If a blow is integrated, the impulse is an
//! outcome; the engine's then says only which share of it is friction.

use std::collections::BTreeMap;

use frangible::internals::contact::first_touch_of_ball;
use frangible::{Body, Contact};
use rapier3d::dynamics::{FrictionModel, RigidBody, RigidBodyHandle};
use rapier3d::geometry::ColliderHandle;
use rapier3d::math::Vector;
use rapier3d::pipeline::PhysicsWorld;

use crate::calm::motions::Before;
use crate::config::WorldConfig;
use crate::contact::friction::{rub, solver_friction, unexplained};
use crate::contact::partner::{answer, inverse_effective_mass, share_mass, striker};
use crate::contact::surface::SurfaceProperties;
use crate::world::{Key, key};

/// The contacts of one body that are impacts, and what caused them.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Impact {
    pub(crate) contacts: Vec<Contact>,
    /// The other body of each contact; none for a collider without one. Empty of what no engine's contact caused.
    pub(crate) partners: Vec<Option<RigidBodyHandle>>,
    pub(crate) strikers: Vec<RigidBodyHandle>,
}

/// Surfaces of bodies, and the breakable ones.
pub(crate) struct Surfaces<'a> {
    pub(crate) bodies: &'a BTreeMap<Key, SurfaceProperties>,
    pub(crate) breakables: &'a BTreeMap<Key, Body>,
}

/// A contact point in the body frame.
pub(crate) struct Point {
    pub(crate) position: Vector,
    /// Direction of the impulse on the body.
    pub(crate) normal: Vector,
    pub(crate) impulse: f32,
    /// Friction impulse on the body, as the solver left it.
    pub(crate) friction: Vector,
    /// Distance to the other body at the start of the step, m; negative where they overlap.
    pub(crate) gap: f32,
    friction_coefficient: f32,
    pub(super) restitution: f32,
    pub(super) other_collider: ColliderHandle,
    pub(crate) other: Option<RigidBodyHandle>,
}

/// Impacts on `handle` in the step just taken; `before` holds the bodies as they were before it.
pub(crate) fn impact_on(
    handle: RigidBodyHandle,
    physics: &PhysicsWorld,
    before: &impl Before,
    surfaces: &Surfaces<'_>,
    config: &WorldConfig,
) -> Impact {
    let Some(body) = before.body(handle) else {
        return Impact::default();
    };
    let mut impact = Impact::default();
    let known = physics.integration_parameters.friction_model == FrictionModel::Coulomb;
    let mut groups = merged_by_partner(points_on(handle, body, physics), config.merge_distance);
    for group in &mut groups {
        let partner = group[0].other.and_then(|other| before.body(other));
        keep_first_touches(group, body, partner, config.merge_distance);
        // A partner of several colliders may touch with each of them.
        let collider = group[0].other_collider;
        let one = group.iter().all(|point| point.other_collider == collider);
        let ball = physics.colliders.get(collider).filter(|_| one);
        if let (Some(other), Some(partner), Some(itself)) =
            (ball, partner, surfaces.breakables.get(&key(handle)))
            && let Some(ball) = other.shape().as_ball()
        {
            let dt = physics.integration_parameters.dt;
            let place = other.position_wrt_parent().copied().unwrap_or_default();
            let centre = *partner.position() * place.translation;
            touch_of_ball(group, (body, itself), partner, (centre, ball.radius), dt);
        }
    }
    let rubbed = match (&groups[..], physics.bodies.get(handle)) {
        ([only], Some(after)) if !known => {
            let dt = physics.integration_parameters.dt;
            unexplained(body, after, physics.gravity, dt, only)
        }
        _ => None,
    };
    for (number, group) in groups.into_iter().enumerate() {
        let other = group[0].other;
        let partner = other.and_then(|other| before.body(other));
        let first = impact.contacts.len();
        for point in &group {
            let approach_speed = approach(body, partner, point.position, point.normal);
            if approach_speed > config.impact_speed && point.impulse > 0.0 {
                let mut contact = Contact {
                    impulse: point.impulse,
                    ..Contact::strike(
                        point.position,
                        point.normal,
                        approach_speed,
                        striker(body, partner, point, physics, surfaces),
                    )
                };
                if known {
                    // Restitution comes after friction, in the engine; the blow's friction follows its normal force.
                    let most = point.friction_coefficient * point.impulse;
                    contact.friction = point.friction.clamp_length_max(most);
                }
                impact.contacts.push(contact);
                impact.partners.push(other);
            }
        }
        let added = &mut impact.contacts[first..];
        let share = limit_impulse(added, body, partner);
        if !known {
            let rubbed = rubbed.map(|impulse| impulse * share);
            let coefficient = group[0].friction_coefficient;
            rub(added, body, partner, coefficient, rubbed);
        }
        if let Some(partner) = partner {
            let vibrates = other.is_some_and(|o| surfaces.breakables.contains_key(&key(o)));
            share_mass(added, body, partner, number, vibrates);
        }
        if let (false, Some(other)) = (added.is_empty(), other)
            && !impact.strikers.contains(&other)
        {
            impact.strikers.push(other);
        }
    }
    if let Some(itself) = surfaces.breakables.get(&key(handle)) {
        answer(
            &mut impact,
            (body, itself),
            before,
            surfaces,
            &config.fracture,
        );
    }
    impact
}

/// Contact points at which a body was pushed in the step just taken, or would have been had no other point come before; `body` says where
/// its frame was.
pub(crate) fn points_on(
    handle: RigidBodyHandle,
    body: &RigidBody,
    physics: &PhysicsWorld,
) -> Vec<Point> {
    let mut points = Vec::new();
    let to_body = body.rotation().inverse();
    for &collider_handle in body.colliders() {
        let Some(collider) = physics.colliders.get(collider_handle) else {
            continue;
        };
        let in_body = collider.position_wrt_parent().copied().unwrap_or_default();
        for pair in physics.narrow_phase.contact_pairs_with(collider_handle) {
            let first = pair.collider1 == collider_handle;
            let other_collider = if first {
                pair.collider2
            } else {
                pair.collider1
            };
            let other = physics
                .colliders
                .get(other_collider)
                .and_then(|c| c.parent());
            if other == Some(handle) {
                continue;
            }
            for manifold in pair.solver_manifolds() {
                // The manifold's normal points from the first collider to the second: the second is pushed along it.
                let normal = if first {
                    -manifold.data.normal
                } else {
                    manifold.data.normal
                };
                let Some(normal) = (to_body * normal).try_normalize() else {
                    continue;
                };
                let part = if first {
                    manifold.subshape_pos1()
                } else {
                    manifold.subshape_pos2()
                };
                for point in &manifold.points {
                    let local = if first {
                        point.local_p1
                    } else {
                        point.local_p2
                    };
                    let local = part.map_or(local, |pose| *pose * local);
                    let friction =
                        solver_friction(manifold, point, &physics.integration_parameters);
                    points.push(Point {
                        position: in_body * local,
                        normal,
                        impulse: point.data.impulse,
                        friction: to_body * if first { friction } else { -friction },
                        gap: point.dist,
                        friction_coefficient: manifold.data.friction,
                        restitution: manifold.data.restitution,
                        other_collider,
                        other,
                    });
                }
            }
        }
    }
    points
}

/// Points of one partner in a group; within it, points that are one place are one contact at the
/// impulse-weighted mean: neighbouring cells of a compound both report a ball on their common face, and two
/// half-size contacts would be taken for two softer blows.
pub(crate) fn merged_by_partner(points: Vec<Point>, distance: f32) -> Vec<Vec<Point>> {
    let mut groups: Vec<Vec<Point>> = Vec::new();
    for point in points {
        let same_partner = |p: &Point| match point.other {
            Some(other) => p.other == Some(other),
            None => p.other_collider == point.other_collider,
        };
        let Some(group) = groups.iter_mut().find(|group| same_partner(&group[0])) else {
            groups.push(vec![point]);
            continue;
        };
        let same_place = |p: &&mut Point| {
            p.position.distance(point.position) <= distance && p.normal.dot(point.normal) > 0.9
        };
        if let Some(kept) = group.iter_mut().find(same_place) {
            let total = kept.impulse + point.impulse;
            let share = if total > 0.0 {
                point.impulse / total
            } else {
                0.5
            };
            kept.gap = kept.gap.min(point.gap);
            kept.position = kept.position.lerp(point.position, share);
            kept.normal = kept
                .normal
                .lerp(point.normal, share)
                .normalize_or(point.normal);
            kept.impulse = total;
            kept.friction += point.friction;
        } else {
            group.push(point);
        }
    }
    groups
}

/// Leaves of one partner's points those that touch first, and gives them what the engine did at the others.
///
/// The engine speaks of all points that may come near in a step, on every convex part of a body. Where a ball flies at a flat wall of
/// several parts, the nearest places of the parts around are such points, with tilted normals, though the ball never touches there. A
/// point is one of the blow if at the moment of the first touch it is no farther than `apart`, m.
fn keep_first_touches(
    points: &mut Vec<Point>,
    body: &RigidBody,
    partner: Option<&RigidBody>,
    apart: f32,
) {
    let speed = |p: &Point| approach(body, partner, p.position, p.normal);
    let first = points.iter().filter_map(|p| {
        let speed = speed(p);
        (speed > 0.0).then(|| p.gap.max(0.0) / speed)
    });
    let first = first.fold(f32::INFINITY, f32::min);
    if points.len() < 2 || !first.is_finite() {
        return;
    }
    let late = |p: &Point| p.gap.max(0.0) - speed(p) * first > apart;
    let (others, kept): (Vec<Point>, Vec<Point>) = points.drain(..).partition(late);
    *points = kept;
    for other in others {
        let distance = |p: &Point| p.position.distance_squared(other.position);
        let nearest = (points.iter_mut()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        if let Some(nearest) = nearest {
            let push = other.normal * other.impulse + other.friction;
            let along = push.dot(nearest.normal).max(0.0);
            nearest.impulse += along;
            nearest.friction += push - nearest.normal * along;
        }
    }
}

/// A ball touches the body's own surface, at one point: that takes the place of the engine's points, with all that the engine did there.
fn touch_of_ball(
    points: &mut Vec<Point>,
    (body, itself): (&RigidBody, &Body),
    partner: &RigidBody,
    (centre, radius): (Vector, f32),
    dt: f32,
) {
    let to_body = body.rotation().inverse();
    let against = partner.velocity_at_point(centre) - body.velocity_at_point(centre);
    let from = body.position().inverse_transform_point(centre);
    let touch = first_touch_of_ball(itself, from, to_body * against, radius, dt);
    let Some((position, normal)) = touch else {
        return;
    };
    let push: Vector = points
        .iter()
        .map(|p| p.normal * p.impulse + p.friction)
        .sum();
    points.truncate(1);
    if let Some(point) = points.first_mut() {
        (point.position, point.normal, point.gap) = (position, normal, 0.0);
        point.impulse = push.dot(normal).max(0.0);
        point.friction = push - normal * point.impulse;
    }
}

/// Speed at which the partner comes nearer along the direction of the impulse, before the step.
pub(crate) fn approach(
    body: &RigidBody,
    partner: Option<&RigidBody>,
    point: Vector,
    normal: Vector,
) -> f32 {
    let world = *body.position() * point;
    let other = partner.map_or(Vector::ZERO, |p| p.velocity_at_point(world));
    (other - body.velocity_at_point(world)).dot(*body.rotation() * normal)
}

/// Impulse-weighted centre and direction of contacts, and the sum of their normal impulses.
pub(crate) fn weighted_mean(contacts: &[Contact]) -> Option<(Vector, Vector, f32)> {
    let total: f32 = contacts.iter().map(|c| c.impulse).sum();
    if total.is_nan() || total <= 0.0 {
        return None;
    }
    let mean = |f: &dyn Fn(&Contact) -> Vector| {
        contacts
            .iter()
            .map(|c| f(c) * (c.impulse / total))
            .sum::<Vector>()
    };
    Some((
        mean(&|c| c.point),
        mean(&|c| c.normal).try_normalize()?,
        total,
    ))
}

/// Scales the impulses of one pair so that their sum is no more than the two bodies' meeting can give,
/// (1+e) v_n / (nᵀ K n of both): Rapier adds what pushes an overlap apart and what gravity presses, which is no blow. Returns
/// the share that is left.
fn limit_impulse(contacts: &mut [Contact], body: &RigidBody, partner: Option<&RigidBody>) -> f32 {
    let Some((point, normal, total)) = weighted_mean(contacts) else {
        return 1.0;
    };
    let restitution = contacts
        .iter()
        .map(|c| c.striker.restitution)
        .fold(0.0, f32::max);
    let (world, direction) = (*body.position() * point, *body.rotation() * normal);
    let k = inverse_effective_mass(body, world, direction)
        + partner.map_or(0.0, |p| inverse_effective_mass(p, world, direction));
    let limit = (1.0 + restitution) * approach(body, partner, point, normal).max(0.0) / k;
    if !(limit.is_finite() && limit > 0.0 && limit < total) {
        return 1.0;
    }
    for contact in contacts {
        contact.impulse *= limit / total;
        contact.friction *= limit / total;
    }
    limit / total
}
