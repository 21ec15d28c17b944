//! Bodies that break in Avian, without a window.
#![cfg(feature = "avian")]

use std::sync::{Arc, Mutex};
use std::time::Duration;

use avian3d::prelude::*;
use bevy::mesh::MeshPlugin;
use bevy::prelude::*;
use bevy::time::TimeUpdateStrategy;
use bevy_frangible::prelude::*;
use bevy_frangible::{BreakableBody, Broken, CrackFaces, OuterFaces};

const STEP: f64 = 1.0 / 240.0;

/// What happened to bodies.
#[derive(Resource, Clone, Default)]
struct Log(Arc<Mutex<Vec<String>>>);

impl Log {
    fn lines(&self) -> Vec<String> {
        self.0.lock().unwrap().clone()
    }

    fn say(&self, line: String) {
        self.0.lock().unwrap().push(line);
    }
}

/// The bodies of the core's own tests: a pane of glass of 20 cm, a brick, a bar that is held at one end.
fn app() -> (App, Log) {
    let mut app = App::new();
    let bodies = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../crates/frangible/tests/bodies"
    );
    let files = AssetPlugin {
        file_path: bodies.into(),
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
    app.finish();
    app.cleanup();
    (app, log)
}

/// Waits until a body is loaded.
fn ready(app: &mut App, entity: Entity) {
    for _ in 0..2000 {
        app.update();
        if app.world().get::<BreakableBody>(entity).is_some() {
            return;
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    panic!("the body was never ready");
}

fn body(app: &mut App, name: &str, at: Transform) -> Entity {
    let handle = app
        .world()
        .resource::<AssetServer>()
        .load(format!("{name}.frangible"));
    app.world_mut().spawn((Breakable(handle), at)).id()
}

/// A steel ball of 130 g.
fn ball(app: &mut App, at: Vec3, velocity: Vec3) -> Entity {
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
fn motion(app: &mut App) -> (f64, Vec3) {
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

#[test]
fn a_ball_goes_on_through_the_pane_that_it_breaks() {
    let (mut app, log) = app();
    app.insert_resource(Gravity(Vec3::ZERO));
    let pane = body(&mut app, "pane", Transform::default());
    ready(&mut app, pane);
    let ball = ball(&mut app, Vec3::new(0.01, 0.005, 0.1), Vec3::NEG_Z * 12.0);
    app.update();
    let (energy, momentum) = motion(&mut app);
    for _ in 0..60 {
        app.update();
    }
    let lines = log.lines();
    assert!(
        lines.iter().any(|line| line.ends_with("pieces")),
        "{lines:?}"
    );
    let world = app.world();
    assert!(world.get::<Broken>(pane).is_some());
    assert!(world.get::<Collider>(pane).is_none() && world.get::<Mesh3d>(pane).is_none());
    let fragments: Vec<Entity> = world.get::<Fragments>(pane).unwrap().iter().collect();
    assert!(fragments.len() > 3);
    let mut mass = 0.0;
    let (mut outer, mut crack) = (0, 0);
    for &fragment in &fragments {
        assert!(world.get::<Collider>(fragment).is_some());
        mass += world.get::<ComputedMass>(fragment).unwrap().value();
        for &child in world.get::<Children>(fragment).unwrap() {
            outer += usize::from(world.get::<OuterFaces>(child).is_some());
            crack += usize::from(world.get::<CrackFaces>(child).is_some());
        }
    }
    assert!(
        (mass / (0.2 * 0.2 * 0.004 * 2500.0) - 1.0).abs() < 1e-3,
        "{mass} kg"
    );
    assert!(outer >= fragments.len() - 1 && crack == fragments.len());
    let speed = -world.get::<LinearVelocity>(ball).unwrap().z;
    println!(
        "{} pieces, the ball goes on at {speed} m/s",
        fragments.len()
    );
    assert!(speed.abs() < 12.0, "{speed} m/s");
    let (after, then) = motion(&mut app);
    assert!(after <= energy * (1.0 + 1e-3), "{energy} J, then {after} J");
    assert!(
        (then - momentum).length() < 0.02 * momentum.length(),
        "{momentum} {then}"
    );
    // What was the body goes, and its pieces with it.
    app.world_mut().despawn(pane);
    assert!(
        fragments
            .iter()
            .all(|&f| app.world().get_entity(f).is_err())
    );
}

#[test]
fn a_slow_ball_bounces_off_and_is_heard_of() {
    let (mut app, log) = app();
    app.insert_resource(Gravity(Vec3::ZERO));
    let pane = body(&mut app, "pane", Transform::default());
    ready(&mut app, pane);
    ball(&mut app, Vec3::new(0.01, 0.005, 0.03), Vec3::NEG_Z * 0.7);
    for _ in 0..60 {
        app.update();
    }
    assert_eq!(log.lines(), ["held"]);
    assert!(app.world().get::<BreakableBody>(pane).is_some());
}

#[test]
fn what_is_held_stays_where_it_is_held() {
    let (mut app, log) = app();
    let shelf = body(&mut app, "shelf", Transform::default());
    ready(&mut app, shelf);
    assert_eq!(
        app.world().get::<RigidBody>(shelf),
        Some(&RigidBody::Static)
    );
    ball(&mut app, Vec3::new(0.1, 0.0, 0.1), Vec3::NEG_Z * 6.0);
    for _ in 0..60 {
        app.update();
    }
    assert!(
        log.lines().iter().any(|line| line.ends_with("pieces")),
        "{:?}",
        log.lines()
    );
    let world = app.world();
    let kinds: Vec<RigidBody> = (world.get::<Fragments>(shelf).unwrap().iter())
        .map(|f| *world.get::<RigidBody>(f).unwrap())
        .collect();
    assert!(kinds.contains(&RigidBody::Static) && kinds.contains(&RigidBody::Dynamic));
}

#[test]
fn a_script_breaks_a_body_by_one_event() {
    let (mut app, log) = app();
    let pane = body(&mut app, "pane", Transform::from_xyz(0.0, 3.0, 0.0));
    ready(&mut app, pane);
    app.world_mut().trigger(Blow {
        entity: pane,
        at: Vec3::new(0.0, 3.0, 0.0),
        impulse: Vec3::NEG_Z * 2.0,
    });
    app.update();
    assert!(log.lines()[0].ends_with("pieces"), "{:?}", log.lines());
}

#[test]
fn what_cannot_break_says_why_and_nothing_panics() {
    let (mut app, log) = app();
    let missing = body(&mut app, "nothing", Transform::default());
    let scaled = body(&mut app, "block", Transform::from_scale(Vec3::splat(2.0)));
    let gone = body(&mut app, "pane", Transform::from_xyz(9.0, 0.0, 0.0));
    app.world_mut().trigger(Blow {
        entity: missing,
        at: Vec3::ZERO,
        impulse: Vec3::X,
    });
    ready(&mut app, gone);
    for _ in 0..50 {
        app.update();
        std::thread::sleep(Duration::from_millis(2));
    }
    // Despawned in the frame in which it breaks, and hit by what is no number.
    let blow = |entity: Entity, impulse: Vec3| Blow {
        entity,
        at: Vec3::new(9.0, 0.0, 0.0),
        impulse,
    };
    app.world_mut().trigger(blow(gone, Vec3::splat(f32::NAN)));
    app.world_mut()
        .commands()
        .trigger(blow(gone, Vec3::Z * 3.0));
    app.world_mut().commands().entity(gone).despawn();
    app.update();
    let lines = log.lines();
    let said = |words: &str| lines.iter().any(|line| line.contains(words));
    assert!(said("not loaded yet"), "{lines:?}");
    assert!(said("nothing.frangible"), "{lines:?}");
    assert!(said("scaled by"), "{lines:?}");
    assert!(said("finite"), "{lines:?}");
    let _ = scaled;
    for _ in 0..5 {
        app.update();
    }
    let mut left = app.world_mut().query::<&FragmentOf>();
    assert_eq!(
        left.iter(app.world()).count(),
        0,
        "no pieces of what is gone"
    );
}

/// The ball's velocity after the pane, m/s, in a Rapier world of `frangible-rapier` with the same body, seed and throw (its `Ball` of
/// 129.7 g and 15.8 mm at (0.01, 0.005, 0.1) m, steel; seeds 0 to 7).
const IN_RAPIER: [f32; 8] = [2.457, -4.184, 1.505, 2.230, 2.224, 2.248, 2.236, 2.390];

#[test]
fn a_throw_ends_in_avian_as_it_does_in_rapier() {
    let mut sums = [0.0_f32; 2];
    for (seed, rapier) in (0..).zip(IN_RAPIER) {
        let (mut app, log) = app();
        app.insert_resource(Gravity(Vec3::ZERO));
        let pane = body(&mut app, "pane", Transform::default());
        app.world_mut().entity_mut(pane).insert(Seed(seed));
        ready(&mut app, pane);
        let ball = ball(&mut app, Vec3::new(0.01, 0.005, 0.1), Vec3::NEG_Z * 12.0);
        for _ in 0..60 {
            app.update();
        }
        let avian = app.world().get::<LinearVelocity>(ball).unwrap().z;
        println!(
            "seed {seed}: {:?}, {avian:.3} m/s; in Rapier {rapier:.3} m/s",
            log.lines()
        );
        sums[0] += avian + 12.0;
        sums[1] += rapier + 12.0;
    }
    assert!((sums[0] / sums[1] - 1.0).abs() < 0.05, "{sums:?}");
}
