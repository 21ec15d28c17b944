//! The five lines of the plugin's page, with a floor and light: a drinking glass falls on stone.
//!
//! `cargo run --release -p drawn --bin glass`

use std::f32::consts::FRAC_PI_2;

use bevy::input::common_conditions::input_just_pressed;
use bevy::prelude::*;
use bevy_frangible::prelude::*;
use drawn::{Props, View};
use frangible_bake::Shape;

const VIEW: View = View {
    title: "A glass falls on stone: space drops another, G shows weak points",
    eye: Vec3::new(0.25, 0.3, 0.85),
    target: Vec3::new(0.0, 0.18, 0.0),
    rate: 240.0,
    steps: 132,
};

#[derive(Resource)]
struct Glass(Handle<FrangibleAsset>);

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut app = drawn::app(&VIEW)?;
    let glass = drawn::kind(
        &mut app,
        Shape::drinking_glass(),
        "glass",
        20_000.0,
        Vec::new(),
    )?;
    app.insert_resource(Glass(glass))
        .add_systems(Startup, (|mut props: Props| props.floor(), fall))
        .add_systems(Update, fall.run_if(input_just_pressed(KeyCode::Space)))
        .run();
    Ok(())
}

fn fall(mut props: Props, glass: Res<Glass>, mut fallen: Local<u64>) {
    // The axis of a baked glass is its z; it falls on its rim, aslant.
    let tilted = Quat::from_rotation_z(2.58) * Quat::from_rotation_x(-FRAC_PI_2);
    *fallen += 1;
    props.commands.spawn((
        Breakable(glass.0.clone()),
        Seed(*fallen),
        props.materials.glass.clone(),
        Transform::from_xyz(0.0, 1.2, 0.0).with_rotation(tilted),
    ));
}
