//! Changes to entities that do not depend on the engine: bodies break, and fragments take their place.

use std::sync::Arc;

use bevy::prelude::*;
use bevy::tasks::{ComputeTaskPool, TaskPool};
use frangible::internals::fracture_at;
use frangible::{Body, Fracture, ImpactReport, InputError, Outcome};

use crate::again::{expect_pieces, expect_weaker};
use crate::debris::remember;
use crate::meshes::{Faces, Part, authored, faces, into, out};
use crate::{
    Blow, Born, BreakFailed, BreakableBody, Broke, Broken, CrackFaces, Fracturing, FragmentOf,
    Held, Judges, OuterFaces, Pushed,
};

/// A script's blow.
pub(crate) fn obey(
    blow: On<Blow>,
    mut bodies: Query<(&mut BreakableBody, &GlobalTransform)>,
    (config, judges): (Res<Fracturing>, Res<Judges>),
    mut commands: Commands,
) {
    if *judges != Judges::Here {
        return;
    }
    let entity = blow.entity;
    let Ok((mut body, transform)) = bodies.get_mut(entity) else {
        let reason = "the entity is not a breakable body, is already broken, or its asset is not loaded yet; send the blow once it has `BreakableBody`";
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

/// Effect of a load on a body.
pub(crate) struct Judged {
    pub(crate) outcome: Result<Outcome, InputError>,
    /// The outer and the crack faces of the fragments, where they are made already.
    pub(crate) faces: Option<Vec<Faces>>,
}

impl From<Result<Outcome, InputError>> for Judged {
    fn from(outcome: Result<Outcome, InputError>) -> Self {
        let faces = None;
        Self { outcome, faces }
    }
}

impl Judged {
    pub(crate) fn broke(&self) -> bool {
        matches!(self.outcome, Ok(Outcome::Broke(_)))
    }

    pub(crate) fn report(&self) -> Option<&ImpactReport> {
        self.outcome.as_ref().ok().map(Outcome::report)
    }
}

/// Carries out an outcome. Returns the break.
pub(crate) fn conclude(
    commands: &mut Commands,
    entity: Entity,
    body: &mut BreakableBody,
    pose: Transform,
    judged: impl Into<Judged>,
) -> Option<(Arc<Fracture>, Vec<Entity>)> {
    let Judged { outcome, faces } = judged.into();
    match outcome {
        Ok(Outcome::Broke(fracture)) => {
            let fracture = Arc::new(*fracture);
            let fragments = replace(commands, entity, Some(&body.0), pose, &fracture, faces);
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
            if let Some(state) = state {
                if let Err(error) = body.0.set_state(*state) {
                    fail(commands, entity, &error);
                    return None;
                }
                let cracked = body.0.clone();
                commands.queue(move |world: &mut World| {
                    let config = world.resource::<Fracturing>().0.clone();
                    expect_weaker(world, entity, cracked, config);
                });
            }
            commands.trigger(Held {
                entity,
                margin,
                report,
            });
            None
        }
        Err(error) => {
            fail(commands, entity, &error);
            None
        }
        Ok(_) => None,
    }
}

pub(crate) fn fail(commands: &mut Commands, entity: Entity, error: &InputError) {
    let reason = error.to_string();
    commands.trigger(BreakFailed { entity, reason });
}

/// Does the same for each of them on Bevy's task pool; the results are in their order.
pub(crate) fn in_parallel<T: Sync, R: Send + 'static>(
    items: &[T],
    work: impl Fn(&T) -> R + Sync,
) -> Vec<R> {
    let pool = ComputeTaskPool::get_or_init(TaskPool::default);
    let work = &work;
    pool.scope(|scope| {
        for item in items {
            scope.spawn(async move { work(item) });
        }
    })
}

/// Fragments in the place of a body, at its pose.
pub(crate) fn replace(
    commands: &mut Commands,
    entity: Entity,
    body: Option<&Body>,
    pose: Transform,
    fracture: &Arc<Fracture>,
    made: Option<Vec<Faces>>,
) -> Vec<Entity> {
    // The entity may be despawned in the same frame: then its fragments go with it.
    commands
        .entity(entity)
        .try_remove::<(BreakableBody, Mesh3d)>()
        .try_insert(Broken);
    let surface = body.and_then(|body| authored(body.asset()));
    let make = || in_parallel(&fracture.fragments, |fragment| faces(fragment, surface));
    let meshes = made.unwrap_or_else(make);
    let pieces: Vec<Entity> = (fracture.fragments.iter())
        .map(|fragment| {
            let centre = pose.transform_point(out(fragment.mass.centre.as_vec3()));
            let place = Transform::from_translation(centre).with_rotation(pose.rotation);
            commands.spawn(place).id()
        })
        .collect();
    let (body, fracture, fragments) = (body.cloned(), Arc::clone(fracture), pieces.clone());
    commands.queue(move |world: &mut World| {
        if world.get_entity(entity).is_err() {
            for piece in fragments {
                world.despawn(piece);
            }
            return;
        }
        strip(world, entity);
        let born = world.resource::<Time<Fixed>>().elapsed();
        for (&piece, meshes) in fragments.iter().zip(meshes) {
            world
                .entity_mut(piece)
                .insert((FragmentOf(entity), Born(born)));
            give_faces(world, piece, meshes);
        }
        remember(world, &fracture.fragments, &fragments);
        if let Some(body) = body {
            expect_pieces(world, &body, &fracture, &fragments);
        }
    });
    pieces
}

/// A piece that breaks again loses its faces.
fn strip(world: &mut World, entity: Entity) {
    let children = world.get::<Children>(entity);
    let faces = children
        .into_iter()
        .flat_map(|c| c.iter())
        .filter(|&child| {
            world.get::<OuterFaces>(child).is_some() || world.get::<CrackFaces>(child).is_some()
        });
    let faces: Vec<Entity> = faces.collect();
    for child in faces {
        world.despawn(child);
    }
}

fn give_faces(world: &mut World, piece: Entity, Faces { outer, crack }: Faces) {
    for part in outer {
        give_part(world, piece, part);
    }
    let Some(mut known) = world.get_resource_mut::<Assets<Mesh>>() else {
        return;
    };
    if let Some(crack) = crack.map(|mesh| Mesh3d(known.add(mesh))) {
        world.spawn((crack, CrackFaces, ChildOf(piece)));
    }
}

/// Gives an entity outer faces as a child.
pub(crate) fn give_part(world: &mut World, entity: Entity, (mesh, material): Part) {
    let Some(mut known) = world.get_resource_mut::<Assets<Mesh>>() else {
        return;
    };
    let mesh = Mesh3d(known.add(mesh));
    let mut child = world.spawn((mesh, OuterFaces, ChildOf(entity)));
    if let Some(material) = material {
        child.insert((Name::new(material.name.clone()), material));
    }
}
