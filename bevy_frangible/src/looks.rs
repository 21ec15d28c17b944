//! Materials, or any other component, for the former surface of a body and for its crack faces.

use bevy::prelude::*;

use crate::{BreakableBody, Broke, CrackFaces, FragmentOf, OuterFaces};

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

/// Plugin that applies [`Looks`] of a component to bodies and fragments.
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
    looks: Query<&Looks<C>, Without<FragmentOf>>,
    mut commands: Commands,
) {
    if let Ok(looks) = looks.get(ready.entity) {
        commands.entity(ready.entity).insert(looks.outer.clone());
    }
}

/// Fragments get the looks of their body, and keep them for their own fragments.
fn dress_fragments<C: Component + Clone>(
    broke: On<Broke>,
    looks: Query<&Looks<C>>,
    children: Query<&Children>,
    (outer, crack): (Query<(), With<OuterFaces>>, Query<(), With<CrackFaces>>),
    mut commands: Commands,
) {
    let Ok(looks) = looks.get(broke.entity) else {
        return;
    };
    for &fragment in &broke.fragments {
        commands.entity(fragment).try_insert(looks.clone());
        for child in children.iter_descendants(fragment) {
            if outer.contains(child) {
                commands.entity(child).try_insert(looks.outer.clone());
            } else if crack.contains(child) {
                commands.entity(child).try_insert(looks.crack.clone());
            }
        }
    }
}
