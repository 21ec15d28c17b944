//! A window in a wall: walk up to it and throw stones.
//!
//! `cargo run --release -p drawn --bin window`

mod person;

use bevy::prelude::*;
use bevy_frangible::prelude::*;
use drawn::{Materials, Props, View};
use frangible_bake::{Region, Shape, Support};
use person::{Person, Throw};

const VIEW: View = View {
    title: "Click to capture the mouse and throw a stone; W A S D to walk, G for weak points, Escape to release the mouse",
    eye: Vec3::new(1.0, 1.6, 1.5),
    target: Vec3::new(0.04, 1.47, 0.0),
    rate: 240.0,
    steps: 76,
};

/// Width, height and thickness of the pane, width of its edge in the frame, and height of its middle, m.
const PANE: Vec3 = Vec3::new(1.0, 0.8, 0.004);
const REBATE: f32 = 0.012;
const MIDDLE: f32 = 1.5;

/// Width, height and thickness of the wall, m.
const WALL: Vec3 = Vec3::new(5.0, 2.8, 0.2);

#[derive(Resource)]
struct Pane(Handle<FrangibleAsset>);

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut app = drawn::app(&VIEW)?;
    let [width, height, thickness] = PANE.to_array().map(f64::from);
    let rebate = f64::from(REBATE);
    let edges = [
        Region::below(0, rebate),
        Region::above(0, width - rebate),
        Region::below(1, rebate),
        Region::above(1, height - rebate),
    ];
    let shape = Shape::plate(width, height, thickness);
    let held = edges.map(Support::clamped).to_vec();
    let pane = drawn::kind(&mut app, shape, "glass", 30_000.0, held)?;
    app.insert_resource(Pane(pane))
        .add_plugins(Person)
        .add_systems(Startup, (build, throw_first).chain())
        .run();
    Ok(())
}

/// A wall with a window, and a room behind it.
fn build(mut props: Props, pane: Res<Pane>) {
    props.floor();
    let Materials {
        plaster,
        paint,
        wood,
        glass,
        ..
    } = Materials::clone(&props.materials);
    let (half, wall) = (0.5 * PANE, 0.5 * WALL);
    // The wall about the opening: left, right, below, above.
    let side = wall.x - half.x;
    let (sill, lintel) = (MIDDLE - half.y, WALL.y - MIDDLE - half.y);
    for x in [-1.0, 1.0] {
        let middle = Vec3::new(x * (half.x + 0.5 * side), wall.y, 0.0);
        props.block(Vec3::new(side, WALL.y, WALL.z), middle, &plaster);
    }
    for (height, middle) in [(sill, 0.5 * sill), (lintel, WALL.y - 0.5 * lintel)] {
        let size = Vec3::new(PANE.x, height, WALL.z);
        props.block(size, Vec3::Y * middle, &plaster);
    }
    // A room behind it, in the dark.
    let depth = 2.4;
    props.block(WALL, Vec3::new(0.0, wall.y, -depth), &paint);
    let ceiling = Vec3::new(WALL.x, WALL.z, depth + WALL.z);
    props.block(
        ceiling,
        Vec3::new(0.0, WALL.y + wall.z, -0.5 * depth),
        &plaster,
    );
    for x in [-1.0, 1.0].map(|x| x * (wall.x + wall.z)) {
        let size = Vec3::new(WALL.z, WALL.y, depth + WALL.z);
        props.block(size, Vec3::new(x, wall.y, -0.5 * depth), &paint);
    }
    // A frame of two laths on each edge, one on either side of the pane.
    let (lath, gap) = (0.03, 0.5 * PANE.z + 0.001);
    for z in [-1.0, 1.0].map(|z| z * (gap + 0.5 * lath)) {
        for y in [-1.0, 1.0].map(|y| MIDDLE + y * (half.y - 0.5 * lath)) {
            props.lath(Vec3::new(PANE.x, lath, lath), Vec3::new(0.0, y, z), &wood);
        }
        for x in [-1.0, 1.0].map(|x| x * (half.x - 0.5 * lath)) {
            props.lath(
                Vec3::new(lath, PANE.y, lath),
                Vec3::new(x, MIDDLE, z),
                &wood,
            );
        }
    }
    let place = Transform::from_xyz(0.0, MIDDLE, 0.0);
    props
        .commands
        .spawn((Breakable(pane.0.clone()), Seed(2), glass, place));
}

/// The picture is of a stone that somebody has thrown.
fn throw_first(mut throw: MessageWriter<Throw>) {
    if std::env::args().any(|word| word == "--picture") {
        throw.write(Throw {
            from: Vec3::new(-0.5, 1.5, 3.4),
            velocity: Vec3::new(2.85, 1.95, -22.5),
        });
    }
}
