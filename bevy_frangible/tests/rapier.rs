//! Bodies that break in a world of Rapier, without a window.

use std::time::Duration;

use bevy::mesh::MeshPlugin;
use bevy::prelude::*;
use bevy::time::TimeUpdateStrategy;
use bevy_frangible::frangible_rapier::rapier3d::math::{Pose, Vector};
use bevy_frangible::frangible_rapier::{Ball, SurfaceProperties, WorldConfig};
use bevy_frangible::prelude::*;
use bevy_frangible::{BreakableBody, Broken, CrackFaces, FrangibleRapierPlugin};
use bevy_frangible::{RapierBody, RapierWorld};

/// Events so far.
#[derive(Resource, Default)]
struct Log(Vec<String>);

/// A pane in a world without gravity, 240 steps per second.
fn app() -> (App, Entity) {
    let mut app = App::new();
    let files = AssetPlugin {
        file_path: concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../crates/frangible/tests/bodies"
        )
        .into(),
        ..AssetPlugin::default()
    };
    let step = Duration::from_secs_f64(1.0 / 240.0);
    app.add_plugins((MinimalPlugins, files, TransformPlugin, MeshPlugin))
        .add_plugins(FrangibleRapierPlugin(WorldConfig::plain()))
        .insert_resource(TimeUpdateStrategy::ManualDuration(step))
        .insert_resource(Time::<Fixed>::from_duration(step))
        .init_resource::<Log>()
        .add_observer(|broke: On<Broke>, mut log: ResMut<Log>| {
            log.0.push(format!("{} pieces", broke.fragments.len()));
        })
        .add_observer(|_: On<Held>, mut log: ResMut<Log>| log.0.push("held".into()))
        .add_observer(|failed: On<BreakFailed>, mut log: ResMut<Log>| {
            log.0.push(failed.reason.clone());
        });
    app.finish();
    app.cleanup();
    app.world_mut()
        .resource_mut::<RapierWorld>()
        .0
        .physics
        .gravity = Vector::ZERO;
    let handle = app.world().resource::<AssetServer>().load("pane.frangible");
    let pane = (Breakable(handle), Transform::from_xyz(0.0, 2.0, 0.0));
    let pane = app.world_mut().spawn(pane).id();
    for _ in 0..2000 {
        app.update();
        if app.world().get::<RapierBody>(pane).is_some() {
            return (app, pane);
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    panic!("the pane was never ready");
}

/// Throws a ball of steel at the pane; its entity.
fn throw(app: &mut App, speed: f32) -> Entity {
    let mut world = app.world_mut().resource_mut::<RapierWorld>();
    let ball = Ball {
        mass: 0.13,
        radius: 0.0158,
    };
    let place = Pose::translation(0.01, 2.005, 0.1);
    let ball = world
        .0
        .insert_ball(ball, SurfaceProperties::STEEL, place, Vector::NEG_Z * speed)
        .unwrap();
    app.world_mut().spawn(RapierBody(ball)).id()
}

fn update(app: &mut App, count: usize) {
    for _ in 0..count {
        app.update();
    }
}

#[test]
fn a_ball_breaks_a_pane_and_transforms_follow() {
    let (mut app, pane) = app();
    let ball = throw(&mut app, 12.0);
    update(&mut app, 60);
    let log = &app.world().resource::<Log>().0;
    assert!(log.iter().any(|line| line.ends_with("pieces")), "{log:?}");
    let world = app.world();
    assert!(world.get::<Broken>(pane).is_some() && world.get::<RapierBody>(pane).is_none());
    let fragments: Vec<Entity> = world.get::<Fragments>(pane).unwrap().iter().collect();
    let bodies = &world.resource::<RapierWorld>().0.physics.bodies;
    assert_eq!(bodies.len(), fragments.len() + 1);
    for &entity in fragments.iter().chain([&ball]) {
        let body = &bodies[world.get::<RapierBody>(entity).unwrap().0];
        let place = world.get::<Transform>(entity).unwrap().translation;
        assert_eq!(body.translation().to_array(), place.to_array());
    }
    let faces = fragments
        .iter()
        .flat_map(|&f| world.get::<Children>(f).unwrap());
    assert!(
        faces
            .into_iter()
            .any(|&child| world.get::<CrackFaces>(child).is_some())
    );
    // The broken body goes, and its pieces with it, here and in the world.
    app.world_mut().despawn(pane);
    let left = app.world().resource::<RapierWorld>().0.physics.bodies.len();
    assert_eq!(left, 1, "the ball");
}

#[test]
fn a_slow_ball_is_heard_of() {
    let (mut app, pane) = app();
    throw(&mut app, 0.9);
    update(&mut app, 60);
    let log = &app.world().resource::<Log>().0;
    assert!(
        !log.is_empty() && log.iter().all(|line| line == "held"),
        "{log:?}"
    );
    assert!(app.world().get::<BreakableBody>(pane).is_some());
}

#[test]
fn a_script_breaks_a_body_and_what_cannot_be_is_told() {
    let (mut app, pane) = app();
    let blow = |entity: Entity| Blow {
        entity,
        at: Vec3::new(0.0, 2.0, 0.0),
        impulse: Vec3::NEG_Z * 2.0,
    };
    app.world_mut().trigger(blow(pane));
    update(&mut app, 2);
    assert!(app.world().get::<Broken>(pane).is_some());
    app.world_mut().trigger(blow(pane));
    update(&mut app, 1);
    let log = &app.world().resource::<Log>().0;
    assert!(
        log[0].ends_with("pieces") && log[1].contains("RapierBody"),
        "{log:?}"
    );
}

#[test]
fn a_body_that_is_removed_takes_its_entity_with_it() {
    let (mut app, pane) = app();
    let handle = app.world().get::<RapierBody>(pane).unwrap().0;
    let mut world = app.world_mut().resource_mut::<RapierWorld>();
    world.0.physics.remove_body(handle);
    update(&mut app, 2);
    assert!(app.world().get_entity(pane).is_err());
}
