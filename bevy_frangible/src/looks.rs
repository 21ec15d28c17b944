//! Materials, or any other component, for the former surface of a body and for its crack faces.

use bevy::prelude::*;

use crate::{
    BreakableBody, Broke, CrackFaces, FragmentOf, MaterialOfFile, OuterFaces, SplitByMaterial,
};

/// Component with the appearance of a body and of the outer and crack faces of its fragments, usually a material:
/// `Looks<MeshMaterial3d<StandardMaterial>>`. Insert it on the entity with [`Breakable`](crate::Breakable), and add a [`LooksPlugin`] for the
/// same component.
#[derive(Component, Clone, Debug)]
pub struct Looks<C: Component + Clone> {
    /// Appearance of the outer faces.
    pub outer: C,
    /// Appearance of the crack faces.
    pub crack: C,
}

/// Component with an appearance for each material of the body's file, in the order of
/// [`FrangibleAsset::materials`](crate::FrangibleAsset::materials): `LooksOfFile(vec![MeshMaterial3d(glaze), MeshMaterial3d(clay)])`. The faces of
/// materials beyond the list have the outer look of [`Looks`], and so have all faces of a file with fewer than two materials.
#[derive(Component, Clone, Debug)]
#[require(SplitByMaterial)]
pub struct LooksOfFile<C: Component + Clone>(pub Vec<C>);

/// Plugin that applies [`Looks`] and [`LooksOfFile`] of a component to bodies and fragments.
pub struct LooksPlugin<C>(std::marker::PhantomData<fn() -> C>);

impl<C> Default for LooksPlugin<C> {
    fn default() -> Self {
        Self(std::marker::PhantomData)
    }
}

impl<C: Component + Clone> Plugin for LooksPlugin<C> {
    fn build(&self, app: &mut App) {
        app.add_observer(dress_body::<C>)
            .add_observer(dress_fragments::<C>);
    }
}

/// A body gets the look of its outer faces.
fn dress_body<C: Component + Clone>(
    ready: On<Insert, BreakableBody>,
    looks: Query<(&Looks<C>, Option<&LooksOfFile<C>>), Without<FragmentOf>>,
    mut commands: Commands,
) {
    let entity = ready.entity;
    let Ok((looks, of_file)) = looks.get(entity) else {
        return;
    };
    commands.entity(entity).insert(looks.outer.clone());
    let (looks, of_file) = (looks.clone(), of_file.cloned());
    // Its faces come with its body.
    commands.queue(move |world: &mut World| {
        let children = world.get::<Children>(entity);
        let children: Vec<Entity> = children.into_iter().flat_map(|c| c.iter()).collect();
        for child in children {
            if world.get::<OuterFaces>(child).is_some() {
                let material = world.get::<MaterialOfFile>(child);
                let look = outer(&looks, of_file.as_ref(), material);
                world.entity_mut(child).insert(look);
            }
        }
    });
}

/// The look of outer faces of this material.
fn outer<C: Component + Clone>(
    looks: &Looks<C>,
    of_file: Option<&LooksOfFile<C>>,
    material: Option<&MaterialOfFile>,
) -> C {
    let own = of_file.zip(material);
    let own = own.and_then(|(looks, material)| looks.0.get(material.index));
    own.unwrap_or(&looks.outer).clone()
}

/// Fragments get the looks of their body, and keep them for their own fragments.
fn dress_fragments<C: Component + Clone>(
    broke: On<Broke>,
    looks: Query<(&Looks<C>, Option<&LooksOfFile<C>>)>,
    children: Query<&Children>,
    (outside, crack): (
        Query<Option<&MaterialOfFile>, With<OuterFaces>>,
        Query<(), With<CrackFaces>>,
    ),
    mut commands: Commands,
) {
    let Ok((looks, of_file)) = looks.get(broke.entity) else {
        return;
    };
    for &fragment in &broke.fragments {
        let mut piece = commands.entity(fragment);
        piece.try_insert(looks.clone());
        if let Some(of_file) = of_file {
            piece.try_insert(of_file.clone());
        }
        for child in children.iter_descendants(fragment) {
            if let Ok(material) = outside.get(child) {
                let look = outer(looks, of_file, material);
                commands.entity(child).try_insert(look);
            } else if crack.contains(child) {
                commands.entity(child).try_insert(looks.crack.clone());
            }
        }
    }
}
