//! Built-in scenes in which pieces break again.

use std::f32::consts::FRAC_PI_2;

use frangible::Material;
use frangible::glam::{Quat, Vec3};
use frangible_bake::{Region, Shape, Support};

use crate::body::{BodySpec, Place};
use crate::error::SceneError;
use crate::projectile::Projectile;
use crate::scene::Scene;
use crate::source::BodySource;

/// Generations that break again in these scenes.
const GENERATIONS: u32 = 3;

/// Length, height and width of a brick, m, and of the joint between two.
const BRICK: [f64; 3] = [0.21, 0.065, 0.1];
const JOINT: f64 = 0.01;

/// The shelf, m.
const BOARD: [f64; 3] = [0.6, 0.2, 0.006];

/// A dinner plate that breaks on the floor, and whose shards break as they land.
pub(crate) fn shards() -> Result<Scene, SceneError> {
    let plate = BodySpec {
        rotation: Quat::from_rotation_z(85.0_f32.to_radians()) * upright(),
        ..body("plate", Shape::dinner_plate(), "porcelain", 100)?
    };
    let mut scene = Scene {
        name: "shards".into(),
        summary: "a porcelain plate dropped on its edge, whose shards break again when they land"
            .into(),
        seed: 3,
        ..again(plate)
    };
    scene.drop_all(1.5);
    Ok(scene)
}

/// A brick under a hammer, five blows.
pub(crate) fn five_blows() -> Result<Scene, SceneError> {
    let brick = BodySpec {
        rotation: Quat::from_rotation_y(0.3),
        ..body("brick", Shape::Box { size: BRICK }, "brick", 80)?
    };
    let places = [0.06, -0.06, 0.0, 0.03, -0.03];
    let blows = places.into_iter().enumerate().map(|(i, x)| Projectile {
        at: Quat::from_rotation_y(0.3) * Vec3::new(x, 0.0, 0.0),
        delay: 0.45 * i as f64,
        stays: Some(0.25),
        ..Projectile::hammer(0.5, 0.018, 7.5)
    });
    Ok(Scene {
        name: "five-blows".into(),
        summary: "a brick hit five times by a hammer".into(),
        projectiles: blows.collect(),
        ..again(brick)
    })
}

/// A wall of bricks in lime mortar, hit by a heavy ball.
pub(crate) fn wall() -> Result<Scene, SceneError> {
    const COURSES: usize = 6;
    const PER_COURSE: usize = 4;
    let pitch = BRICK.map(|side| (side + JOINT) as f32);
    let kind = BodySpec {
        resolution: Some(9_000),
        ..body("brick", Shape::Box { size: BRICK }, "brick", 40)?
    };
    let bricks = (0..COURSES * PER_COURSE).map(|i| {
        let (course, along) = (i / PER_COURSE, i % PER_COURSE);
        // Every other course begins half a brick later.
        let shift = 0.5 * (course % 2) as f32 - 0.25;
        let x = (along as f32 - 0.5 * (PER_COURSE - 1) as f32 + shift) * pitch[0];
        let y = 0.5 * BRICK[1] as f32 + 1e-4 + course as f32 * pitch[1];
        BodySpec {
            name: format!("brick {}", i + 1),
            place: Place::Centre(Vec3::new(x, y, 0.0)),
            ..kind.clone()
        }
    });
    let bodies: Vec<BodySpec> = bricks.collect();
    let ball = Projectile {
        target: 2 * PER_COURSE + 2,
        ..Projectile::ball(4.0, 0.0496, 7.0)
    };
    Ok(Scene {
        name: "wall".into(),
        summary: "a wall of bricks in lime mortar, hit by a steel ball of 4 kg".into(),
        bodies,
        projectiles: vec![ball],
        mortar: Some(2.0e5),
        look_from: Vec3::new(0.6, 0.35, 1.0),
        duration: 4.0,
        ..again(kind)
    })
}

/// Crockery on a shelf of porcelain, knocked down.
pub(crate) fn crockery() -> Result<Scene, SceneError> {
    let height = 0.9_f32;
    let board = BodySpec {
        place: Place::Centre(Vec3::new(0.0, height, 0.0)),
        rotation: upright(),
        supports: [Region::below(0, 0.03), Region::above(0, 0.57)]
            .map(Support::clamped)
            .to_vec(),
        ..body(
            "shelf",
            Shape::plate(BOARD[0], BOARD[1], BOARD[2]),
            "porcelain",
            60,
        )?
    };
    let on_board = |name: &str, shape: Shape, x: f32| {
        Ok::<BodySpec, SceneError>(BodySpec {
            place: Place::Above {
                height: f64::from(height) + 0.5 * BOARD[2] + 2e-4,
                over: [x, 0.0],
            },
            rotation: upright(),
            ..body(name, shape, "porcelain", 60)?
        })
    };
    let bodies = vec![
        board,
        on_board("bowl 1", Shape::bowl(), -0.19)?,
        on_board("vase", Shape::vase(), 0.0)?,
        on_board("bowl 2", Shape::bowl(), 0.19)?,
    ];
    let ball = Projectile {
        at: Vec3::new(0.08, 0.0, 0.0),
        toward: Vec3::NEG_Y,
        ..Projectile::ball(1.5, 0.0358, 6.0)
    };
    let kind = bodies[0].clone();
    Ok(Scene {
        name: "crockery".into(),
        summary: "bowls and a vase on a porcelain shelf, hit from above by a heavy ball".into(),
        bodies,
        projectiles: vec![ball],
        duration: 4.0,
        ..again(kind)
    })
}

fn upright() -> Quat {
    Quat::from_rotation_x(-FRAC_PI_2)
}

fn body(name: &str, shape: Shape, material: &str, modes: usize) -> Result<BodySpec, SceneError> {
    Ok(BodySpec {
        modes,
        ..BodySpec::new(name, BodySource::Shape(shape), Material::preset(material)?)
    })
}

fn again(body: BodySpec) -> Scene {
    let mut scene = Scene::one_body(body);
    scene.pieces.generations = GENERATIONS;
    scene
}
