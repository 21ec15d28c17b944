//! The china shop of the plugin's frame times, drawn: bowls, vases and glasses on boards, and a ball of steel along one of them.
//!
//! `cargo run --release -p drawn --bin china_shop`

#[path = "../../../examples/china_shop/shop.rs"]
mod shop;

use bevy::input::common_conditions::input_just_pressed;
use bevy::prelude::*;
use drawn::{Materials, View};
use shop::{Ball, Board, Rules};

const VIEW: View = View {
    title: "A china shop: space throws a ball, G shows weak points",
    eye: Vec3::new(-0.45, 1.2, 3.1),
    target: Vec3::new(-0.95, 0.88, 1.2),
    rate: 60.0,
    steps: 78,
};

/// Things on the boards.
const THINGS: usize = 400;

/// Steps in which they come to rest.
const SETTLE: u32 = 40;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let kinds = shop::kinds()?;
    let mut app = drawn::app(&VIEW)?;
    shop::rules(
        &mut app,
        Rules {
            inside: true,
            ..Rules::default()
        },
    );
    app.add_observer(dress_board)
        .add_observer(dress_ball)
        .add_observer(dress_thing);
    shop::furnish(app.world_mut(), &kinds, THINGS);
    let settled = |mut step: Local<u32>| {
        *step += 1;
        *step == SETTLE
    };
    app.add_systems(FixedUpdate, throw.run_if(settled))
        .add_systems(Update, throw.run_if(input_just_pressed(KeyCode::Space)))
        .run();
    Ok(())
}

fn throw(world: &mut World) -> Result {
    shop::throw(world).map_err(|error| error.to_string())?;
    Ok(())
}

fn dress_board(
    added: On<Add, Board>,
    boards: Query<&Board>,
    mut meshes: ResMut<Assets<Mesh>>,
    materials: Res<Materials>,
    mut commands: Commands,
) -> Result {
    let mesh = Cuboid::from_size(boards.get(added.entity)?.0);
    let seen = (Mesh3d(meshes.add(mesh)), materials.wood.clone());
    commands.entity(added.entity).insert(seen);
    Ok(())
}

fn dress_ball(
    added: On<Add, Ball>,
    balls: Query<&Ball>,
    mut meshes: ResMut<Assets<Mesh>>,
    materials: Res<Materials>,
    mut commands: Commands,
) -> Result {
    let mesh = Sphere::new(balls.get(added.entity)?.0).mesh().uv(64, 48);
    let seen = (Mesh3d(meshes.add(mesh)), materials.steel.clone());
    commands.entity(added.entity).insert(seen);
    Ok(())
}

fn dress_thing(
    added: On<Add, bevy_frangible::Breakable>,
    materials: Res<Materials>,
    mut commands: Commands,
) {
    commands
        .entity(added.entity)
        .insert(materials.porcelain.clone());
}
