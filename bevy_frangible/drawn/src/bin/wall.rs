//! A wall of bricks without mortar, and a ball of steel of 10 kg that flies at it.
//!
//! `cargo run --release -p drawn --bin wall`

use bevy::input::common_conditions::input_just_pressed;
use bevy::prelude::*;
use bevy_frangible::prelude::*;
use drawn::{Props, View};
use frangible_bake::Shape;

const VIEW: View = View {
    title: "A brick wall: space throws another ball, G shows weak points",
    eye: Vec3::new(1.0, 0.75, 1.7),
    target: Vec3::new(-0.05, 0.22, 0.0),
    rate: 240.0,
    steps: 128,
};

/// Length, height and depth of a brick, m; courses, and bricks in each.
const BRICK: Vec3 = Vec3::new(0.215, 0.065, 0.1025);
const COURSES: usize = 8;
const PER_COURSE: usize = 5;

/// Radius of the ball, m, and its velocity, m/s.
const RADIUS: f32 = 0.067;
const VELOCITY: Vec3 = Vec3::new(0.0, 0.8, -11.0);

#[derive(Resource)]
struct Brick(Handle<FrangibleAsset>);

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut app = drawn::app(&VIEW)?;
    let shape = Shape::block(BRICK.to_array().map(f64::from));
    let brick = drawn::kind(&mut app, shape, "brick", 3000.0, Vec::new())?;
    app.insert_resource(Brick(brick))
        .add_systems(Startup, (build, throw))
        .add_systems(Update, throw.run_if(input_just_pressed(KeyCode::Space)))
        .run();
    Ok(())
}

fn build(mut props: Props, brick: Res<Brick>) {
    props.floor();
    for (course, place) in (0..COURSES).flat_map(|c| (0..PER_COURSE).map(move |p| (c, p))) {
        // Every other course begins half a brick later.
        let shift = 0.5 * (course % 2) as f32 - 0.25;
        let along = place as f32 - 0.5 * (PER_COURSE - 1) as f32 + shift;
        let middle = Vec3::new(
            along * (BRICK.x + 1e-3),
            (course as f32 + 0.5) * BRICK.y,
            0.0,
        );
        props.commands.spawn((
            Breakable(brick.0.clone()),
            Seed((course * PER_COURSE + place) as u64),
            props.materials.brick.clone(),
            Transform::from_translation(middle),
        ));
    }
}

fn throw(mut props: Props) {
    let start = Vec3::new(0.05, 0.25, 2.2);
    props.ball("steel", RADIUS, start, VELOCITY);
}
