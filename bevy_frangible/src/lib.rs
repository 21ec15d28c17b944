//! Physically based brittle fracture for Bevy.
//!
//! A body is baked once, outside the game, into a `.frangible` file. In the game it is an entity with [`Breakable`]: if it is hit hard
//! enough, its entity loses collider and mesh, and fragments appear as separate entities, each with a mesh for its outer faces and one
//! for its crack faces.
//!
//! ```no_run
//! use bevy::prelude::*;
//! use bevy_frangible::prelude::*;
//! # #[cfg(feature = "avian")]
//! # {
//! use avian3d::prelude::*;
//!
//! App::new()
//!     .add_plugins((MinimalPlugins, AssetPlugin::default(), TransformPlugin, MeshPlugin))
//!     .add_plugins(PhysicsPlugins::default().with_collision_hooks::<FrangibleHooks>())
//!     .add_plugins(FrangiblePlugin::default())
//!     .add_systems(Startup, |mut commands: Commands, assets: Res<AssetServer>| {
//!         commands.spawn((RigidBody::Static, Collider::half_space(Vec3::Y)));
//!         let place = Transform::from_xyz(0.0, 3.0, 0.0).with_rotation(Quat::from_rotation_x(1.0));
//!         let glass = (Breakable(assets.load("glass.frangible")), place);
//!         commands.spawn(glass).observe(|broke: On<Broke>| println!("{} pieces", broke.fragments.len()));
//!     })
//!     .run();
//! # use bevy::mesh::MeshPlugin;
//! # }
//! ```
//!
//! # Layers
//! - Independent of a physics engine: the asset and its loader, [`Breakable`], the event [`Blow`] to send, the events [`Broke`], [`Held`] and
//!   [`BreakFailed`] to observe, fragments with meshes and the relationship [`FragmentOf`], [`BreakAgain`] for fragments that break again, and
//!   [`DebrisBudget`] for their number.
//! - Feature `avian` (default): colliders and masses, breaks inside the physics step by collision hooks, and breaks under sustained loads.
//! - Feature `sound`: the sound of breaking bodies at an entity with `Ears`, as a queue of samples.
//!
//! # Limits
//! In a step of Avian, contacts are tested pair by pair: each striker separately, and without friction. The scale of an entity is read when its
//! asset is loaded, and must be uniform. Without a model in [`BreakAgain`], fragments are plain bodies.

mod again;
#[cfg(feature = "avian")]
mod avian;
mod break_apart;
mod debris;
mod file;
#[cfg(feature = "gizmos")]
mod gizmos;
mod looks;
mod meshes;
mod per_asset;
#[cfg(feature = "rapier")]
mod rapier;
mod ready;
#[cfg(feature = "sound")]
mod sound;
mod threads;
mod work;

use std::sync::Arc;
use std::time::Duration;

use bevy::prelude::*;
use frangible::{Body, Fracture, FractureConfig, ImpactReport};

pub use again::BreakAgain;
#[cfg(feature = "avian")]
pub use avian::{Breaking, Carries, ColliderDetail, FrangibleHooks, ImpactSpeed, MadeOf};
pub use debris::{AtRest, DebrisBudget};
pub use file::{FrangibleAsset, FrangibleLoader, LoadError};
pub use frangible;
#[cfg(feature = "rapier")]
pub use frangible_rapier;
#[cfg(feature = "sound")]
pub use frangible_sound;
#[cfg(feature = "gizmos")]
pub use gizmos::{FrangibleGizmos, FrangibleGizmosPlugin, LastBlow};
pub use looks::{Looks, LooksOfFile, LooksPlugin};
#[cfg(feature = "rapier")]
pub use rapier::{FrangibleRapierPlugin, RapierBody, RapierWorld};
#[cfg(feature = "sound")]
pub use sound::{Ears, FrangibleSoundPlugin, Heard};

/// Types that most games use.
pub mod prelude {
    pub use crate::{
        AtRest, Blow, BreakAgain, BreakFailed, Breakable, Broke, DebrisBudget, FragmentOf,
        Fragments, FrangibleAsset, FrangiblePlugin, Held, Looks, LooksOfFile, LooksPlugin, Seed,
    };
    #[cfg(feature = "avian")]
    pub use crate::{Breaking, ColliderDetail, FrangibleHooks, MadeOf};
}

/// Plugin that lets entities with [`Breakable`] break.
#[derive(Default)]
pub struct FrangiblePlugin {
    /// Settings of the fracture model.
    pub config: FractureConfig,
}

/// Settings of the fracture model, initially those of the plugin; may be changed between steps.
#[derive(Resource, Clone, Default)]
pub struct Fracturing(pub FractureConfig);

/// Component of a breakable entity: the handle of its baked body. The [`Transform`] is that of the body's centre of mass.
#[derive(Component, Clone, Debug)]
#[require(Transform, Visibility, Seed)]
pub struct Breakable(pub Handle<FrangibleAsset>);

/// Component with the random seed of a body. Bodies of the same asset break differently with different seeds, and alike with equal ones.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Seed(pub u64);

/// Component with the body of a [`Breakable`] whose asset is loaded, including its current cracks.
#[derive(Component, Clone)]
pub struct BreakableBody(pub Body);

