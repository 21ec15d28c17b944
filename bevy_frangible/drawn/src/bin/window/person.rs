//! A person who walks, looks about with the mouse, and throws stones.

use avian3d::prelude::*;
use bevy::input::mouse::AccumulatedMouseMotion;
use bevy::prelude::*;
use bevy::window::{CursorGrabMode, CursorOptions};
use drawn::{Camera, Props};

/// Height of the eyes and radius of the body, m.
const EYES: f32 = 1.65;
const RADIUS: f32 = 0.25;

/// Speeds of walking and of stones, m/s.
const WALK: f32 = 2.0;
const THROW: f32 = 22.0;

/// Radius of a stone, m.
const STONE: f32 = 0.035;

/// Turn of the head per pixel of the mouse, rad.
const TURN: f32 = 2e-3;

/// Controls for a person.
pub struct Person;

/// A throw of a stone.
#[derive(Message)]
pub struct Throw {
    /// Position at which it leaves the hand, m.
    pub from: Vec3,
    /// Velocity, m/s.
    pub velocity: Vec3,
}

/// The person's body, as a collider.
#[derive(Component)]
struct Walker;

impl Plugin for Person {
    fn build(&self, app: &mut App) {
        app.add_message::<Throw>()
            .add_systems(Startup, stand_up)
            .add_systems(Update, (take_mouse, look, walk, aim, throw).chain());
    }
}

fn stand_up(camera: Single<&Transform, With<Camera>>, mut commands: Commands) {
    let height = EYES + 0.1;
    commands.spawn((
        Walker,
        RigidBody::Kinematic,
        Collider::capsule(RADIUS, height - 2.0 * RADIUS),
        Transform::from_translation(camera.translation.with_y(0.5 * height + 0.02)),
    ));
}

/// A click takes the mouse, escape gives it back.
fn take_mouse(
    cursor: Option<Single<&mut CursorOptions>>,
    (buttons, keys): (Res<ButtonInput<MouseButton>>, Res<ButtonInput<KeyCode>>),
) {
    let Some(mut cursor) = cursor else {
        return;
    };
    if buttons.just_pressed(MouseButton::Left) {
        (cursor.grab_mode, cursor.visible) = (CursorGrabMode::Locked, false);
    }
    if keys.just_pressed(KeyCode::Escape) {
        (cursor.grab_mode, cursor.visible) = (CursorGrabMode::None, true);
    }
}

fn look(
    mut camera: Single<&mut Transform, With<Camera>>,
    mouse: Res<AccumulatedMouseMotion>,
    cursor: Option<Single<&CursorOptions>>,
) {
    if !cursor.is_some_and(|cursor| cursor.grab_mode == CursorGrabMode::Locked) {
        return;
    }
    let (yaw, pitch, _) = camera.rotation.to_euler(EulerRot::YXZ);
    let pitch = (pitch - TURN * mouse.delta.y).clamp(-1.5, 1.5);
    camera.rotation = Quat::from_euler(EulerRot::YXZ, yaw - TURN * mouse.delta.x, pitch, 0.0);
}

/// The body slides along obstacles; the eyes go with it.
fn walk(
    walker: Single<(Entity, &Collider, &mut Transform), With<Walker>>,
    mut camera: Single<&mut Transform, (With<Camera>, Without<Walker>)>,
    keys: Res<ButtonInput<KeyCode>>,
    time: Res<Time>,
    around: MoveAndSlide,
) {
    let (entity, collider, mut place) = walker.into_inner();
    let held = |key| f32::from(u8::from(keys.pressed(key)));
    let ahead = held(KeyCode::KeyW) - held(KeyCode::KeyS);
    let aside = held(KeyCode::KeyD) - held(KeyCode::KeyA);
    if ahead == 0.0 && aside == 0.0 {
        return;
    }
    let way = ahead * camera.forward().as_vec3() + aside * camera.right().as_vec3();
    let moved = around.move_and_slide(
        collider,
        place.translation,
        Quat::IDENTITY,
        WALK * way.with_y(0.0).normalize_or_zero(),
        time.delta(),
        &MoveAndSlideConfig::default(),
        &SpatialQueryFilter::from_excluded_entities([entity]),
        |_| MoveAndSlideHitResponse::Accept,
    );
    place.translation = moved.position.with_y(place.translation.y);
    camera.translation = place.translation.with_y(EYES);
}

fn aim(
    camera: Single<&Transform, With<Camera>>,
    buttons: Res<ButtonInput<MouseButton>>,
    mut throws: MessageWriter<Throw>,
) {
    if buttons.just_pressed(MouseButton::Left) {
        let forward = camera.forward().as_vec3();
        throws.write(Throw {
            from: camera.translation + 0.4 * forward,
            velocity: THROW * forward,
        });
    }
}

fn throw(mut throws: MessageReader<Throw>, mut props: Props) {
    for throw in throws.read() {
        props.ball("stone", STONE, throw.from, throw.velocity);
    }
}
