//! Built-in scenes of laminated glass.

use frangible::Material;
use frangible::glam::{Quat, Vec3};
use frangible_bake::{PaneShape, Region, Shape, Support};

use crate::body::{BodySpec, Place};
use crate::error::SceneError;
use crate::projectile::Projectile;
use crate::scene::Scene;
use crate::source::BodySource;

/// Striker of a windscreen.
#[derive(Clone, Copy)]
pub(crate) enum Blow {
    /// A stone from the road.
    Stone,
    /// A soft, heavy body, about as heavy as a head.
    Head,
    /// A small, fast steel ball of the same mass.
    Block,
}

/// A windscreen in its frame, under one of three blows.
pub(crate) fn windscreen(blow: Blow) -> Result<Scene, SceneError> {
    let shape = PaneShape {
        size: [0.8, 0.42, 0.00496],
        corner: 0.04,
        bow: 0.04,
    };
    let [width, depth, _] = shape.size;
    let pane = BodySpec {
        modes: 80,
        place: Place::Centre(Vec3::new(0.0, 0.35, 0.0)),
        rotation: Quat::from_rotation_x(-0.6),
        supports: frame([width, depth], 0.012),
        resolution: Some(60_000),
        ..pane("windscreen", Shape::Pane(shape))?
    };
    let (name, what, projectile) = match blow {
        Blow::Stone => (
            "windscreen",
            "a stone: a star in one ply",
            Projectile {
                material: "stone".into(),
                ..Projectile::ball(0.003, 0.0065, 25.0)
            },
        ),
        Blow::Head => (
            "windscreen-web",
            "a body of 5 kg: a dented web that stays in its frame",
            Projectile {
                material: "wood".into(),
                ..Projectile::ball(5.0, 0.11, 13.0)
            },
        ),
        Blow::Block => (
            "windscreen-hole",
            "a ball of 5 kg that is small and fast: a hole",
            Projectile::ball(5.0, 0.0535, 20.0),
        ),
    };
    let mut scene = Scene {
        name: name.into(),
        summary: format!("a windscreen of laminated glass, hit by {what}"),
        look_from: Vec3::new(0.35, 0.35, 1.0),
        duration: 1.5,
        ..Scene::one_body(pane)
    };
    scene.throw(Projectile {
        at: Vec3::new(-0.1, 0.03, 0.0),
        toward: Vec3::new(0.0, -0.15, -1.0),
        ..projectile
    });
    Ok(scene)
}

/// The window of a shop, of 4 mm, a film of 0.76 mm and 4 mm, and a brick's weight of steel.
pub(crate) fn shop_front() -> Result<Scene, SceneError> {
    let size = [1.2, 1.6, 0.00876];
    let window = BodySpec {
        modes: 80,
        place: Place::Centre(Vec3::new(0.0, 0.85, 0.0)),
        supports: frame([size[0], size[1]], 0.015),
        resolution: Some(60_000),
        ..pane("shop front", Shape::Box { size })?
    };
    let mut scene = Scene {
        name: "shop-front".into(),
        summary: "the window of a shop, of laminated glass, hit by a stone of 3 kg".into(),
        look_from: Vec3::new(0.4, 0.2, 1.0),
        duration: 1.5,
        ..Scene::one_body(window)
    };
    scene.throw(Projectile {
        material: "stone".into(),
        at: Vec3::new(0.1, -0.2, 0.0),
        ..Projectile::ball(3.0, 0.065, 16.0)
    });
    Ok(scene)
}

/// A table's top of 5 mm, a film of 0.76 mm and 5 mm on a rim, and a ball thrown down on it.
pub(crate) fn table_top() -> Result<Scene, SceneError> {
    let size = [1.0, 0.6, 0.01076];
    let top = BodySpec {
        modes: 80,
        place: Place::Centre(Vec3::new(0.0, 0.7, 0.0)),
        rotation: Quat::from_rotation_x(-std::f32::consts::FRAC_PI_2),
        supports: frame([size[0], size[1]], 0.02),
        resolution: Some(60_000),
        ..pane("table top", Shape::Box { size })?
    };
    let mut scene = Scene {
        name: "table-top".into(),
        summary: "the laminated top of a table, on a rim, and a steel ball thrown down on it"
            .into(),
        look_from: Vec3::new(0.3, 0.6, 1.0),
        duration: 1.5,
        ..Scene::one_body(top)
    };
    scene.throw(Projectile {
        at: Vec3::new(0.1, 0.05, 0.00538),
        toward: Vec3::NEG_Y,
        ..Projectile::ball(4.0, 0.05, 12.0)
    });
    Ok(scene)
}

/// Supports along the four edges of a pane of this size, m, as wide as a rim.
fn frame([width, depth]: [f64; 2], rim: f64) -> Vec<Support> {
    [
        Region::below(0, rim),
        Region::above(0, width - rim),
        Region::below(1, rim),
        Region::above(1, depth - rim),
    ]
    .map(Support::clamped)
    .to_vec()
}

fn pane(name: &str, shape: Shape) -> Result<BodySpec, SceneError> {
    let glass = Material::preset("laminated-glass")?;
    Ok(BodySpec::new(name, BodySource::Shape(shape), glass))
}
