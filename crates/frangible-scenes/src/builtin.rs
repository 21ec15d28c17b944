//! The built-in scenes.

use std::f32::consts::FRAC_PI_2;

use frangible::Material;
use frangible::glam::{Quat, Vec3};
use frangible_bake::weakness::{Patch, Zone};
use frangible_bake::{Region, Shape, Support};
use frangible_mesh::did_you_mean;

use crate::again;
use crate::body::{BodySpec, Place};
use crate::error::SceneError;
use crate::laminated::{self, Blow};
use crate::projectile::Projectile;
use crate::scene::Scene;
use crate::sheets;
use crate::showpieces;
use crate::source::BodySource;
use crate::tempered;

/// Motion that breaks the body.
enum Action {
    Drop(f64),
    Throw(Projectile),
}

/// Names of the built-in scenes; the first is the default.
pub const SCENE_NAMES: [&str; 32] = [
    "glass",
    "pane",
    "plate",
    "bowl",
    "vase",
    "brick",
    "chocolate",
    "rabbit",
    "piggy-bank",
    "hammer",
    "window",
    "shelf",
    "cantilever",
    "shards",
    "five-blows",
    "wall",
    "crockery",
    "wine-glass",
    "bottle",
    "bulb",
    "statue",
    "chandelier",
    "phone",
    "tiles",
    "windscreen",
    "windscreen-web",
    "windscreen-hole",
    "shop-front",
    "table-top",
    "ice-sheet",
    "side-window",
    "shower-door",
];

/// Length, width and thickness of the bar of chocolate, m.
const BAR: [f64; 3] = [0.16, 0.08, 0.009];

/// Side of its squares and half the width of the grooves between them, m.
const SQUARE: f64 = 0.02;
const GROOVE: f64 = 0.0015;

/// Share of the strength at a groove down to half the thickness: bending stress goes with the thickness squared.
const GROOVE_STRENGTH: f32 = 0.25;

/// A built-in scene by name.
///
/// # Errors
/// An unknown name, with the one that was probably meant.
pub fn scene(name: &str) -> Result<Scene, SceneError> {
    // Shapes of revolution are baked with their axis along z; y is up here.
    let upright = Quat::from_rotation_x(-FRAC_PI_2);
    let tilted = |degrees: f32| Quat::from_rotation_z(degrees.to_radians()) * upright;
    let drop = Action::Drop;
    match name {
        "glass" => build(
            "glass",
            "a drinking glass dropped on a stone floor",
            Shape::drinking_glass(),
            "glass",
            120,
            tilted(148.0),
            drop(1.2),
        ),
        "pane" => build(
            "pane",
            "a window pane hit in its middle by a steel ball",
            Shape::Box {
                size: [0.4, 0.4, 0.004],
            },
            "glass",
            60,
            Quat::IDENTITY,
            Action::Throw(Projectile::ball(0.25, 0.02, 20.0)),
        ),
        "plate" => build(
            "plate",
            "a porcelain dinner plate dropped on its edge",
            Shape::dinner_plate(),
            "porcelain",
            120,
            tilted(75.0),
            drop(1.5),
        ),
        "bowl" => build(
            "bowl",
            "a porcelain bowl dropped on its rim",
            Shape::bowl(),
            "porcelain",
            120,
            tilted(130.0),
            drop(1.0),
        ),
        "vase" => build(
            "vase",
            "a porcelain vase knocked over by a wooden ball",
            Shape::vase(),
            "porcelain",
            120,
            upright,
            Action::Throw(Projectile {
                material: "wood".into(),
                toward: Vec3::NEG_X,
                ..Projectile::ball(0.5, 0.056, 6.0)
            }),
        ),
        "brick" => build(
            "brick",
            "a brick dropped on its end",
            Shape::Box {
                size: [0.21, 0.1, 0.05],
            },
            "brick",
            200,
            Quat::from_rotation_z(1.536),
            drop(3.0),
        ),
        "chocolate" => build(
            "chocolate",
            "a bar of chocolate, scored into squares, dropped on a stone floor",
            Shape::Box { size: BAR },
            "chocolate",
            200,
            Quat::from_rotation_z(0.3) * Quat::from_rotation_x(-1.2),
            drop(1.0),
        ),
        "rabbit" => build_of(
            "rabbit",
            "a rabbit of solid chocolate dropped on a stone floor",
            ready("rabbit", 90_000),
            "chocolate",
            200,
            Quat::from_rotation_z(0.6) * Quat::from_rotation_y(0.4) * upright,
            drop(1.5),
        ),
        "piggy-bank" => build_of(
            "piggy-bank",
            "a porcelain piggy bank hit from above by a hammer",
            ready("piggy_bank", 120_000),
            "porcelain",
            200,
            Quat::from_rotation_y(0.95) * upright,
            Action::Throw(Projectile {
                at: Vec3::new(0.0, 0.03, 0.0),
                ..Projectile::hammer(0.5, 0.02, 7.0)
            }),
        ),
        "hammer" => build(
            "hammer",
            "a brick hit by a hammer",
            Shape::Box {
                size: [0.21, 0.1, 0.05],
            },
            "brick",
            200,
            Quat::from_rotation_y(0.3) * upright,
            Action::Throw(Projectile {
                toward: Vec3::NEG_Y,
                at: Vec3::new(0.01, 0.0, 0.0),
                ..Projectile::hammer(0.5, 0.018, 12.0)
            }),
        ),
        "window" => Ok(held(
            build(
                name,
                "a window pane fixed in its frame, hit by a steel ball",
                Shape::plate(0.4, 0.4, 0.004),
                "glass",
                80,
                Quat::IDENTITY,
                Action::Throw(Projectile::ball(0.13, 0.0158, 20.0)),
            )?,
            0.3,
            [
                Region::below(0, 0.008),
                Region::above(0, 0.392),
                Region::below(1, 0.008),
                Region::above(1, 0.392),
            ],
        )),
        "shelf" => Ok(held(
            build(
                name,
                "a glass shelf on two brackets, hit in its middle by a heavy falling ball",
                Shape::plate(0.5, 0.14, 0.006),
                "glass",
                60,
                upright,
                Action::Throw(Projectile {
                    toward: Vec3::NEG_Y,
                    ..Projectile::ball(0.6, 0.0264, 4.0)
                }),
            )?,
            0.3,
            [Region::below(0, 0.03), Region::above(0, 0.47)],
        )),
        "cantilever" => Ok(held(
            build(
                name,
                "a porcelain bar clamped at one end, hit near the other",
                Shape::block([0.2, 0.05, 0.01]),
                "porcelain",
                40,
                upright,
                Action::Throw(Projectile {
                    at: Vec3::new(0.08, 0.0, 0.0),
                    toward: Vec3::NEG_Y,
                    ..Projectile::ball(0.5, 0.0248, 3.0)
                }),
            )?,
            0.12,
            [Region::below(0, 0.03)],
        )),
        "shards" => again::shards(),
        "five-blows" => again::five_blows(),
        "wall" => again::wall(),
        "crockery" => again::crockery(),
        "wine-glass" => showpieces::wine_glass(),
        "bottle" => showpieces::bottle(),
        "bulb" => showpieces::bulb(),
        "statue" => showpieces::statue(),
        "chandelier" => showpieces::chandelier(),
        "phone" => sheets::phone(),
        "tiles" => sheets::tiles(),
        "windscreen" => laminated::windscreen(Blow::Stone),
        "windscreen-web" => laminated::windscreen(Blow::Head),
        "windscreen-hole" => laminated::windscreen(Blow::Block),
        "shop-front" => laminated::shop_front(),
        "table-top" => laminated::table_top(),
        "ice-sheet" => sheets::ice_sheet(),
        "side-window" => tempered::side_window(),
        "shower-door" => tempered::shower_door(),
        _ => Err(SceneError::UnknownScene {
            name: name.into(),
            hint: did_you_mean(name, SCENE_NAMES),
            known: SCENE_NAMES.join(", "),
        }),
    }
}

