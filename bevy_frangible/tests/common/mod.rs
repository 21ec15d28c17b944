//! A Bevy app without a window, bodies and balls.
#![allow(dead_code, reason = "without sound and gizmos some of it is not used")]

use std::path::PathBuf;
use std::sync::{Arc, Mutex};
use std::time::Duration;

use avian3d::prelude::*;
use bevy::mesh::MeshPlugin;
use bevy::prelude::*;
use bevy::time::TimeUpdateStrategy;
use bevy_frangible::BreakableBody;
use bevy_frangible::prelude::*;

pub const STEP: f64 = 1.0 / 240.0;

/// Events of bodies.
#[derive(Resource, Clone, Default)]
pub struct Log(Arc<Mutex<Vec<String>>>);

impl Log {
    pub fn lines(&self) -> Vec<String> {
        self.0.lock().unwrap().clone()
    }

    pub fn say(&self, line: String) {
        self.0.lock().unwrap().push(line);
    }
}

/// The bodies of the core's own tests: a pane of glass of 20 cm, a brick, a bar that is held at one end.
pub fn app() -> (App, Log) {
    app_in(bodies())
}

/// Folder of the bodies' files.
pub fn bodies() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../crates/frangible/tests/bodies")
}

/// With the files of another folder.
pub fn app_in(folder: PathBuf) -> (App, Log) {
    app_with(folder, |_| {})
}

/// With the files of another folder and more plugins.
pub fn app_with(folder: PathBuf, more: impl FnOnce(&mut App)) -> (App, Log) {
    let mut app = App::new();
    let files = AssetPlugin {
        file_path: folder.to_string_lossy().into_owned(),
        ..AssetPlugin::default()
    };
    let log = Log::default();
    app.add_plugins((MinimalPlugins, files, TransformPlugin, MeshPlugin))
        .add_plugins(PhysicsPlugins::default().with_collision_hooks::<FrangibleHooks>())
        .add_plugins(FrangiblePlugin::default())
        .insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_secs_f64(
            STEP,
        )))
        .insert_resource(Time::<Fixed>::from_seconds(STEP))
        .insert_resource(log.clone())
        .add_observer(|broke: On<Broke>, log: Res<Log>| {
            log.say(format!("{} pieces", broke.fragments.len()));
        })
        .add_observer(|_: On<Held>, log: Res<Log>| log.say("held".into()))
        .add_observer(|failed: On<BreakFailed>, log: Res<Log>| log.say(failed.reason.clone()));
    more(&mut app);
    app.finish();
    app.cleanup();
    (app, log)
}

/// Waits until a body is loaded.
pub fn ready(app: &mut App, entity: Entity) {
    for _ in 0..2000 {
        app.update();
        if app.world().get::<BreakableBody>(entity).is_some() {
            return;
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    panic!("the body was never ready");
}

pub fn body(app: &mut App, name: &str, at: Transform) -> Entity {
    let handle = app
        .world()
        .resource::<AssetServer>()
        .load(format!("{name}.frangible"));
    app.world_mut().spawn((Breakable(handle), at)).id()
}

/// A steel ball of 130 g.
pub fn ball(app: &mut App, at: Vec3, velocity: Vec3) -> Entity {
    let radius = 0.0158;
    let steel = frangible::Material::preset("steel").unwrap();
    app.world_mut()
        .spawn((
            RigidBody::Dynamic,
            Collider::sphere(radius),
            ColliderDensity(steel.density as f32),
            Restitution::new(0.5),
            MadeOf(steel),
            SweptCcd::default(),
            Transform::from_translation(at),
            LinearVelocity(velocity),
        ))
        .id()
}

/// Kinetic energy, J, and momentum, kg m/s, of all that moves.
pub fn motion(app: &mut App) -> (f64, Vec3) {
    let world = app.world_mut();
    let mut bodies = world.query::<(
        &RigidBody,
        &LinearVelocity,
        &AngularVelocity,
        &ComputedMass,
        &ComputedAngularInertia,
        &Rotation,
    )>();
    let (mut energy, mut momentum) = (0.0, Vec3::ZERO);
    for (kind, linear, angular, mass, inertia, rotation) in bodies.iter(world) {
        if kind.is_dynamic() {
            let spin = angular
                .0
                .dot(inertia.rotated(rotation.0).tensor() * angular.0);
            energy += 0.5 * f64::from(mass.value() * linear.0.length_squared() + spin);
            momentum += mass.value() * linear.0;
        }
    }
    (energy, momentum)
}
