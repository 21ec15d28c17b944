//! Bodies that break inside Avian's step.
//!
//! Avian asks its collision hooks about each pair of colliders that touches, before it solves the contacts. A breakable body is put to the
//! fracture there, with the speeds before the solver. If it breaks, the pair's contacts are dropped for this step, so that the striker
//! keeps its velocity; after the step the pieces take the body's place, the blow's impulse acts between them and the striker, and the
//! cracks' energy is taken from the motion. No step has to be undone.

use std::sync::{Mutex, PoisonError};

use avian3d::prelude::*;
use bevy::ecs::system::{ReadOnlySystemParam, StaticSystemParam, SystemParam};
use bevy::prelude::*;
use frangible::glam::{DMat3, DVec3};
use frangible::internals::MassProperties;
use frangible::internals::contact::{SharedMass, first_touch_of_ball};
use frangible::{Asset as Baked, Contact, InputError, Material, Outcome, Striker, glam, impact};

use crate::break_apart::conclude;
use crate::meshes::{into, out};
use crate::rigid::{Rigid, push_plug, take_energy};
use crate::{BreakFailed, BreakableBody, Broke, Broken, Fracturing, Pushed};

/// Approach slower than this is no impact, m/s.
const IMPACT_SPEED: f32 = 0.5;

/// Contact points nearer than this are one contact, m, if their normals have a cosine above the second number.
const ONE_PLACE: f32 = 5e-4;
const ONE_DIRECTION: f32 = 0.9;

/// What an entity with a collider is made of, for what it strikes: without it a striker is rigid, and flat unless its collider is a ball.
#[derive(Component, Clone, Debug)]
pub struct MadeOf(pub Material);

/// What happened to bodies in the step that runs.
#[derive(Resource, Default)]
struct Verdicts(Mutex<Vec<Verdict>>);

struct Verdict {
    body: Entity,
    /// None for a collider without a body.
    striker: Option<Entity>,
    contacts: Vec<Contact>,
    outcome: Result<Outcome, InputError>,
}

pub(crate) fn build(app: &mut App) {
    app.init_resource::<Verdicts>()
        .add_observer(give_collider)
        .add_observer(give_fragments)
        .add_observer(push)
        .add_systems(FixedPostUpdate, carry_out.after(PhysicsSystems::Last));
}

/// A body as Avian moves it.
type Moving = (
    &'static Position,
    &'static Rotation,
    &'static LinearVelocity,
    &'static AngularVelocity,
    &'static ComputedMass,
    &'static ComputedAngularInertia,
    &'static ComputedCenterOfMass,
);

/// Collision hooks that break bodies: `PhysicsPlugins::default().with_collision_hooks::<FrangibleHooks>()`. A game with hooks of its own
/// wraps them, `FrangibleHooks<MyHooks>`: its own are asked first, of the colliders that have them switched on.
#[derive(SystemParam)]
pub struct FrangibleHooks<'w, 's, Inner: SystemParam + 'static = ()> {
    inner: StaticSystemParam<'w, 's, Inner>,
    bodies: Query<'w, 's, (&'static BreakableBody, Moving)>,
    others: Query<'w, 's, (&'static RigidBody, Moving)>,
    made_of: Query<'w, 's, &'static MadeOf>,
    colliders: Query<'w, 's, &'static Collider>,
    verdicts: Res<'w, Verdicts>,
    config: Res<'w, Fracturing>,
    time: Res<'w, Time>,
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
        let mut broke = false;
        for flipped in [false, true] {
            broke |= self.ask(contacts, flipped);
        }
        !broke
    }
}

