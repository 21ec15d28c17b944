//! Entities whose asset is there become bodies of the size that they have.

use std::collections::BTreeMap;
use std::sync::Arc;

use bevy::asset::LoadState;
use bevy::prelude::*;
use frangible::{Asset as Baked, Breakable as Kind};

use crate::break_apart::give_part;
use crate::meshes::{whole, whole_by_material};
use crate::per_asset::PerAsset;
use crate::{BreakFailed, Breakable, BreakableBody, Broken, FrangibleAsset, Seed, SplitByMaterial};

/// Scales that differ by less than this, relative to the largest, are meant to be equal.
const ROUNDING: f32 = 1e-4;

/// The one factor of a uniform scale, or why there is none.
fn factor(scale: Vec3) -> Result<f32, String> {
    let (least, most) = (scale.min_element(), scale.max_element());
    let uniform = most - least <= ROUNDING * most;
    match uniform && least > 0.0 && most.is_finite() {
        true if (most - 1.0).abs() <= ROUNDING => Ok(1.0),
        true => Ok(most),
        false => Err(format!(
            "the entity is scaled by {scale}, but only a uniform scale above zero is supported, because others change the modes; bake the body in its scaled shape"
        )),
    }
}

/// Kinds in sizes other than that of their file, so that each is made once.
#[derive(Default)]
pub(crate) struct Sizes(BTreeMap<(AssetId<FrangibleAsset>, u32), (Arc<Baked>, Kind)>);

impl Sizes {
    fn kind(
        &mut self,
        id: AssetId<FrangibleAsset>,
        kind: &Kind,
        factor: f32,
    ) -> Result<Kind, String> {
        if factor == 1.0 {
            return Ok(kind.clone());
        }
        let key = (id, factor.to_bits());
        if let Some((of, scaled)) = self.0.get(&key)
            && Arc::ptr_eq(of, kind.asset())
        {
            return Ok(scaled.clone());
        }
        let scaled = kind.scaled(f64::from(factor));
        let scaled =
            scaled.map_err(|error| format!("the entity is scaled by {factor}: {error}"))?;
        let known = (Arc::clone(kind.asset()), scaled.clone());
        self.0.insert(key, known);
        Ok(scaled)
    }
}

/// Said once: without the component it is an entity like others.
fn refuse(commands: &mut Commands, entity: Entity, reason: String) {
    commands.entity(entity).try_remove::<Breakable>();
    commands.trigger(BreakFailed { entity, reason });
}

/// Entities whose asset is there get their body and mesh.
pub(crate) fn make_ready(
    mut commands: Commands,
    waiting: Query<
        (Entity, &Breakable, &Seed, Has<SplitByMaterial>),
        (Without<BreakableBody>, Without<Broken>),
    >,
    places: TransformHelper,
    (assets, server): (Res<Assets<FrangibleAsset>>, Res<AssetServer>),
    mut meshes: ResMut<Assets<Mesh>>,
    mut drawn: Local<PerAsset<Handle<Mesh>>>,
    mut sizes: Local<Sizes>,
) {
    if waiting.is_empty() {
        return;
    }
    sizes.0.retain(|(id, _), _| assets.contains(*id));
    drawn.forget(&assets);
    for (entity, breakable, seed, split) in &waiting {
        let id = breakable.0.id();
        let Some(asset) = assets.get(id) else {
            if let LoadState::Failed(error) = server.load_state(id) {
                refuse(&mut commands, entity, error.to_string());
            }
            continue;
        };
        let place = places.compute_global_transform(entity);
        let scale = place.map_or(Vec3::ONE, |place| place.scale());
        let kind = factor(scale).and_then(|factor| sizes.kind(id, &asset.0, factor));
        let body = match kind {
            Ok(kind) => kind.body(seed.0),
            Err(reason) => {
                refuse(&mut commands, entity, reason);
                continue;
            }
        };
        // The entity's scale is on its mesh already.
        let baked = asset.0.asset();
        let parts = match split {
            true => whole_by_material(baked),
            false => Vec::new(),
        };
        if parts.is_empty() {
            let mesh = drawn.of(id, baked, || meshes.add(whole(baked)));
            commands.entity(entity).insert_if_new(Mesh3d(mesh));
        }
        commands.queue(move |world: &mut World| {
            if world.get_entity(entity).is_ok() {
                for part in parts {
                    give_part(world, entity, part);
                }
            }
        });
        commands.entity(entity).insert(BreakableBody(body));
    }
}
