//! Collision hooks, which Avian calls for each pair of colliders that touches.

use std::time::Duration;

use avian3d::prelude::*;
use bevy::ecs::system::{ReadOnlySystemParam, StaticSystemParam, SystemParam};
use bevy::prelude::*;
use frangible::internals::contact::{SharedMass, first_touch_of_ball};
use frangible::internals::{DurationModel, is_harmless};
use frangible::{Body, Contact, FractureConfig, Outcome, Striker, impact};

use super::floor::{Placed, stand};
use super::touches::{FirstTouch, first_touches};
use super::{Breaking, ImpactSpeed, MadeOf, Moving, Passages, Ruling, Verdict, Verdicts};
use crate::meshes::{into, out};
use crate::{Born, BreakableBody, Fracturing, FragmentOf};

/// Rate at which an overlap of siblings is shown to the solver, m/s.
const OVERLAP_RELAXATION: f32 = 2e-3;

/// Steps after their birth in which siblings do not bounce off each other.
const NEWBORN_STEPS: f32 = 2.5;

/// Contacts with a smaller gap than this stay, m: Avian's own tolerance.
const NEAR: f32 = 5e-3;

/// Collision hooks that break bodies: `PhysicsPlugins::default().with_collision_hooks::<FrangibleHooks>()`. A game with its own hooks wraps them,
/// `FrangibleHooks<MyHooks>`; they are called first, for colliders with active hooks.
#[derive(SystemParam)]
pub struct FrangibleHooks<'w, 's, Inner: SystemParam + 'static = ()> {
    inner: StaticSystemParam<'w, 's, Inner>,
    bodies: Query<'w, 's, (&'static BreakableBody, Moving)>,
    others: Query<'w, 's, (&'static RigidBody, Moving)>,
    made_of: Query<'w, 's, &'static MadeOf>,
    pieces: Query<'w, 's, (&'static FragmentOf, &'static Born)>,
    colliders: Query<'w, 's, (&'static Collider, &'static Position, &'static Rotation)>,
    verdicts: Res<'w, Verdicts>,
    passages: Res<'w, Passages>,
    config: Res<'w, Fracturing>,
    breaking: Res<'w, Breaking>,
    impact_speed: Res<'w, ImpactSpeed>,
    time: Res<'w, Time>,
    fixed: Res<'w, Time<Fixed>>,
}

impl<Inner> CollisionHooks for FrangibleHooks<'_, '_, Inner>
where
    Inner: ReadOnlySystemParam + 'static,
    for<'w, 's> Inner::Item<'w, 's>: CollisionHooks,
{
    fn filter_pairs(&self, first: Entity, second: Entity, commands: &mut Commands) -> bool {
        self.inner.filter_pairs(first, second, commands)
    }

    fn modify_contacts(&self, contacts: &mut ContactPair, commands: &mut Commands) -> bool {
        if !self.inner.modify_contacts(contacts, commands) {
            return false;
        }
        if self.flies_through(contacts) {
            return false;
        }
        let mut left_out = false;
        if !self.newborn_siblings(contacts) {
            for flipped in [false, true] {
                left_out |= self.ask(contacts, flipped);
            }
        }
        if left_out {
            return false;
        }
        drop_ghosts(contacts, self.time.delta_secs());
        self.stand(contacts);
        self.relax_siblings(contacts);
        !contacts.manifolds.is_empty()
    }
}

impl<Inner: SystemParam + 'static> FrangibleHooks<'_, '_, Inner> {
    /// Sets a body on the corners that are its lowest, if the other one is a flat floor.
    fn stand(&self, pair: &mut ContactPair) {
        let placed = |collider: Entity| {
            let (collider, at, turn) = self.colliders.get(collider).ok()?;
            Some(Placed {
                collider,
                at: at.0,
                turn: turn.0,
            })
        };
        let (Some(first), Some(second)) = (placed(pair.collider1), placed(pair.collider2)) else {
            return;
        };
        let motion = |body: Option<Entity>| {
            let moving = body.and_then(|body| self.others.get(body).ok());
            moving.map_or((Vec3::ZERO, Vec3::ZERO), |(_, m)| (m.2.0, m.3.0))
        };
        let ((v, spin), (w, other_spin)) = (motion(pair.body1), motion(pair.body2));
        let relative =
            |p: &ContactPoint| w - v + other_spin.cross(p.anchor2) - spin.cross(p.anchor1);
        let dt = self.time.delta_secs();
        stand(pair, [first, second], relative, (dt, NEAR));
    }

    /// Returns true if the two are fragments of one parent that were born just now: the blow that parts them is still on its way.
    fn newborn_siblings(&self, pair: &ContactPair) -> bool {
        self.siblings(pair).is_some_and(|born| {
            let age = self.fixed.elapsed().saturating_sub(born).as_secs_f32();
            age < NEWBORN_STEPS * self.fixed.timestep().as_secs_f32()
        })
    }

    /// Birth of two fragments of one parent.
    fn siblings(&self, pair: &ContactPair) -> Option<Duration> {
        let (a, born) = self.pieces.get(pair.body1?).ok()?;
        let (b, _) = self.pieces.get(pair.body2?).ok()?;
        (a.0 == b.0).then_some(born.0)
    }

    /// Fragments of one parent overlap a little at birth, by the depth of their jags; the solver would push them apart at metres per
    /// second. Shown next to nothing of the overlap, they cannot come nearer and creep apart. And a blow that reaches a newborn piece
    /// through many siblings at once must not bounce off each of them.
    fn relax_siblings(&self, pair: &mut ContactPair) {
        if self.siblings(pair).is_none() {
            return;
        }
        let newborn = self.newborn_siblings(pair);
        let shown = OVERLAP_RELAXATION * self.time.delta_secs();
        for manifold in &mut pair.manifolds {
            if newborn {
                manifold.restitution = 0.0;
            }
            for point in &mut manifold.points {
                point.penetration = point.penetration.min(shown);
            }
        }
    }

    /// Returns true if one of the two is on its way through the pieces of which the other is one: that is part of the blow, which has acted.
    fn flies_through(&self, pair: &ContactPair) -> bool {
        if self.passages.0.is_empty() {
            return false;
        }
        let began = self.fixed.elapsed().saturating_sub(self.fixed.timestep());
        let through = |striker: Option<Entity>, piece: Option<Entity>| {
            let (Some(striker), Some((of, _))) = (striker, self.pieces.get(piece?).ok()) else {
                return None;
            };
            self.passages.0.get(&(striker, of.0)).copied()
        };
        let (a, b) = (pair.body1, pair.body2);
        let moves = |body: Option<Entity>| {
            body.is_some_and(|e| self.others.get(e).is_ok_and(|(kind, _)| kind.is_dynamic()))
        };
        let mut ends = [through(a, b), through(b, a)].into_iter().flatten();
        ends.any(|until| began < until) && moves(a) && moves(b)
    }

    /// Computes the fracture of the first body of a pair, or of the second one if `flipped`. Returns true if the pair is to be left out of the step,
    /// because the blow on the body was integrated: its impulses act after the step.
    fn ask(&self, pair: &ContactPair, flipped: bool) -> bool {
        let (body, other, collider) = match flipped {
            false => (pair.body1, pair.body2, pair.collider2),
            true => (pair.body2, pair.body1, pair.collider1),
        };
        let Some((entity, (body, moving))) = body.and_then(|e| Some((e, self.bodies.get(e).ok()?)))
        else {
            return false;
        };
        let to_body = moving.1.0.inverse();
        let ball = self.colliders.get(collider).ok();
        let ball = ball.and_then(|(c, ..)| c.shape().as_ball().map(|ball| ball.radius));
        let striker = self.striker(other, collider, ball);
        let dt = self.time.delta_secs();
        let mut touches = first_touches(pair, flipped, dt, self.impact_speed.0);
        let times = touches.iter().map(|t| t.gap / t.approach);
        let mut wait = times.fold(f32::INFINITY, f32::min);
        if let (Some(radius), Some((_, other))) =
            (ball, other.and_then(|e| self.others.get(e).ok()))
            && !touches.is_empty()
        {
            let at = moving.0.0;
            let centre = other.0.0 + other.1.0 * other.6.0;
            let carried = moving.2.0 + moving.3.0.cross(centre - at);
            let against = to_body * (other.2.0 - carried);
            let from = to_body * (centre - at);
            let touch = first_touch_of_ball(&body.0, into(from), into(against), radius, dt);
            if let Some((place, normal)) = touch {
                // The ball touches the body's own surface, at one point.
                let flown = place - radius * normal - into(from);
                wait = flown.length() / against.length();
                let (place, normal) = (
                    to_body.inverse() * out(place),
                    to_body.inverse() * out(normal),
                );
                let approach = (to_body.inverse() * against).dot(normal);
                touches = vec![FirstTouch {
                    anchors: [place, -radius * normal],
                    normal,
                    approach,
                    gap: 0.0,
                }];
                touches.retain(|t| t.approach > self.impact_speed.0);
            }
        }
        let mut contacts: Vec<Contact> = touches
            .iter()
            .map(|touch| {
                let shared = self.shared(other, touch.anchors[1], touch.normal);
                let mut striker = striker.clone();
                striker.inverse_effective_mass = shared.map_or(0.0, |s| {
                    s.velocity.length_squared() + s.spin.length_squared()
                });
                striker.shared = shared;
                let at = into(to_body * touch.anchors[0]);
                let toward = into(to_body * touch.normal);
                Contact::strike(at, toward, touch.approach, striker)
            })
            .collect();
        if contacts.is_empty() {
            return false;
        }
        let wait = wait.clamp(0.0, dt);
        let there = other.and_then(|e| self.others.get(e).ok());
        let there = there.map_or(Vec3::ZERO, |(_, other)| other.0.0 + other.2.0 * wait);
        let config = &self.config.0;
        let inside = *self.breaking == Breaking::InsideStep;
        let met = other.and_then(|e| self.bodies.get(e).ok());
        // Where bodies break inside the step, the impact itself decides, unless the other body's vibration has to be found first.
        let asked = !inside || met.is_some();
        let harmless = asked && is_harmless(&body.0, &contacts, config);
        if let Some((other, motion)) = met
            && !harmless
        {
            let to_other = motion.1.0.inverse();
            for (contact, touch) in contacts.iter_mut().zip(&touches) {
                vibrate(contact, touch, &other.0, to_other, config);
            }
        }
        let (ruling, left_out) = if inside || harmless {
            let outcome = impact(&body.0, &contacts, config);
            if outcome.as_ref().is_ok_and(|outcome| !is_sound(outcome)) {
                warn!(
                    "a blow on {entity} cannot be integrated: Avian's contact acts, and the body stays as it is"
                );
                return false;
            }
            let left_out = match &outcome {
                Ok(Outcome::Broke(_)) => true,
                // A bound that refuses a blow knows no impulse: the solver's counts.
                Ok(Outcome::Held { report, .. }) => {
                    let integrated = config.duration == DurationModel::Integrated;
                    integrated && report.contacts.len() == contacts.len()
                }
                _ => false,
            };
            (Ruling::Now(outcome.into()), left_out)
        } else {
            (Ruling::Waits, false)
        };
        let verdict = Verdict {
            body: entity,
            striker: other,
            contacts,
            touched: wait,
            places: [moving.0.0 + moving.2.0 * wait, there],
            left_out,
            ruling,
        };
        let mut verdicts = self.verdicts.0.lock();
        let verdicts = verdicts.as_mut();
        verdicts.map_or_else(|_| (), |list| list.push(verdict));
        left_out
    }

    /// Striker of a collider, without its mass.
    fn striker(&self, other: Option<Entity>, collider: Entity, ball: Option<f32>) -> Striker {
        let made_of = |entity: Entity| self.made_of.get(entity).ok();
        let material = made_of(collider).or_else(|| made_of(other?));
        let mut striker = material.map_or_else(Striker::rigid, |made| Striker::fixed(&made.0));
        let is_body = |e: Entity| self.bodies.contains(e) || self.pieces.contains(e);
        // A body with edges strikes with one of them.
        let edge = other.is_some_and(is_body).then_some(Striker::EDGE_RADIUS);
        if let Some(radius) = ball.or(edge) {
            striker.curvature_radius = radius;
        }
        striker
    }

    /// Mass with which a striker resists at a contact. None for a striker that is not dynamic.
    fn shared(&self, other: Option<Entity>, arm: Vec3, normal: Vec3) -> Option<SharedMass> {
        let (kind, moving) = self.others.get(other?).ok()?;
        if !kind.is_dynamic() {
            return None;
        }
        let turn = into(arm.cross(normal));
        let inverse = moving.5.rotated(moving.1.0).inverse().to_mat3();
        let columns = [inverse.x_axis, inverse.y_axis, inverse.z_axis].map(into);
        let velocity = into(normal) * moving.4.inverse().sqrt();
        Some(SharedMass::of(0, velocity, columns, turn))
    }
}

/// Returns true if the impulses of an outcome are numbers. Those of a piece of a dozen tetrahedra may not be.
fn is_sound(outcome: &Outcome) -> bool {
    let mut contacts = outcome.report().contacts.iter();
    contacts.all(|contact| contact.impulse.is_finite())
}

/// Drops contacts that are predicted and do not come about in this step. Avian lists all that are nearer than the bodies move in a step, whatever their
/// direction, and lets some of them act: a fast ball bounces off the rim of a hole that it flies through.
fn drop_ghosts(pair: &mut ContactPair, dt: f32) {
    pair.manifolds.retain_mut(|manifold| {
        let comes = |p: &ContactPoint| -p.penetration <= NEAR + (-p.normal_speed).max(0.0) * dt;
        manifold.points.retain(comes);
        !manifold.points.is_empty()
    });
}

/// The other body of a contact is breakable: it vibrates under the blow, as one body at all its contacts.
fn vibrate(
    contact: &mut Contact,
    touch: &FirstTouch,
    other: &Body,
    to_other: Quat,
    config: &FractureConfig,
) {
    let on_it = Contact {
        point: into(to_other * touch.anchors[1]),
        normal: into(to_other * -touch.normal),
        ..contact.clone()
    };
    // An error here is one of the contact itself, which the impact reports.
    if config.duration == DurationModel::Integrated
        && let Ok(flexible) = Striker::flexible(other, &on_it, config)
    {
        contact.striker.curvature_radius = flexible.curvature_radius;
        contact.striker.receptance = flexible.receptance;
        let shared = &mut contact.striker.shared;
        shared.get_or_insert(SharedMass::immovable(0));
    }
}

#[cfg(test)]
mod tests {
    use super::drop_ghosts;
    use avian3d::collision::contact_types::ContactId;
    use avian3d::prelude::*;
    use bevy::prelude::*;

    #[test]
    fn contacts_that_do_not_come_about_are_dropped() {
        let point = |gap: f32, approach: f32| {
            let mut point = ContactPoint::new(Vec3::ZERO, Vec3::ZERO, Vec3::ZERO, -gap);
            point.normal_speed = -approach;
            point
        };
        let kept = |points: Vec<ContactPoint>| {
            let ends = [Entity::from_raw_u32(1), Entity::from_raw_u32(2)].map(Option::unwrap);
            let mut pair = ContactPair::new(ends[0], ends[1], ContactId(0));
            pair.manifolds = vec![ContactManifold::new(points, Vec3::Y)];
            drop_ghosts(&mut pair, 0.01);
            pair.manifolds.iter().map(|m| m.points.len()).sum::<usize>()
        };
        // The rim of a hole, 9 cm away from a ball that flies past it, and a wall in its way.
        assert_eq!(kept(vec![point(0.09, 5.0), point(0.09, 10.0)]), 1);
        assert_eq!(kept(vec![point(0.09, 5.0)]), 0);
        // What lies, touches and sinks in.
        assert_eq!(
            kept(vec![point(1e-3, 0.0), point(0.0, 0.0), point(-1e-3, -2.0)]),
            3
        );
    }
}