impl<Inner: SystemParam + 'static> FrangibleHooks<'_, '_, Inner> {
    /// Puts the first body of a pair to the fracture, or the second one; whether it breaks.
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
        let striker = self.striker(other, collider, ball, body.0.asset());
        let dt = self.time.delta_secs();
        let mut touches = first_touches(pair, flipped, dt);
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
                touches.retain(|t| t.approach > IMPACT_SPEED);
            }
        }
        let contacts: Vec<Contact> = touches
            .into_iter()
            .map(|touch| {
                let shared = self.shared(other, touch.anchors[1], touch.normal);
                let striker = Striker {
                    inverse_effective_mass: shared.map_or(0.0, |s| {
                        s.velocity.length_squared() + s.spin.length_squared()
                    }),
                    shared,
                    ..striker
                };
                let at = into(to_body * touch.anchors[0]);
                let toward = into(to_body * touch.normal);
                Contact::new(at, toward, 0.0, touch.approach, striker)
            })
            .collect();
        if contacts.is_empty() {
            return false;
        }
        let outcome = impact(&body.0, &contacts, &self.config.0);
        let broke = matches!(outcome, Ok(Outcome::Broke(_)));
        let verdict = Verdict {
            body: entity,
            striker: other,
            contacts,
            outcome,
        };
        let mut verdicts = self.verdicts.0.lock();
        let verdicts = verdicts.as_mut();
        verdicts.map_or_else(|_| (), |list| list.push(verdict));
        broke
    }

    /// What a collider strikes a body with, but for its mass.
    fn striker(
        &self,
        other: Option<Entity>,
        collider: Entity,
        ball: Option<f32>,
        struck: &Baked,
    ) -> Striker {
        let breakable = other.and_then(|other| self.bodies.get(other).ok());
        let own = self.made_of.get(collider).ok();
        let own = own.or_else(|| self.made_of.get(other?).ok());
        let material = match (&breakable, own) {
            (Some((body, _)), _) => Some(&body.0.asset().material),
            (None, Some(made)) => Some(&made.0),
            (None, None) => None,
        };
        let striker = material.map_or_else(Striker::rigid, Striker::fixed);
        Striker {
            // A body with edges strikes with one of them, as sharp as those of the struck body.
            curvature_radius: ball.unwrap_or(match breakable {
                Some(_) => (1e-3 * struck.mass.volume.cbrt() as f32).max(1e-4),
                None => f32::INFINITY,
            }),
            ..striker
        }
    }

    /// How a striker gives way at a contact; none where it does not.
    fn shared(&self, other: Option<Entity>, arm: Vec3, normal: Vec3) -> Option<SharedMass> {
        let (kind, moving) = self.others.get(other?).ok()?;
        if !kind.is_dynamic() {
            return None;
        }
        let turn = into(arm.cross(normal));
        let inverse = moving.5.rotated(moving.1.0).inverse().to_mat3();
        let columns = [inverse.x_axis, inverse.y_axis, inverse.z_axis].map(into);
        let spins = lower_factor(columns);
        Some(SharedMass {
            body: 0,
            velocity: into(normal) * moving.4.inverse().sqrt(),
            spin: glam::Vec3::from_array(spins.map(|column| column.dot(turn))),
        })
    }
}

/// A point at which two bodies are about to touch.
struct FirstTouch {
    /// From the centre of mass of the body that is asked, and of the other one, m, world axes.
    anchors: [Vec3; 2],
    /// Direction of the impulse on the body that is asked.
    normal: Vec3,
    /// Speed of approach, m/s.
    approach: f32,
    /// Distance still to go, m.
    gap: f32,
}

/// Where two bodies touch first in the coming step of `dt` s. Avian speaks of all points that might come near, on every part of a compound
/// collider: those that touch later than the first belong to another time, and those that are one place are one contact.
fn first_touches(pair: &ContactPair, flipped: bool, dt: f32) -> Vec<FirstTouch> {
    let mut touches: Vec<FirstTouch> = Vec::new();
    for manifold in &pair.manifolds {
        let normal = if flipped {
            manifold.normal
        } else {
            -manifold.normal
        };
        let fast = manifold.points.iter().filter(|p| {
            let approach = -p.normal_speed;
            approach > IMPACT_SPEED && approach * dt + p.penetration >= 0.0
        });
        touches.extend(fast.map(|p| FirstTouch {
            anchors: match flipped {
                false => [p.anchor1, p.anchor2],
                true => [p.anchor2, p.anchor1],
            },
            normal,
            approach: -p.normal_speed,
            gap: (-p.penetration).max(0.0),
        }));
    }
    let first = touches.iter().map(|t| t.gap / t.approach);
    let first = first.fold(f32::INFINITY, f32::min);
    touches.retain(|t| t.gap - t.approach * first <= ONE_PLACE);
    let mut merged: Vec<FirstTouch> = Vec::new();
    for touch in touches {
        let same = merged.iter().any(|m| {
            m.anchors[0].distance(touch.anchors[0]) <= ONE_PLACE
                && m.normal.dot(touch.normal) > ONE_DIRECTION
        });
        if !same {
            merged.push(touch);
        }
    }
    merged
}

