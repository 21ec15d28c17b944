//! Breaking bodies in a Rapier world of `frangible-rapier` instead of Avian.
//!
//! The world is a resource with its own bodies; entities have handles to them, and their transforms follow. The world computes breaks and moves
//! the pieces, so [`FrangibleRapierPlugin`] replaces [`FrangiblePlugin`](crate::FrangiblePlugin).

use std::collections::BTreeMap;
use std::sync::Arc;

use bevy::prelude::*;
use frangible::Outcome;
use frangible_rapier::rapier3d::dynamics::{RigidBodyBuilder, RigidBodyHandle};
use frangible_rapier::rapier3d::math::{Pose, Rotation};
use frangible_rapier::{BreakableWorld, WorldConfig};

use crate::break_apart::{conclude, replace};
use crate::meshes::{into, out};
use crate::{Blow, BreakFailed, BreakableBody, Broke, FragmentOf, Judges};

/// Plugin that lets entities with [`Breakable`](crate::Breakable) break in a [`RapierWorld`]. The fracture settings are those of the world.
pub struct FrangibleRapierPlugin(pub WorldConfig);

impl Default for FrangibleRapierPlugin {
    fn default() -> Self {
        Self(WorldConfig::for_games())
    }
}

/// Resource with the Rapier world, which is stepped in `FixedUpdate`. Use it to insert other bodies and for queries.
#[derive(Resource)]
pub struct RapierWorld(pub BreakableWorld);

/// Component with the handle of a body of the [`RapierWorld`]. The entity's [`Transform`] follows the body; removing one of the two removes the
/// other. Breakable entities and their fragments get it automatically; a game adds it for bodies that it inserted itself.
#[derive(Component, Clone, Copy, Debug)]
#[require(Transform)]
pub struct RapierBody(pub RigidBodyHandle);

/// The entity of each body.
#[derive(Resource, Default)]
struct Entities(BTreeMap<(u32, u32), Entity>);

impl Plugin for FrangibleRapierPlugin {
    fn build(&self, app: &mut App) {
        let mut config = self.0.clone();
        config.record_held = true;
        crate::build(app, &config.fracture);
        match BreakableWorld::new(config) {
            Ok(world) => app.insert_resource(RapierWorld(world)),
            Err(error) => {
                error!("cannot create the Rapier world: {error}");
                return;
            }
        };
        app.insert_resource(Judges::Rapier)
            .init_resource::<Entities>()
            .add_observer(insert)
            .add_observer(note)
            .add_observer(forget)
            .add_observer(strike)
            .add_systems(FixedUpdate, (step, follow).chain());
    }
}

/// A body that is ready goes into the world.
fn insert(
    ready: On<Insert, BreakableBody>,
    bodies: Query<&BreakableBody, (Without<RapierBody>, Without<FragmentOf>)>,
    places: TransformHelper,
    mut world: ResMut<RapierWorld>,
    mut commands: Commands,
) {
    let entity = ready.entity;
    let Ok(body) = bodies.get(entity) else { return };
    let place = places.compute_global_transform(entity).unwrap_or_default();
    let (_, turn, at) = place.to_scale_rotation_translation();
    let pose = Pose::from_parts(into(at), Rotation::from_array(turn.to_array()));
    let rigid = RigidBodyBuilder::dynamic().pose(pose);
    match world.0.insert(body.0.clone(), rigid) {
        Ok(handle) => {
            commands.entity(entity).try_insert(RapierBody(handle));
        }
        Err(error) => {
            let reason = error.to_string();
            commands.trigger(BreakFailed { entity, reason });
        }
    }
}

fn note(added: On<Insert, RapierBody>, bodies: Query<&RapierBody>, mut known: ResMut<Entities>) {
    if let Ok(body) = bodies.get(added.entity) {
        known.0.insert(body.0.into_raw_parts(), added.entity);
    }
}

fn forget(
    gone: On<Discard, RapierBody>,
    bodies: Query<&RapierBody>,
    mut known: ResMut<Entities>,
    mut world: ResMut<RapierWorld>,
) {
    if let Ok(body) = bodies.get(gone.entity) {
        known.0.remove(&body.0.into_raw_parts());
        world.0.physics.remove_body(body.0);
    }
}

/// A script's blow acts at the beginning of the next step.
fn strike(
    blow: On<Blow>,
    bodies: Query<&RapierBody>,
    mut world: ResMut<RapierWorld>,
    mut commands: Commands,
) {
    let entity = blow.entity;
    let done = match bodies.get(entity) {
        Ok(body) => world
            .0
            .fracture_at(body.0, into(blow.at), into(blow.impulse))
            .map_err(|error| error.to_string()),
        Err(_) => Err("the entity has no `RapierBody` yet; send the blow once it has".into()),
    };
    if let Err(reason) = done {
        commands.trigger(BreakFailed { entity, reason });
    }
}

/// Steps the world, and tells entities of breaks and of blows that held.
fn step(
    mut world: ResMut<RapierWorld>,
    known: Res<Entities>,
    mut bodies: Query<&mut BreakableBody>,
    time: Res<Time>,
    mut commands: Commands,
) {
    let world = &mut world.0;
    world.physics.integration_parameters.dt = time.delta_secs();
    if let Err(error) = world.step() {
        error!("a break failed and the body stays whole: {error}");
    }
    let entity = |handle: RigidBodyHandle| known.0.get(&handle.into_raw_parts()).copied();
    for event in world.held() {
        let Some((body, entity)) = entity(event.body).map(|e| (bodies.get_mut(e), e)) else {
            continue;
        };
        let Ok(mut body) = body else { continue };
        let outcome = Outcome::Held {
            margin: event.margin,
            report: event.report.clone(),
            state: event.state.clone().map(Box::new),
        };
        let pose = Transform::default();
        conclude(&mut commands, entity, &mut body, pose, Ok(outcome));
    }
    for event in world.breaks() {
        let Some(entity) = entity(event.parent) else {
            continue;
        };
        let body = bodies.get(entity).map(|body| body.0.clone()).ok();
        let pose = transform(&event.pose);
        let fracture = &event.fracture;
        let fragments = replace(&mut commands, entity, body.as_ref(), pose, fracture, None);
        for (&fragment, &handle) in fragments.iter().zip(&event.fragments) {
            commands.entity(fragment).try_insert(RapierBody(handle));
        }
        commands.entity(entity).try_remove::<RapierBody>();
        commands.trigger(Broke {
            entity,
            fragments,
            fracture: Arc::clone(fracture),
        });
    }
}

fn transform(pose: &Pose) -> Transform {
    let turn = Quat::from_array(pose.rotation.to_array());
    Transform::from_translation(out(pose.translation)).with_rotation(turn)
}

/// Lets transforms follow their bodies, and shrinks pieces that go.
fn follow(
    world: Res<RapierWorld>,
    mut bodies: Query<(Entity, &RapierBody, &mut Transform)>,
    mut commands: Commands,
) {
    let fading: BTreeMap<(u32, u32), f32> = (world.0.fading())
        .map(|(handle, left)| (handle.into_raw_parts(), left))
        .collect();
    for (entity, handle, mut place) in &mut bodies {
        if let Some(&left) = fading.get(&handle.0.into_raw_parts()) {
            place.scale = Vec3::splat(left);
            continue;
        }
        let Some(body) = world.0.physics.bodies.get(handle.0) else {
            commands.entity(entity).try_despawn();
            continue;
        };
        if !(body.is_sleeping() || body.is_fixed()) {
            let scale = place.scale;
            *place = transform(body.position()).with_scale(scale);
        }
    }
}
