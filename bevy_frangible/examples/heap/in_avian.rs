//! The heap in Bevy and Avian.

use std::time::Duration;

use avian3d::prelude::*;
use bevy::mesh::MeshPlugin;
use bevy::prelude::*;
use bevy::time::TimeUpdateStrategy;
use bevy_frangible::Broken;
use bevy_frangible::frangible::glam;
use bevy_frangible::prelude::*;

use super::{DUST, Heap, RATE};

pub struct InAvian {
    app: App,
    bowl: Handle<FrangibleAsset>,
}

/// An empty floor.
pub fn new(bowl: &FrangibleAsset, merge: bool) -> InAvian {
    let mut app = App::new();
    let step = Duration::from_secs_f32(1.0 / RATE);
    app.add_plugins((MinimalPlugins, AssetPlugin::default()))
        .add_plugins((TransformPlugin, MeshPlugin))
        .add_plugins(PhysicsPlugins::default().with_collision_hooks::<FrangibleHooks>())
        .add_plugins(FrangiblePlugin::default())
        .insert_resource(TimeUpdateStrategy::ManualDuration(step))
        .insert_resource(Time::<Fixed>::from_duration(step))
        .insert_resource(Breaking::for_games())
        .insert_resource(ColliderDetail {
            whole: (1, 32),
            hull_volume_ratio: 3.0,
            ..ColliderDetail::default()
        })
        .insert_resource(DebrisBudget {
            dust_mass: DUST,
            at_rest: if merge { AtRest::Merge } else { AtRest::Sleep },
            rest_time: Duration::from_secs(1),
            ..DebrisBudget::default()
        });
    app.finish();
    app.cleanup();
    let floor = (RigidBody::Static, Collider::half_space(Vec3::Y));
    app.world_mut().spawn(floor);
    let mut assets = app.world_mut().resource_mut::<Assets<FrangibleAsset>>();
    let bowl = assets.add(bowl.clone());
    InAvian { app, bowl }
}

impl Heap for InAvian {
    fn drop(&mut self, number: usize, at: glam::Vec3, turn: glam::Quat) {
        let place = Transform::from_translation(Vec3::from_array(at.to_array()))
            .with_rotation(Quat::from_array(turn.to_array()));
        let bowl = (Breakable(self.bowl.clone()), Seed(number as u64), place);
        self.app.world_mut().spawn(bowl);
    }

    fn step(&mut self) {
        self.app.update();
    }

    fn pieces(&mut self) -> (usize, usize) {
        let world = self.app.world_mut();
        let mut pieces = world
            .query_filtered::<Has<Sleeping>, (With<FragmentOf>, With<Collider>, Without<Broken>)>();
        let asleep: Vec<bool> = pieces.iter(world).collect();
        (
            asleep.len(),
            asleep.iter().filter(|asleep| !**asleep).count(),
        )
    }
}
