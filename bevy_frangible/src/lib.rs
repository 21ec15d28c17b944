//! Bodies that break for physical reasons, in Bevy.
//!
//! A body is baked once, outside the game, into a `.frangible` file. In the game it is an entity with [`Breakable`]: when it is hit hard
//! enough its entity loses its collider and mesh, and fragments appear as entities of their own, each with a mesh of its outer and
//! one of its crack faces.
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
//! - Without an engine: the asset and its loader, [`Breakable`], [`Blow`] to send, [`Broke`], [`Held`] and [`BreakFailed`] to observe,
//!   fragments with meshes and the relationship [`FragmentOf`]; [`BreakAgain`] for fragments that break again, [`DebrisBudget`] for how many
//!   there may be.
//! - Feature `avian` (default): colliders and masses, bodies that break inside the physics step, by collision hooks, and under what
//!   they carry.
//! - Feature `sound`: what breaks is heard where an entity has `Ears`, as samples in a queue.
//!
//! # Limits
//! A body that breaks in a step of Avian is judged pair by pair: each striker alone, and without friction. A uniform scale of the entity
//! counts as it is when its asset is there; one that is not uniform is refused. Without a model in [`BreakAgain`] fragments are plain bodies.

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
pub use looks::{Looks, LooksPlugin};
#[cfg(feature = "rapier")]
pub use rapier::{FrangibleRapierPlugin, RapierBody, RapierWorld};
#[cfg(feature = "sound")]
pub use sound::{Ears, FrangibleSoundPlugin, Heard};

/// Types that most games use.
pub mod prelude {
    pub use crate::{
        AtRest, Blow, BreakAgain, BreakFailed, Breakable, Broke, DebrisBudget, FragmentOf,
        Fragments, FrangibleAsset, FrangiblePlugin, Held, Looks, LooksPlugin, Seed,
    };
    #[cfg(feature = "avian")]
    pub use crate::{Breaking, ColliderDetail, FrangibleHooks, MadeOf};
}

/// Lets entities with [`Breakable`] break.
#[derive(Default)]
pub struct FrangiblePlugin {
    /// Switches and numbers of the fracture.
    pub config: FractureConfig,
}

/// Switches and numbers of the fracture, as the plugin was given them; may be changed between steps.
#[derive(Resource, Clone, Default)]
pub struct Fracturing(pub FractureConfig);

/// An entity that can break, and the baked body that it is. Its [`Transform`] places the body's centre of mass.
#[derive(Component, Clone, Debug)]
#[require(Transform, Visibility, Seed)]
pub struct Breakable(pub Handle<FrangibleAsset>);

/// Seed of a body's random properties. Bodies of one asset break differently with different seeds, and alike with equal ones.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Seed(pub u64);

/// The body of a [`Breakable`] whose asset is loaded, with the cracks that it has so far.
#[derive(Component, Clone)]
pub struct BreakableBody(pub Body);

/// An entity that was broken; its [`Fragments`] are in its place.
#[derive(Component, Clone, Copy, Debug)]
pub struct Broken;

/// A piece of an entity that broke. Its [`Transform`] places the piece's centre of mass.
#[derive(Component, Clone, Copy, Debug)]
#[relationship(relationship_target = Fragments)]
#[require(Transform, Visibility)]
pub struct FragmentOf(pub Entity);

/// Pieces of one body that came to rest, as one static body: see [`AtRest::Merge`].
#[derive(Component, Clone, Copy, Debug)]
pub struct Rubble;

/// The pieces of an entity that broke, largest first. They go when it is despawned.
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

/// The part of a mesh that was the body's surface. It is a child of the fragment.
#[derive(Component, Clone, Copy, Debug)]
pub struct OuterFaces;

/// The part of a mesh where the body broke. It is a child of the fragment.
#[derive(Component, Clone, Copy, Debug)]
pub struct CrackFaces;

/// Breaks a body by script: an impulse at a point, as if a rigid thing of 1 cm radius had struck there.
#[derive(EntityEvent, Clone, Copy, Debug)]
pub struct Blow {
    /// The body.
    pub entity: Entity,
    /// Point of contact, m, world coordinates.
    pub at: Vec3,
    /// Impulse, N·s, world coordinates.
    pub impulse: Vec3,
}

/// A [`Blow`] gives this to the body that held, or to the piece that was struck: an engine moves it.
#[derive(EntityEvent, Clone, Copy, Debug)]
pub struct Pushed {
    /// Body or piece that is pushed.
    pub entity: Entity,
    /// Point of the push, m, world coordinates.
    pub at: Vec3,
    /// Impulse, N·s, world coordinates.
    pub impulse: Vec3,
}

/// A body broke.
#[derive(EntityEvent, Clone)]
pub struct Broke {
    /// The body: it is there still, [`Broken`], without collider and mesh.
    pub entity: Entity,
    /// Its pieces, largest first.
    pub fragments: Vec<Entity>,
    /// Meshes, masses and how the break came about.
    pub fracture: Arc<Fracture>,
}

/// A body was hit and held.
#[derive(EntityEvent, Clone)]
pub struct Held {
    /// The body.
    pub entity: Entity,
    /// Strength over the stress, or over a bound of it.
    pub margin: f64,
    /// Extent of the analysis, and its results.
    pub report: ImpactReport,
}

/// Something that should have broken cannot: a file that is no baked body, an entity that is not scaled uniformly, a blow that is not finite.
#[derive(EntityEvent, Clone, Debug)]
pub struct BreakFailed {
    /// The body.
    pub entity: Entity,
    /// The problem and its remedy.
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
    app.insert_resource(Fracturing(config.clone()))
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