/// Columns of the lower triangular L with L Lᵀ = the symmetric matrix of these columns; zero where the matrix does not give way.
fn lower_factor(columns: [glam::Vec3; 3]) -> [glam::Vec3; 3] {
    let mut rest = columns;
    std::array::from_fn(|k| {
        let pivot = rest[k][k];
        if pivot <= 0.0 {
            return glam::Vec3::ZERO;
        }
        let column = rest[k] / pivot.sqrt();
        for (l, other) in rest.iter_mut().enumerate() {
            *other -= column * column[l];
        }
        column
    })
}

/// A body as plain numbers.
fn rigid(kind: &RigidBody, moving: <Moving as bevy::ecs::query::QueryData>::Item<'_, '_>) -> Rigid {
    let (position, rotation, linear, angular, mass, inertia, centre) = moving;
    let movable = kind.is_dynamic() && mass.inverse() > 0.0;
    let tensor = inertia.rotated(rotation.0).tensor().to_mat3();
    let columns = [tensor.x_axis, tensor.y_axis, tensor.z_axis].map(|c| double(into(c)));
    Rigid {
        mass: if movable {
            f64::from(mass.value())
        } else {
            f64::INFINITY
        },
        inertia: DMat3::from_cols(columns[0], columns[1], columns[2]),
        centre: double(into(position.0 + rotation.0 * centre.0)),
        linear: double(into(linear.0)),
        angular: double(into(angular.0)),
    }
}

fn double(v: glam::Vec3) -> DVec3 {
    v.as_dvec3()
}

/// A fragment as plain numbers, moving with its body.
fn piece(mass: &MassProperties, supported: bool, body: &Rigid, rotation: Quat, at: Vec3) -> Rigid {
    let turn = DMat3::from_quat(glam::DQuat::from_array(rotation.to_array().map(f64::from)));
    let centre = double(into(at)) + turn * mass.centre;
    let (linear, angular) = if body.gives_way() {
        (
            body.linear + body.angular.cross(centre - body.centre),
            body.angular,
        )
    } else {
        (DVec3::ZERO, DVec3::ZERO)
    };
    Rigid {
        mass: if supported { f64::INFINITY } else { mass.mass },
        inertia: turn * mass.inertia * turn.transpose(),
        centre,
        linear,
        angular,
    }
}

