//! Pieces of one body that rest become one static body: one collider, and one mesh for outer and for crack faces.

use avian3d::prelude::*;
use bevy::camera::primitives::Aabb;
use bevy::prelude::*;

use super::bodies::Inherited;
use crate::{Born, CrackFaces, FragmentOf, Fragments, MaterialOfFile, OuterFaces, Rubble};

/// Convex parts of a collider, where they are.
type Parts = Vec<(Vec3, Quat, Collider)>;

/// Puts pieces of a body that broke, which rest, into its one static body.
pub(super) fn merge(world: &mut World, parent: Entity, pieces: &[Entity]) {
    let there = |&piece: &Entity| {
        world
            .get_entity(piece)
            .is_ok_and(|e| e.contains::<Collider>())
    };
    let pieces: Vec<Entity> = pieces.iter().copied().filter(there).collect();
    let Some(&first) = pieces.first() else { return };
    let rubble = rubble_of(world, parent).unwrap_or_else(|| begin(world, parent, first));
    let origin = world
        .get::<Transform>(rubble)
        .map_or(Vec3::ZERO, |place| place.translation);
    let mut parts = parts(world, rubble, Vec3::ZERO, Quat::IDENTITY);
    for &piece in &pieces {
        let (Some(&Position(at)), Some(&Rotation(turn))) =
            (world.get::<Position>(piece), world.get::<Rotation>(piece))
        else {
            continue;
        };
        parts.append(&mut self::parts(world, piece, at - origin, turn));
        let place = Transform::from_translation(at - origin).with_rotation(turn);
        merge_faces::<OuterFaces>(world, rubble, piece, place);
        merge_faces::<CrackFaces>(world, rubble, piece, place);
        world.despawn(piece);
    }
    world.entity_mut(rubble).insert(Collider::compound(parts));
}

/// The static body that pieces of a body were merged into before.
fn rubble_of(world: &World, parent: Entity) -> Option<Entity> {
    let mut pieces = world.get::<Fragments>(parent)?.iter();
    pieces.find(|&piece| world.get::<Rubble>(piece).is_some())
}

/// A static body without parts yet, where a piece is, which rubs and collides as that piece.
fn begin(world: &mut World, parent: Entity, first: Entity) -> Entity {
    let at = world.get::<Position>(first).map_or(Vec3::ZERO, |at| at.0);
    let born = world.get::<Born>(first).copied();
    let rubble = world.spawn((
        Rubble,
        FragmentOf(parent),
        RigidBody::Static,
        Transform::from_translation(at),
    ));
    let rubble = rubble.id();
    world
        .entity_mut(first)
        .clone_with_opt_in(rubble, |builder| {
            builder.allow::<Inherited>();
        });
    if let Some(born) = born {
        world.entity_mut(rubble).insert(born);
    }
    rubble
}

/// The parts of an entity's collider, at a place. A compound collider in another one is none that Avian knows.
fn parts(world: &World, entity: Entity, at: Vec3, turn: Quat) -> Parts {
    let Some(collider) = world.get::<Collider>(entity) else {
        return Vec::new();
    };
    let Some(compound) = collider.shape().as_compound() else {
        return vec![(at, turn, collider.clone())];
    };
    let parts = compound.shapes().iter();
    parts
        .map(|(pose, shape)| {
            let local = Vec3::from_array(pose.translation.to_array());
            let turned = turn * Quat::from_array(pose.rotation.to_array());
            (at + turn * local, turned, Collider::from(shape.clone()))
        })
        .collect()
}

/// Adds a piece's faces to those of the static body, those of each material by themselves; the first ones give it their look.
fn merge_faces<F: Component>(world: &mut World, rubble: Entity, piece: Entity, place: Transform) {
    for (new, mesh, material) in faces::<F>(world, piece) {
        let mut known = faces::<F>(world, rubble).into_iter();
        let known = known.find(|(_, _, of)| *of == material);
        let Some(mut meshes) = world.get_resource_mut::<Assets<Mesh>>() else {
            return;
        };
        let Some(mesh) = meshes.get(&mesh) else {
            continue;
        };
        let mesh = mesh.clone().transformed_by(place);
        let (target, merged) = match known {
            Some((target, before, _)) => {
                let merged = meshes.get(&before).cloned().and_then(|mut all| {
                    // All faces of a body have the same attributes.
                    all.merge(&mesh).ok().map(|()| all)
                });
                (Some(target), merged.unwrap_or(mesh))
            }
            None => (None, mesh),
        };
        let handle = Mesh3d(meshes.add(merged));
        let target = target.unwrap_or_else(|| world.entity_mut(new).clone_and_spawn());
        world
            .entity_mut(target)
            .insert((handle, ChildOf(rubble), Transform::IDENTITY))
            .remove::<Aabb>();
    }
}

/// Faces of an entity, with their meshes and materials.
fn faces<F: Component>(
    world: &World,
    of: Entity,
) -> Vec<(Entity, Handle<Mesh>, Option<MaterialOfFile>)> {
    let children = world.get::<Children>(of).into_iter();
    let faces = children.flat_map(|c| c.iter());
    let face = |face: Entity| {
        world.get::<F>(face)?;
        let mesh = world.get::<Mesh3d>(face)?.0.clone();
        Some((face, mesh, world.get::<MaterialOfFile>(face).cloned()))
    };
    faces.filter_map(face).collect()
}
