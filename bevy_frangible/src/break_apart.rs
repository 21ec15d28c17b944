//! What happens to entities, whatever engine moves them: bodies become ready, break, and fragments take their place.

use std::sync::Arc;

use bevy::asset::{AssetLoadFailedEvent, LoadState};
use bevy::prelude::*;
use frangible::internals::fracture_at;
use frangible::{Fracture, InputError, Outcome};

use crate::meshes::{faces, into, out, whole};
use crate::{
    Blow, BreakFailed, Breakable, BreakableBody, Broke, Broken, CrackFaces, Fracturing, FragmentOf,
    FrangibleAsset, Held, Looks, OuterFaces, Pushed, Seed,
};

/// Scales differ from 1 by less than this where they are meant to be 1.
const ROUNDING: f32 = 1e-4;

/// Why an entity cannot break as it stands, if it cannot.
fn scaled(transform: &Transform) -> Option<String> {
    let scale = transform.scale;
    let one = (scale - Vec3::ONE).abs().max_element() <= ROUNDING;
    (!one).then(|| {
        format!(
            "the entity is scaled by {scale}; a body's stress does not scale with it: bake it in the size that it has, or load it \
             with `frangible bake --size`"
        )
    })
}

/// Entities whose asset is there get their body and mesh.
pub(crate) fn make_ready(
    mut commands: Commands,
    waiting: Query<
        (Entity, &Breakable, &Seed, &Transform),
        (Without<BreakableBody>, Without<Broken>),
    >,
    assets: Res<Assets<FrangibleAsset>>,
    mut meshes: ResMut<Assets<Mesh>>,
) {
    for (entity, breakable, seed, transform) in &waiting {
        let Some(asset) = assets.get(&breakable.0) else {
            continue;
        };
        if let Some(reason) = scaled(transform) {
            // Said once: without the component it is an entity like others.
            commands.entity(entity).remove::<Breakable>();
            commands.trigger(BreakFailed { entity, reason });
            continue;
        }
        let body = asset.0.body(seed.0);
        let mesh = Mesh3d(meshes.add(whole(body.asset())));
        commands
            .entity(entity)
            .insert_if_new(mesh)
            .insert(BreakableBody(body));
    }
}

/// Says on every entity of an asset that it cannot be loaded.
pub(crate) fn report_failures(
    mut commands: Commands,
    mut failures: MessageReader<AssetLoadFailedEvent<FrangibleAsset>>,
    entities: Query<(Entity, &Breakable), Without<BreakableBody>>,
    server: Res<AssetServer>,
) {
    for failure in failures.read() {
        let of_asset = entities.iter().filter(|(_, b)| b.0.id() == failure.id);
        for (entity, breakable) in of_asset {
            let reason = match server.load_state(&breakable.0) {
                LoadState::Failed(error) => error.to_string(),
                _ => failure.error.to_string(),
            };
            commands.trigger(BreakFailed { entity, reason });
        }
    }
}

/// A script's blow.
pub(crate) fn obey(
    blow: On<Blow>,
    mut bodies: Query<(&mut BreakableBody, &GlobalTransform)>,
    config: Res<Fracturing>,
    mut commands: Commands,
) {
    let entity = blow.entity;
    let Ok((mut body, transform)) = bodies.get_mut(entity) else {
        let reason = "the entity is no breakable body, is broken, or its asset is not loaded yet; send the blow once it has \
                      `BreakableBody`";
        let reason = reason.into();
        commands.trigger(BreakFailed { entity, reason });
        return;
    };
    let (_, rotation, translation) = transform.to_scale_rotation_translation();
    let to_body = rotation.inverse();
    let at = to_body * (blow.at - translation);
    let outcome = fracture_at(&body.0, into(at), into(to_body * blow.impulse), &config.0);
    let sound = outcome.is_ok();
    let pose = Transform::from_translation(translation).with_rotation(rotation);
    let broke = conclude(&mut commands, entity, &mut body, pose, outcome);
    if !sound {
        return;
    }
    // The piece nearest to the blow takes its impulse.
    let struck = broke.and_then(|(fracture, fragments)| {
        let at = into(at);
        let gaps = fracture.fragments.iter().map(|f| {
            let local = at - f.mass.centre.as_vec3();
            let corners = f.mesh.positions.iter();
            corners.fold(f32::INFINITY, |gap, p| gap.min(p.distance_squared(local)))
        });
        let nearest = gaps.zip(fragments).min_by(|a, b| a.0.total_cmp(&b.0));
        nearest.map(|(_, piece)| piece)
    });
    commands.trigger(Pushed {
        entity: struck.unwrap_or(entity),
        at: blow.at,
        impulse: blow.impulse,
    });
}

