//! The body on the other side of a contact: its mass and surface as a striker, and its vibration when it can break too.

use frangible::internals::contact::{SharedMass, answer_duration};
use frangible::internals::{DurationModel, is_harmless};
use frangible::{Body, Contact, FractureConfig, Striker};
use rapier3d::dynamics::{RigidBody, RigidBodyHandle};
use rapier3d::math::Vector;
use rapier3d::pipeline::PhysicsWorld;

use crate::calm::motions::Before;
use crate::contact::contacts::{Impact, Point, Surfaces};
use crate::world::key;

pub(super) fn striker(
    body: &RigidBody,
    partner: Option<&RigidBody>,
    point: &Point,
    physics: &PhysicsWorld,
    surfaces: &Surfaces<'_>,
) -> Striker {
    let world = *body.position() * point.position;
    let normal = *body.rotation() * point.normal;
    let surface = point
        .other
        .and_then(|other| surfaces.bodies.get(&key(other)));
    // A body nobody described is a rigid one; a ball's radius can still be read off its shape.
    let ball = physics
        .colliders
        .get(point.other_collider)
        .and_then(|c| c.shape().as_ball())
        .map(|b| b.radius);
    let breakable = point
        .other
        .and_then(|other| surfaces.breakables.get(&key(other)));
    let curvature_radius = match (breakable, partner) {
        (Some(breakable), Some(partner)) => {
            curvature_at(breakable, partner.position().inverse_transform_point(world))
        }
        _ => surface
            .map(|s| s.curvature_radius)
            .or(ball)
            .unwrap_or(f32::INFINITY),
    };
    let mut striker = Striker::rigid();
    if let Some(surface) = surface {
        striker.contact_modulus = surface.contact_modulus;
        striker.crushing_pressure = surface.crushing_pressure;
    }
    if let Some(partner) = partner {
        striker.inverse_effective_mass = inverse_effective_mass(partner, world, normal);
    }
    striker.curvature_radius = curvature_radius;
    striker.restitution = point.restitution.clamp(0.0, 1.0);
    striker
}

/// Radius of curvature of a breakable's outer surface nearest to a point of its body frame, m.
fn curvature_at(body: &Body, point: Vector) -> f32 {
    let triangle = body.nearest_on_surface(point).triangle;
    body.asset().surface().curvature_radius[triangle as usize].max(Striker::EDGE_RADIUS)
}

/// Two breakable bodies meet: how the other one vibrates under each contact, for blows that are integrated, and how long it answers, for
/// the models that ask. Hertz's law has both bodies in it already, and a blow that is refused without them asks for no modes.
pub(super) fn answer(
    impact: &mut Impact,
    (body, itself): (&RigidBody, &Body),
    before: &impl Before,
    surfaces: &Surfaces<'_>,
    config: &FractureConfig,
) {
    let integrated = config.duration == DurationModel::Integrated;
    let both = |handle: RigidBodyHandle| {
        Some((before.body(handle)?, surfaces.breakables.get(&key(handle))?))
    };
    let met = (impact.partners.iter().flatten()).any(|&partner| both(partner).is_some());
    if !met
        || config.duration == DurationModel::Hertz
        || (integrated && is_harmless(itself, &impact.contacts, config))
    {
        return;
    }
    for (contact, partner) in impact.contacts.iter_mut().zip(&impact.partners) {
        let Some((partner, other)) = partner.and_then(both) else {
            continue;
        };
        let into = partner.position().inverse() * *body.position();
        let (world, normal) = (
            *body.position() * contact.point,
            *body.rotation() * contact.normal,
        );
        let mut there = Striker::fixed(itself.asset().material());
        there.inverse_effective_mass = inverse_effective_mass(body, world, normal);
        there.curvature_radius = curvature_at(itself, contact.point);
        there.restitution = contact.striker.restitution;
        let mirrored = Contact {
            point: into * contact.point,
            normal: into.rotation * -contact.normal,
            friction: into.rotation * -contact.friction,
            striker: there,
            ..contact.clone()
        };
        if integrated {
            // An error of this is one of the contact itself, which the impact reports.
            if let Ok(flexible) = Striker::flexible(other, &mirrored, config) {
                contact.striker.curvature_radius = flexible.curvature_radius;
                contact.striker.receptance = flexible.receptance;
            }
        } else {
            let duration = answer_duration(other, &mirrored, config.duration) as f32;
            // Infinite or NaN where a mode cannot be excited: then the body's own duration stands.
            contact.striker.modal_duration = if duration.is_finite() { duration } else { 0.0 };
        }
    }
}

/// A partner that strikes at several points does so with one mass: an impulse at one of them moves it at the others too, and makes it
/// vibrate there if it `vibrates`. `number`: of the partner, among those of this impact.
pub(super) fn share_mass(
    contacts: &mut [Contact],
    body: &RigidBody,
    partner: &RigidBody,
    number: usize,
    vibrates: bool,
) {
    if contacts.len() < 2 || !(partner.is_dynamic() || vibrates) {
        return;
    }
    if !partner.is_dynamic() {
        for contact in contacts {
            contact.striker.shared = Some(SharedMass::immovable(number as u32));
        }
        return;
    }
    let mass = partner.mass_properties();
    let inverse_inertia = Vector::AXES.map(|axis| mass.effective_world_inv_inertia * axis);
    for contact in contacts {
        let point = *body.position() * contact.point;
        let normal = *body.rotation() * contact.normal;
        let turn = (point - mass.world_com).cross(normal);
        let velocity = mass.effective_inv_mass.map(f32::sqrt) * normal;
        let shared = SharedMass::of(number as u32, velocity, inverse_inertia, turn);
        contact.striker.shared = Some(shared);
    }
}

/// nᵀ K n, 1/kg: what one unit of impulse along n changes the speed of the body at the point by.
pub(super) fn inverse_effective_mass(
    body: &RigidBody,
    world_point: Vector,
    world_normal: Vector,
) -> f32 {
    if !body.is_dynamic() {
        return 0.0;
    }
    let mass = body.mass_properties();
    let arm = (world_point - mass.world_com).cross(world_normal);
    let linear = world_normal.dot(mass.effective_inv_mass * world_normal);
    linear + arm.dot(mass.effective_world_inv_inertia * arm)
}