/// The scene with its body clamped in these regions, its centre of mass so high above the floor, m.
fn held<const N: usize>(mut scene: Scene, height: f32, regions: [Region; N]) -> Scene {
    for body in &mut scene.bodies {
        body.place = Place::Centre(Vec3::new(0.0, height, 0.0));
        body.supports = regions.iter().cloned().map(Support::clamped).collect();
        if scene.name == "cantilever" {
            // A bar so small needs no more.
            body.resolution = Some(20_000);
        }
    }
    scene
}

/// Between the squares of the bar, through its thickness.
fn grooves() -> Vec<Patch> {
    let half = BAR.map(|side| 0.5 * side);
    let across = |axis: usize| {
        let lines = 1..(BAR[axis] / SQUARE).round() as usize;
        lines.map(move |i| {
            let at = i as f64 * SQUARE - half[axis];
            let (mut low, mut high) = (half.map(|h| -h), half);
            (low[axis], high[axis]) = (at - GROOVE, at + GROOVE);
            let corners = [low, high].map(|c| Vec3::from_array(c.map(|x| x as f32)));
            Patch::of_strength(Zone::Box(corners), GROOVE_STRENGTH)
        })
    };
    across(0).chain(across(1)).collect()
}

fn ready(name: &str, tets: usize) -> BodySource {
    BodySource::Ready {
        name: name.into(),
        resolution: Some(tets),
    }
}

fn build(
    name: &str,
    summary: &str,
    shape: Shape,
    material: &str,
    modes: usize,
    rotation: Quat,
    action: Action,
) -> Result<Scene, SceneError> {
    let source = BodySource::Shape(shape);
    build_of(name, summary, source, material, modes, rotation, action)
}

fn build_of(
    name: &str,
    summary: &str,
    source: BodySource,
    material: &str,
    modes: usize,
    rotation: Quat,
    action: Action,
) -> Result<Scene, SceneError> {
    // Seeds chosen from a sheet of nine for the pictures; any other is as true.
    let seed = match name {
        "glass" => 3,
        "plate" | "rabbit" => 4,
        "piggy-bank" => 9,
        _ => 1,
    };
    let body = BodySpec {
        modes,
        rotation,
        ..BodySpec::new(name, source, Material::preset(material)?)
    };
    let mut scene = Scene {
        summary: summary.into(),
        seed,
        ..Scene::one_body(body)
    };
    if name == "chocolate" {
        for body in &mut scene.bodies {
            body.weakness = grooves();
        }
    }
    if name == "piggy-bank" {
        // From higher up, so that the slot is seen.
        scene.look_from = Vec3::new(0.6, 0.85, 1.0);
    }
    match action {
        Action::Drop(height) => scene.drop_all(height),
        Action::Throw(projectile) => scene.throw(projectile),
    }
    Ok(scene)
}