/// After the step: bodies that broke give way to their pieces, those that held keep their cracks.
fn carry_out(
    mut commands: Commands,
    verdicts: Res<Verdicts>,
    mut bodies: Query<&mut BreakableBody>,
    moving: Query<(&RigidBody, Moving)>,
) {
    let mut verdicts: Vec<Verdict> = {
        let mut list = verdicts.0.lock().unwrap_or_else(PoisonError::into_inner);
        std::mem::take(&mut *list)
    };
    // Pairs come in any order; a body's own break counts before those that held.
    let broke = |v: &Verdict| matches!(v.outcome, Ok(Outcome::Broke(_)));
    verdicts.sort_by_key(|v| (v.body, !broke(v), v.striker));
    let mut last = None;
    for Verdict {
        body: entity,
        striker,
        contacts,
        outcome,
    } in verdicts
    {
        if last.replace(entity) == Some(entity) {
            continue;
        }
        let (Ok(mut body), Ok((kind, now))) = (bodies.get_mut(entity), moving.get(entity)) else {
            continue;
        };
        let (at, rotation) = (now.0.0, now.1.0);
        let pose = Transform::from_translation(at).with_rotation(rotation);
        let whole = rigid(kind, now);
        let Some((fracture, fragments)) = conclude(&mut commands, entity, &mut body, pose, outcome)
        else {
            continue;
        };
        let mut pieces: Vec<(usize, Rigid)> = (fracture.fragments.iter())
            .map(|f| {
                let supported = f.supported && !whole.gives_way();
                piece(&f.mass, supported, &whole, rotation, at)
            })
            .enumerate()
            .collect();
        // From the nearest to the contacts.
        let distance = |i: usize| -> f32 {
            let fragment = &fracture.fragments[i];
            let centre = fragment.mass.centre.as_vec3();
            let corners = fragment.mesh.positions.iter();
            let gaps = corners.flat_map(|p| {
                contacts
                    .iter()
                    .map(move |c| (*p + centre).distance_squared(c.point))
            });
            gaps.fold(f32::INFINITY, f32::min)
        };
        let mut keyed: Vec<(f32, (usize, Rigid))> =
            pieces.drain(..).map(|p| (distance(p.0), p)).collect();
        keyed.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.0.cmp(&b.1.0)));
        let (order, mut rigids): (Vec<usize>, Vec<Rigid>) =
            keyed.into_iter().map(|(_, piece)| piece).unzip();
        let striker = striker.and_then(|s| Some((s, moving.get(s).ok()?)));
        let mut other = striker.map_or(
            Rigid {
                mass: f64::INFINITY,
                inertia: DMat3::IDENTITY,
                centre: DVec3::ZERO,
                linear: DVec3::ZERO,
                angular: DVec3::ZERO,
            },
            |(_, (kind, moving))| rigid(kind, moving),
        );
        let world = |v: glam::Vec3| double(into(rotation * out(v)));
        let reports = &fracture.report.contacts;
        let pushes: Vec<(DVec3, DVec3)> = reports
            .iter()
            .map(|c| {
                (
                    double(into(at)) + world(c.point),
                    world(c.normal) * c.impulse,
                )
            })
            .collect();
        let lost = push_plug(&mut rigids, &mut other, &pushes);
        rigids.push(other);
        take_energy(&mut rigids, fracture.report.fracture_energy - lost);
        let other = rigids.pop();
        if let (Some((entity, (kind, _))), Some(other)) = (striker, other)
            && kind.is_dynamic()
        {
            commands.entity(entity).try_insert(velocities(&other));
        }
        for (i, rigid) in order.into_iter().zip(&rigids) {
            commands.entity(fragments[i]).try_insert(velocities(rigid));
        }
    }
}

fn velocities(body: &Rigid) -> (LinearVelocity, AngularVelocity) {
    let single = |v: DVec3| Vec3::from_array(v.as_vec3().to_array());
    (
        LinearVelocity(single(body.linear)),
        AngularVelocity(single(body.angular)),
    )
}

/// Mass, centre and inertia of the piece itself, whatever its collider's volume.
fn masses(mass: &MassProperties) -> impl Bundle {
    let columns = mass.inertia.as_mat3().to_cols_array();
    let tensor = AngularInertia::try_from_mat3(Mat3::from_cols_array(&columns))
        .unwrap_or_else(|_| AngularInertia::from_mat3_unchecked(Mat3::from_cols_array(&columns)));
    (
        Mass(mass.mass as f32),
        tensor,
        CenterOfMass::ZERO,
        NoAutoMass,
        NoAutoAngularInertia,
        NoAutoCenterOfMass,
    )
}

/// Convex parts as a collider; where they are too flat for hulls, the box about them.
fn collider<'a>(parts: impl Iterator<Item = &'a [glam::Vec3]>) -> Collider {
    let mut all: Vec<Vec3> = Vec::new();
    let mut hulls = Vec::new();
    for part in parts {
        let points: Vec<Vec3> = part.iter().map(|p| out(*p)).collect();
        all.extend(&points);
        if let Some(hull) = Collider::convex_hull(points) {
            hulls.push((Vec3::ZERO, Quat::IDENTITY, hull));
        }
    }
    if hulls.len() > 1 {
        return Collider::compound(hulls);
    }
    if let Some((_, _, hull)) = hulls.pop() {
        return hull;
    }
    let (low, high) = all.iter().fold((Vec3::ZERO, Vec3::ZERO), |(low, high), p| {
        (low.min(*p), high.max(*p))
    });
    let size = (high - low).max(Vec3::splat(1e-4));
    Collider::cuboid(size.x, size.y, size.z)
}

