//! A scene in Bevy and Avian.

use std::sync::Arc;
use std::time::Duration;

use avian3d::prelude::*;
use bevy::mesh::MeshPlugin;
use bevy::prelude::*;
use bevy::time::TimeUpdateStrategy;
use bevy_frangible::BreakableBody;
use bevy_frangible::frangible::glam::{self, DVec3};
use bevy_frangible::frangible::{Fracture, Material};
use bevy_frangible::prelude::*;

use super::scenes::{Break, GRAVITY, Outcome, Scene, Solid, Start, Striker};

/// The first break.
#[derive(Resource, Default)]
struct First(Option<Arc<Fracture>>);

fn out(v: glam::Vec3) -> Vec3 {
    Vec3::from_array(v.to_array())
}

fn place(start: &Start) -> (Transform, LinearVelocity) {
    let turn = Quat::from_array(start.turn.to_array());
    (
        Transform::from_translation(out(start.at)).with_rotation(turn),
        LinearVelocity(out(start.velocity)),
    )
}

fn surface(material: &Material) -> impl Bundle {
    (
        Friction::new(material.friction as f32),
        Restitution::new(material.restitution as f32),
        MadeOf(material.clone()),
    )
}

/// Kinetic energy, J, and momentum, N·s, of all that moves.
fn motion(app: &mut App) -> (f64, DVec3) {
    let world = app.world_mut();
    let mut bodies = world.query::<(
        &RigidBody,
        &Rotation,
        (&LinearVelocity, &AngularVelocity),
        (&ComputedMass, &ComputedAngularInertia),
    )>();
    let (mut energy, mut momentum) = (0.0, DVec3::ZERO);
    let moving = bodies.iter(world).filter(|(kind, ..)| kind.is_dynamic());
    for (_, turn, (linear, angular), (mass, inertia)) in moving {
        let m = f64::from(mass.value());
        let v = DVec3::from_array(linear.to_array().map(f64::from));
        let spin = angular.0.dot(inertia.rotated(turn.0).tensor() * angular.0);
        energy += 0.5 * (m * v.length_squared() + f64::from(spin));
        momentum += v * m;
    }
    (energy, momentum)
}

fn app(floor: bool, rate: f32) -> App {
    let mut app = App::new();
    let step = Duration::from_secs_f32(1.0 / rate);
    let down = Vec3::NEG_Y * if floor { GRAVITY } else { 0.0 };
    app.add_plugins((MinimalPlugins, AssetPlugin::default()))
        .add_plugins((TransformPlugin, MeshPlugin))
        .add_plugins(PhysicsPlugins::default().with_collision_hooks::<FrangibleHooks>())
        .add_plugins(FrangiblePlugin::default())
        .insert_resource(TimeUpdateStrategy::ManualDuration(step))
        .insert_resource(Time::<Fixed>::from_duration(step))
        .insert_resource(Gravity(down))
        .init_resource::<First>()
        .add_observer(|broke: On<Broke>, mut first: ResMut<First>| {
            first.0.get_or_insert(Arc::clone(&broke.fracture));
        });
    app.finish();
    app.cleanup();
    app
}

/// Plays a scene, with so many steps per second.
pub fn run(scene: &Scene, seed: u64, rate: f32) -> Outcome {
    let mut app = app(scene.floor.is_some(), rate);
    if let Some(floor) = &scene.floor {
        let half_space = Collider::half_space(Vec3::Y);
        app.world_mut()
            .spawn((RigidBody::Static, half_space, surface(floor)));
    }
    let mut assets = app.world_mut().resource_mut::<Assets<FrangibleAsset>>();
    let asset = assets.add(FrangibleAsset(scene.kind.clone()));
    let body = (Breakable(asset), Seed(seed), place(&scene.start));
    let body = app.world_mut().spawn(body).id();
    // It becomes a body in the first frame, before time begins to run.
    app.world_mut().resource_mut::<Time<Virtual>>().pause();
    app.update();
    assert!(app.world().get::<BreakableBody>(body).is_some());
    app.world_mut().resource_mut::<Time<Virtual>>().unpause();
    let striker = scene.striker.as_ref().map(|striker| {
        let Striker {
            solid,
            material,
            start,
        } = striker;
        let collider = match *solid {
            Solid::Ball(radius) => Collider::sphere(radius),
            Solid::Box(half) => {
                let [x, y, z] = half.to_array().map(|h| 2.0 * h);
                Collider::cuboid(x, y, z)
            }
        };
        let density = ColliderDensity(material.density as f32);
        // Without a bound Avian lets a fast ball bounce off pieces that it passes.
        let fast = (SweptCcd::default(), SpeculativeMargin(0.02));
        let shape = (RigidBody::Dynamic, collider, density, fast);
        let bundle = (shape, surface(material), place(start));
        app.world_mut().spawn(bundle).id()
    });
    let mut broke = None;
    for _ in 0..(scene.seconds * rate) as usize {
        let before = motion(&mut app);
        app.update();
        if broke.is_none()
            && let Some(fracture) = app.world().resource::<First>().0.clone()
        {
            broke = Some(Break::new(&fracture, [before, motion(&mut app)]));
        }
    }
    let velocity = striker.and_then(|s| app.world().get::<LinearVelocity>(s));
    Outcome {
        broke,
        striker: velocity.map_or(glam::Vec3::ZERO, |v| glam::Vec3::from_array(v.to_array())),
    }
}