/// Does what an outcome says; returns the break.
pub(crate) fn conclude(
    commands: &mut Commands,
    entity: Entity,
    body: &mut BreakableBody,
    pose: Transform,
    outcome: Result<Outcome, InputError>,
) -> Option<(Arc<Fracture>, Vec<Entity>)> {
    match outcome {
        Ok(Outcome::Broke(fracture)) => {
            let fracture = Arc::new(*fracture);
            let fragments = replace(commands, entity, pose, &fracture);
            commands.trigger(Broke {
                entity,
                fragments: fragments.clone(),
                fracture: Arc::clone(&fracture),
            });
            Some((fracture, fragments))
        }
        Ok(Outcome::Held {
            margin,
            report,
            state,
        }) => {
            let kept = state.map_or(Ok(()), |state| body.0.set_state(*state));
            match kept {
                Ok(()) => commands.trigger(Held {
                    entity,
                    margin,
                    report,
                }),
                Err(error) => fail(commands, entity, &error),
            }
            None
        }
        Err(error) => {
            fail(commands, entity, &error);
            None
        }
        Ok(_) => None,
    }
}

fn fail(commands: &mut Commands, entity: Entity, error: &InputError) {
    let reason = error.to_string();
    commands.trigger(BreakFailed { entity, reason });
}

/// Fragments in the place of a body, at its pose.
fn replace(
    commands: &mut Commands,
    entity: Entity,
    pose: Transform,
    fracture: &Arc<Fracture>,
) -> Vec<Entity> {
    // The entity may be despawned in the same frame: then its fragments go with it.
    commands
        .entity(entity)
        .try_remove::<(BreakableBody, Mesh3d)>()
        .try_insert(Broken);
    let pieces = fracture.fragments.iter().map(|fragment| {
        let centre = pose.transform_point(out(fragment.mass.centre.as_vec3()));
        let place = Transform::from_translation(centre).with_rotation(pose.rotation);
        let meshes = faces(&fragment.mesh);
        let piece = commands.spawn(place).id();
        commands.queue(move |world: &mut World| {
            if world.get_entity(entity).is_err() {
                world.despawn(piece);
                return;
            }
            world.entity_mut(piece).insert(FragmentOf(entity));
            let Some(mut known) = world.get_resource_mut::<Assets<Mesh>>() else {
                return;
            };
            let [outer, crack] = meshes.map(|mesh| mesh.map(|mesh| Mesh3d(known.add(mesh))));
            world.entity_mut(piece).with_children(|piece| {
                if let Some(mesh) = outer {
                    piece.spawn((mesh, OuterFaces));
                }
                if let Some(mesh) = crack {
                    piece.spawn((mesh, CrackFaces));
                }
            });
        });
        piece
    });
    pieces.collect()
}

/// A body gets the look of its outer faces.
pub(crate) fn dress_body<C: Component + Clone>(
    ready: On<Insert, BreakableBody>,
    looks: Query<&Looks<C>>,
    mut commands: Commands,
) {
    if let Ok(looks) = looks.get(ready.entity) {
        commands.entity(ready.entity).insert(looks.outer.clone());
    }
}

/// Fragments get the looks of their body.
pub(crate) fn dress_fragments<C: Component + Clone>(
    broke: On<Broke>,
    looks: Query<&Looks<C>>,
    children: Query<&Children>,
    (outer, crack): (Query<(), With<OuterFaces>>, Query<(), With<CrackFaces>>),
    mut commands: Commands,
) {
    let Ok(looks) = looks.get(broke.entity) else {
        return;
    };
    let pieces = broke.fragments.iter().filter_map(|&f| children.get(f).ok());
    for child in pieces.flat_map(|children| children.iter()) {
        if outer.contains(child) {
            commands.entity(child).insert(looks.outer.clone());
        } else if crack.contains(child) {
            commands.entity(child).insert(looks.crack.clone());
        }
    }
}