/// A body that is ready gets a collider and its mass; what the game has given it already stays.
fn give_collider(
    ready: On<Insert, BreakableBody>,
    bodies: Query<(&BreakableBody, Has<Collider>)>,
    mut commands: Commands,
) {
    let Ok((body, has_collider)) = bodies.get(ready.entity) else {
        return;
    };
    let baked = body.0.asset();
    let mut entity = commands.entity(ready.entity);
    let kind = if baked.is_supported() {
        entity.insert(RigidBody::Static);
        RigidBody::Static
    } else {
        RigidBody::Dynamic
    };
    entity.insert_if_new((kind, surface(&baked.material)));
    entity.insert((masses(&baked.mass), ActiveCollisionHooks::MODIFY_CONTACTS));
    if !has_collider {
        entity.insert(collider(baked.cells.iter().map(|cell| &cell.points[..])));
    }
}

fn surface(material: &Material) -> (Friction, Restitution) {
    (
        Friction::new(material.friction as f32),
        Restitution::new(material.restitution as f32),
    )
}

/// Pieces get colliders and masses, and the velocities that they had as parts of the body.
fn give_fragments(
    broke: On<Broke>,
    moving: Query<(&RigidBody, Moving, Option<&CollisionLayers>)>,
    mut commands: Commands,
) {
    let Ok((kind, now, layers)) = moving.get(broke.entity) else {
        return;
    };
    let (at, rotation) = (now.0.0, now.1.0);
    let whole = rigid(kind, now);
    for (fragment, &entity) in broke.fracture.fragments.iter().zip(&broke.fragments) {
        let supported = fragment.supported && !whole.gives_way();
        let body = piece(&fragment.mass, supported, &whole, rotation, at);
        let shares = fragment.cell_shares.iter().map(|(_, points)| &points[..]);
        let mut piece = commands.entity(entity);
        piece.try_insert((
            if supported {
                RigidBody::Static
            } else {
                RigidBody::Dynamic
            },
            collider(shares),
            masses(&fragment.mass),
        ));
        piece.try_insert_if_new(velocities(&body));
        if let Some(layers) = layers {
            piece.try_insert(*layers);
        }
    }
    commands.entity(broke.entity).try_remove::<(
        Collider,
        RigidBody,
        ActiveCollisionHooks,
        LinearVelocity,
        AngularVelocity,
    )>();
}

/// A script's impulse moves what it struck.
fn push(
    pushed: On<Pushed>,
    mut moving: Query<
        (
            &RigidBody,
            &Position,
            &Rotation,
            &mut LinearVelocity,
            &mut AngularVelocity,
            &ComputedMass,
            &ComputedAngularInertia,
            &ComputedCenterOfMass,
        ),
        Without<Broken>,
    >,
    mut commands: Commands,
) {
    let Ok((kind, position, rotation, mut linear, mut angular, mass, inertia, centre)) =
        moving.get_mut(pushed.entity)
    else {
        // A piece that was just born is pushed once Avian knows its mass.
        let Pushed { entity, .. } = *pushed;
        if !(pushed.at.is_finite() && pushed.impulse.is_finite()) {
            let reason = "the blow is not finite; give a point and an impulse".into();
            commands.trigger(BreakFailed { entity, reason });
        }
        return;
    };
    if !kind.is_dynamic() {
        return;
    }
    let arm = pushed.at - (position.0 + rotation.0 * centre.0);
    linear.0 += pushed.impulse * mass.inverse();
    angular.0 += inertia.rotated(rotation.0).inverse() * arm.cross(pushed.impulse);
}
