//! Built-in scenes of sheets that something else holds: a telephone, tiles on a wall, ice.
//!
//! An [`Adhesive`] holds the pieces of a broken sheet; the sheet's own vibrations do not know of it, and it gives way but does not stretch.

use std::f32::consts::FRAC_PI_2;

use frangible::Material;
use frangible::glam::{Quat, Vec3};
use frangible_bake::{PaneShape, Region, Shape, Support};

use crate::body::{BodySpec, Place};
use crate::error::SceneError;
use crate::projectile::Projectile;
use crate::scene::{Adhesive, Scene};
use crate::source::BodySource;

/// Layer between two bodies that are bonded, m.
const LAYER: f64 = 0.2e-3;

/// Height from which the telephone falls, m: from 1.2 m five cracks run.
const HEIGHT: f32 = 2.0;

/// A telephone that falls on a corner of its cover glass.
///
/// The glass is annealed: that of a telephone is under pressure at its surface, which the model does not have.
pub(crate) fn phone() -> Result<Scene, SceneError> {
    let cover = PaneShape {
        size: [0.0720, 0.1500, 0.0007],
        corner: 0.0085,
        bow: 0.0,
    };
    // A little smaller, so that the edge of the glass stands out and meets the floor.
    let case = PaneShape {
        size: [0.0708, 0.1488, 0.0070],
        corner: 0.0080,
        bow: 0.0,
    };
    // On its corner, and leaning back a little, so that it falls on its back.
    let turn = Quat::from_rotation_x(-0.04) * Quat::from_rotation_z(0.55);
    let ahead = 0.5 * (cover.size[2] + case.size[2]) + LAYER;
    let down = turn.inverse() * Vec3::NEG_Y;
    let lowest = reach(&cover, down) + ahead as f32 * down.z;
    let centre = Vec3::new(0.0, HEIGHT + lowest, 0.0);
    let on_case = turn * (ahead as f32 * Vec3::Z);
    let glass = BodySpec {
        modes: 150,
        place: Place::Above {
            height: f64::from(HEIGHT),
            over: [on_case.x, on_case.z],
        },
        rotation: turn,
        resolution: Some(60_000),
        ..pane("cover", cover, Material::preset("glass")?)
    };
    let steel = Material::preset("steel")?;
    let casing = Material {
        name: "casing".into(),
        youngs_modulus: 70e9,
        density: 2100.0,
        ..steel
    };
    let case = BodySpec {
        modes: 20,
        place: Place::Centre(centre),
        rotation: turn,
        resolution: Some(3_000),
        ..pane("telephone", case, casing)
    };
    Ok(Scene {
        name: "phone".into(),
        summary: "a phone dropped on a corner of its cover glass".into(),
        bodies: vec![glass.clone(), case],
        adhesive: Some(Adhesive {
            strength: 3e6,
            patch: 0.008,
        }),
        look_from: Vec3::new(0.25, 0.35, 1.0),
        duration: 3.5,
        ..Scene::one_body(glass)
    })
}

/// Tiles on a wall, and a steel ball.
pub(crate) fn tiles() -> Result<Scene, SceneError> {
    const ACROSS: usize = 4;
    const TILE: [f64; 3] = [0.15, 0.15, 0.007];
    const JOINT: f64 = 0.004;
    const WALL: [f64; 3] = [0.66, 0.66, 0.06];
    let pitch = (TILE[0] + JOINT) as f32;
    let middle = Vec3::new(0.0, 0.5 * WALL[1] as f32 + 1e-3, 0.0);
    let wall = BodySpec {
        modes: 20,
        place: Place::Centre(middle),
        supports: vec![Support::clamped(Region::below(2, 0.01))],
        resolution: Some(6_000),
        ..body("wall", Shape::Box { size: WALL }, "concrete")?
    };
    let kind = BodySpec {
        modes: 60,
        resolution: Some(16_000),
        ..body("tile", Shape::Box { size: TILE }, "porcelain")?
    };
    let ahead = 0.5 * (WALL[2] + TILE[2]) + LAYER;
    let tiles = (0..ACROSS * ACROSS).map(|i| {
        let [column, row] = [i % ACROSS, i / ACROSS].map(|k| k as f32 - 0.5 * (ACROSS - 1) as f32);
        let place = Vec3::new(column * pitch, row * pitch, ahead as f32);
        BodySpec {
            name: format!("tile {}", i + 1),
            place: Place::Centre(middle + place),
            ..kind.clone()
        }
    });
    let tiles: Vec<BodySpec> = tiles.collect();
    let mut bodies = tiles;
    bodies.push(wall);
    let mut scene = Scene {
        name: "tiles".into(),
        summary: "porcelain tiles on a concrete wall, hit by a steel ball".into(),
        bodies,
        projectiles: vec![Projectile {
            target: ACROSS + 1,
            at: Vec3::new(0.02, 0.015, 0.0),
            ..Projectile::ball(0.2, 0.0183, 6.0)
        }],
        adhesive: Some(Adhesive {
            strength: 0.5e6,
            patch: 0.025,
        }),
        look_from: Vec3::new(0.45, 0.3, 1.0),
        duration: 2.0,
        ..Scene::one_body(kind)
    };
    scene.pieces.least_mass = 2e-4;
    Ok(scene)
}

/// A sheet of ice that is held along its rim, and a stone that falls on it.
///
/// Here it bends under the stone, is cut into wedges and then around. By the speed and by the seed it may also only crack: at 3 to 6 m/s it
/// falls into 9 to 300 pieces.
pub(crate) fn ice_sheet() -> Result<Scene, SceneError> {
    let [side, thickness, rim] = [0.8, 0.04, 0.01];
    let sheet = BodySpec {
        place: Place::Centre(Vec3::new(0.0, 0.5, 0.0)),
        rotation: Quat::from_rotation_x(-FRAC_PI_2),
        supports: [0, 1]
            .into_iter()
            .flat_map(|axis| [Region::below(axis, rim), Region::above(axis, side - rim)])
            .map(Support::clamped)
            .collect(),
        ..body("sheet", Shape::block([side, side, thickness]), "ice")?
    };
    let mut scene = Scene {
        name: "ice-sheet".into(),
        summary: "a sheet of ice supported along its rim, hit by a falling stone".into(),
        look_from: Vec3::new(0.4, 0.7, 1.0),
        duration: 3.0,
        ..Scene::one_body(sheet)
    };
    scene.throw(Projectile {
        material: "stone".into(),
        at: Vec3::new(0.0, 0.0, 0.5 * thickness as f32),
        toward: Vec3::NEG_Y,
        ..Projectile::ball(4.0, 0.07, 4.0)
    });
    Ok(scene)
}

/// Reach of a pane from its centre in a direction of unit length, m.
fn reach(pane: &PaneShape, toward: Vec3) -> f32 {
    let [width, depth, thickness] = pane.size.map(|side| 0.5 * side as f32);
    let corner = pane.corner as f32;
    let [x, y, z] = toward.abs().to_array();
    x * (width - corner) + y * (depth - corner) + corner * x.hypot(y) + z * thickness
}

fn pane(name: &str, shape: PaneShape, material: Material) -> BodySpec {
    BodySpec::new(name, BodySource::Shape(Shape::Pane(shape)), material)
}

fn body(name: &str, shape: Shape, material: &str) -> Result<BodySpec, SceneError> {
    Ok(BodySpec::new(
        name,
        BodySource::Shape(shape),
        Material::preset(material)?,
    ))
}
