//! Collision hooks, which Avian calls for each pair of colliders that touches.

use avian3d::prelude::*;
use bevy::ecs::system::{ReadOnlySystemParam, StaticSystemParam, SystemParam};
use bevy::prelude::*;
use frangible::internals::contact::{SharedMass, first_touch_of_ball};
use frangible::internals::{DurationModel, is_harmless};
use frangible::{Body, Contact, FractureConfig, Outcome, Striker, impact};

use super::touches::{FirstTouch, first_touches};
use super::{Breaking, ImpactSpeed, MadeOf, Moving, Passages, Ruling, Verdict, Verdicts};
use crate::meshes::{into, out};
use crate::{Born, BreakableBody, Fracturing, FragmentOf};

/// Rate at which an overlap of siblings is shown to the solver, m/s.
const OVERLAP_RELAXATION: f32 = 2e-3;

/// Steps after their birth in which siblings do not bounce off each other.
const NEWBORN_STEPS: f32 = 2.5;

/// Collision hooks that break bodies: `PhysicsPlugins::default().with_collision_hooks::<FrangibleHooks>()`. A game with its own hooks wraps them,
/// `FrangibleHooks<MyHooks>`; they are called first, for colliders with active hooks.
#[derive(SystemParam)]
pub struct FrangibleHooks<'w, 's, Inner: SystemParam + 'static = ()> {
    inner: StaticSystemParam<'w, 's, Inner>,
    bodies: Query<'w, 's, (&'static BreakableBody, Moving)>,
    others: Query<'w, 's, (&'static RigidBody, Moving)>,
    made_of: Query<'w, 's, &'static MadeOf>,
    pieces: Query<'w, 's, (&'static FragmentOf, &'static Born)>,
    colliders: Query<'w, 's, &'static Collider>,
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
        for flipped in [false, true] {
            left_out |= self.ask(contacts, flipped);
        }
        if !left_out {
            self.relax_siblings(contacts);
        }
        !left_out
    }
}

impl<Inner: SystemParam + 'static> FrangibleHooks<'_, '_, Inner> {
    /// Fragments of one parent overlap a little at birth, by the depth of their jags; the solver would push them apart at metres per
    /// second. Shown next to nothing of the overlap, they cannot come nearer and creep apart. And a blow that reaches a newborn piece
    /// through many siblings at once must not bounce off each of them.
    fn relax_siblings(&self, pair: &mut ContactPair) {
        let piece = |body: Option<Entity>| self.pieces.get(body?).ok();
        let (Some((a, born)), Some((b, _))) = (piece(pair.body1), piece(pair.body2)) else {
            return;
        };
        if a.0 != b.0 {
            return;
        }
        let age = self.fixed.elapsed().saturating_sub(born.0).as_secs_f32();
        let newborn = age < NEWBORN_STEPS * self.fixed.timestep().as_secs_f32();
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
        let ball = ball.and_then(|c| c.shape().as_ball().map(|ball| ball.radius));
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
        let there = other.and_then(|e| self.others.get(e).ok());
        let began = there.map_or(Vec3::ZERO, |(_, moving)| moving.0.0);
        let config = &self.config.0;
        let inside = *self.breaking == Breaking::InsideStep;
        let met = other.and_then(|e| self.bodies.get(e).ok());
        // Where bodies break inside the step, the impact itself decides, unless the other body's vibration has to be found first.
        let asked = !inside || met.is_some();
        let harmless = asked && is_harmless(&body.0, &contacts, config);
        if let Some((other, there)) = met
            && !harmless
        {
            let to_other = there.1.0.inverse();
            for (contact, touch) in contacts.iter_mut().zip(&touches) {
                vibrate(contact, touch, &other.0, to_other, config);
            }
        }
        let (ruling, left_out) = if inside || harmless {
            let outcome = impact(&body.0, &contacts, config);
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
            touched: (wait / dt).clamp(0.0, 1.0),
            began: [moving.0.0, began],
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
