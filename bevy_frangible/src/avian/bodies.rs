//! Avian components of bodies and pieces: colliders, masses, velocities.

use avian3d::prelude::*;
use bevy::prelude::*;
use frangible::MassProperties;
use frangible::Material;
use frangible::glam::DQuat;
use frangible::internals::mesh::symmetric_eigen;

use super::calm::Place;
use super::colliders::{ColliderDetail, of_fragment, whole};
use super::plain::{piece, rigid, velocities};
use super::{Carries, MadeOf, Molds, Moving};
use crate::break_apart::in_parallel;
use crate::per_asset::PerAsset;
use crate::{
    BreakFailed, Breakable, BreakableBody, Broke, Broken, DebrisBudget, FrangibleAsset, Pushed,
};

/// Gives a body that is ready a collider and its mass; components that the game has given it already stay.
pub(super) fn give_collider(
    ready: On<Insert, BreakableBody>,
    bodies: Query<(
        &BreakableBody,
        Option<&Collider>,
        Option<&ActiveCollisionHooks>,
        Option<&Breakable>,
    )>,
    (assets, detail): (Res<Assets<FrangibleAsset>>, Res<ColliderDetail>),
    mut made: Local<(ColliderDetail, PerAsset<Collider>)>,
    mut commands: Commands,
) {
    let Ok((body, known, hooks, breakable)) = bodies.get(ready.entity) else {
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
    let before = hooks.copied().unwrap_or_default();
    entity.insert_if_new((
        kind,
        Carries::default(),
        surface(baked.material()),
        MadeOf(baked.material().clone()),
    ));
    entity.insert((
        masses(&baked.mass()),
        before | ActiveCollisionHooks::MODIFY_CONTACTS,
    ));
    match known {
        None => {
            let collider = match breakable {
                Some(breakable) => {
                    // Avian scales it as the entity is.
                    let id = breakable.0.id();
                    let baked = assets.get(id).map_or(baked, |asset| asset.0.asset());
                    if made.0 != *detail {
                        *made = (*detail, PerAsset::default());
                    }
                    made.1.forget(&assets);
                    made.1.of(id, baked, || whole(baked, detail.whole))
                }
                None => whole(baked, detail.whole),
            };
            entity.insert(collider);
        }
        // Avian notes these hooks only when a collider comes.
        Some(known) if !before.contains(ActiveCollisionHooks::MODIFY_CONTACTS) => {
            entity.insert(known.clone());
        }
        Some(_) => {}
    }
}

fn surface(material: &Material) -> (Friction, Restitution) {
    (
        Friction::new(material.friction as f32),
        Restitution::new(material.restitution as f32),
    )
}

/// Components of a body that its pieces have too.
pub(super) type Inherited = (
    CollisionLayers,
    Friction,
    Restitution,
    GravityScale,
    LinearDamping,
    AngularDamping,
    CollisionEventsEnabled,
    SweptCcd,
    MadeOf,
);

/// Pieces get colliders and masses, and the velocities that they had as parts of the body.
pub(super) fn give_fragments(
    broke: On<Broke>,
    moving: Query<(&RigidBody, Moving, Option<&ActiveCollisionHooks>)>,
    (budget, detail, mut molds): (Res<DebrisBudget>, Res<ColliderDetail>, ResMut<Molds>),
    mut commands: Commands,
) {
    let entity = broke.entity;
    let made = molds.0.remove(&entity);
    let Ok((kind, now, hooks)) = moving.get(entity) else {
        let reason = "the body breaks but has no rigid body, so its pieces have none either; do not remove its `RigidBody`";
        let reason = reason.into();
        commands.trigger(BreakFailed { entity, reason });
        return;
    };
    let (at, rotation) = (now.0.0, now.1.0);
    let parent = rigid(kind, now);
    let colliders = made.unwrap_or_else(|| {
        in_parallel(&broke.fracture.fragments, |fragment| {
            (!budget.is_dust(fragment)).then(|| of_fragment(fragment, &detail))
        })
    });
    let fragments = broke.fracture.fragments.iter().zip(colliders);
    for ((fragment, collider), &piece_entity) in fragments.zip(&broke.fragments) {
        let supported = fragment.supported && !parent.gives_way();
        let body = piece(&fragment.mass, supported, &parent, rotation, at);
        let mut piece = commands.entity(piece_entity);
        piece.try_insert((
            if supported {
                RigidBody::Static
            } else {
                RigidBody::Dynamic
            },
            masses(&fragment.mass),
            Place::default(),
            SpeculativeMargin(detail.fragments_see),
            hooks.copied().unwrap_or_default() | ActiveCollisionHooks::MODIFY_CONTACTS,
        ));
        if let Some(collider) = collider {
            piece.try_insert(collider);
        }
        piece.try_insert_if_new(velocities(&body));
        commands.queue(move |world: &mut World| {
            if world.get_entity(piece_entity).is_ok()
                && let Ok(mut body) = world.get_entity_mut(entity)
            {
                body.clone_with_opt_in(piece_entity, |builder| {
                    builder.allow::<Inherited>();
                });
            }
        });
    }
    commands.entity(entity).try_remove::<(
        Collider,
        RigidBody,
        ActiveCollisionHooks,
        LinearVelocity,
        AngularVelocity,
    )>();
}

/// A breakable body whose collider was taken away is never struck.
pub(super) fn miss_collider(removed: On<Remove, Collider>, mut commands: Commands) {
    let entity = removed.entity;
    commands.queue(move |world: &mut World| {
        let body = world.get_entity(entity);
        if body.is_ok_and(|b| b.contains::<BreakableBody>() && !b.contains::<Collider>()) {
            let reason = "the collider of the body was removed, so nothing can strike it; insert another one, or send a `Blow`";
            let reason = reason.into();
            world.trigger(BreakFailed { entity, reason });
        }
    });
}

/// Moves the body or piece that a script's impulse struck.
pub(super) fn push(
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
            let reason = "the blow is not finite; give a finite point and impulse".into();
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

/// Mass, centre and inertia of the piece itself, whatever its collider's volume. Avian's own conversion of a tensor takes one whose products of inertia are
/// below 1e-5 kg·m² for a diagonal one: most pieces would turn about wrong axes, and have another energy.
fn masses(mass: &MassProperties) -> impl Bundle + use<> {
    let (moments, axes) = symmetric_eigen(mass.inertia);
    let frame = DQuat::from_mat3(&axes).normalize().as_quat();
    let (moments, frame) = (moments.as_vec3().to_array(), frame.to_array());
    (
        Mass(mass.mass as f32),
        AngularInertia {
            principal: Vec3::from_array(moments),
            local_frame: Quat::from_array(frame),
        },
        CenterOfMass::ZERO,
        NoAutoMass,
        NoAutoAngularInertia,
        NoAutoCenterOfMass,
    )
}