/// Marker of an entity that broke; its [`Fragments`] replace it.
#[derive(Component, Clone, Copy, Debug)]
pub struct Broken;

/// Relationship of a fragment to the entity that broke. The fragment's [`Transform`] is that of its centre of mass.
#[derive(Component, Clone, Copy, Debug)]
#[relationship(relationship_target = Fragments)]
#[require(Transform, Visibility)]
pub struct FragmentOf(pub Entity);

/// Marker of a static body of merged pieces at rest: see [`AtRest::Merge`].
#[derive(Component, Clone, Copy, Debug)]
pub struct Rubble;

/// The fragments of an entity that broke, largest first. They are despawned with it.
#[derive(Component, Debug)]
#[relationship_target(relationship = FragmentOf, linked_spawn)]
pub struct Fragments(Vec<Entity>);

impl Fragments {
    /// The pieces, largest first.
    pub fn iter(&self) -> impl Iterator<Item = Entity> + '_ {
        self.0.iter().copied()
    }
}

/// Time at which a piece was born, in the time of the fixed steps.
#[derive(Component, Clone, Copy)]
pub(crate) struct Born(pub(crate) Duration);

/// Marker of a mesh of a fragment's outer faces, a child of the fragment: one, or one for each material of the body's file. Meshes have the vertex
/// colours and the first two sets of texture coordinates of the file.
#[derive(Component, Clone, Copy, Debug)]
pub struct OuterFaces;

/// Component of [`OuterFaces`] if the body's file has several materials: the one of these faces. Their entity also has its [`Name`].
#[derive(Component, Clone, Debug, PartialEq, Eq)]
pub struct MaterialOfFile {
    /// Index into [`FrangibleAsset::materials`].
    pub index: usize,
    /// Name in the file, which may be empty.
    pub name: String,
}

/// Marker of a body whose outer surface becomes a child with [`OuterFaces`] for each material of its file, in place of one mesh on its entity.
/// [`LooksOfFile`] adds it.
#[derive(Component, Clone, Copy, Debug, Default)]
pub struct SplitByMaterial;

/// Marker of the mesh of a fragment's crack faces, a child of the fragment.
#[derive(Component, Clone, Copy, Debug)]
pub struct CrackFaces;

/// Event to send: a scripted blow on a body, an impulse at a point as from a rigid striker of 1 cm radius.
#[derive(EntityEvent, Clone, Copy, Debug)]
pub struct Blow {
    /// The body.
    pub entity: Entity,
    /// Point of contact, m, world coordinates.
    pub at: Vec3,
    /// Impulse, N·s, world coordinates.
    pub impulse: Vec3,
}

/// Event: the push of a [`Blow`] on the body that held, or on the piece that was hit, for the physics engine to apply.
#[derive(EntityEvent, Clone, Copy, Debug)]
pub struct Pushed {
    /// Body or piece that is pushed.
    pub entity: Entity,
    /// Point of the push, m, world coordinates.
    pub at: Vec3,
    /// Impulse, N·s, world coordinates.
    pub impulse: Vec3,
}

/// Event: a body broke.
#[derive(EntityEvent, Clone)]
pub struct Broke {
    /// The body, which still exists, [`Broken`], without collider and mesh.
    pub entity: Entity,
    /// Its pieces, largest first.
    pub fragments: Vec<Entity>,
    /// Meshes and masses of the pieces, and the report of the impact.
    pub fracture: Arc<Fracture>,
}

/// Event: a body was hit and did not break.
#[derive(EntityEvent, Clone)]
pub struct Held {
    /// The body.
    pub entity: Entity,
    /// Strength over the stress, or over an upper bound of it.
    pub margin: f64,
    /// Report of the impact.
    pub report: ImpactReport,
}

/// Event: a body cannot break, for example because its file is not a baked body, its entity is not scaled uniformly, or a blow is not finite.
#[derive(EntityEvent, Clone, Debug)]
pub struct BreakFailed {
    /// The body.
    pub entity: Entity,
    /// Message that describes the problem and how to fix it.
    pub reason: String,
}

/// Judge of a script's blow.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Judges {
    /// The plugin itself.
    #[default]
    Here,
    /// The world of Rapier.
    #[cfg(feature = "rapier")]
    Rapier,
}

impl Plugin for FrangiblePlugin {
    fn build(&self, app: &mut App) {
        build(app, &self.config);
        #[cfg(feature = "avian")]
        avian::build(app);
    }
}

/// Adds the parts that every engine needs.
fn build(app: &mut App, config: &FractureConfig) {
    let mut config = config.clone();
    if !config.threads.are_lent() {
        config.threads = threads::lent();
    }
    app.insert_resource(Fracturing(config))
        .init_resource::<BreakAgain>()
        .init_resource::<DebrisBudget>()
        .init_resource::<Judges>()
        .init_resource::<again::Nursery>()
        .init_resource::<debris::Heap>()
        .init_asset::<FrangibleAsset>()
        .register_asset_loader(FrangibleLoader)
        .add_systems(PreUpdate, ready::make_ready)
        .add_systems(
            FixedPreUpdate,
            (again::join, debris::clear_up, debris::fade).chain(),
        )
        .add_observer(break_apart::obey);
}
