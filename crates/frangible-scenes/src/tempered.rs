//! Built-in scenes of tempered glass.

use frangible::Material;
use frangible::glam::{DVec3, Quat, Vec3};
use frangible_bake::{PaneShape, Region, Shape, Support};

use crate::body::{BodySpec, Place};
use crate::error::SceneError;
use crate::projectile::Projectile;
use crate::scene::Scene;
use crate::source::BodySource;

/// Tetrahedra: dice do not use the mesh, only the start of the first crack does.
const TETS: usize = 12_000;

/// The front side window of a car, bent, held at three edges, and a steel ball.
pub(crate) fn side_window() -> Result<Scene, SceneError> {
    let shape = PaneShape {
        size: [0.84, 0.48, 0.004],
        corner: 0.06,
        bow: 0.03,
    };
    let [width, _, _] = shape.size;
    let rim = 0.012;
    let window = BodySpec {
        modes: 60,
        place: Place::Centre(Vec3::new(0.0, 0.55, 0.0)),
        rotation: Quat::from_rotation_x(-0.15),
        supports: [
            Region::below(0, rim),
            Region::above(0, width - rim),
            Region::below(1, rim),
        ]
        .map(Support::clamped)
        .to_vec(),
        resolution: Some(TETS),
        ..pane("side window", Shape::Pane(shape))?
    };
    let mut scene = Scene {
        name: "side-window".into(),
        summary: "the side window of a car, of tempered glass, hit near an edge by a steel ball"
            .into(),
        look_from: Vec3::new(0.3, 0.25, 1.0),
        duration: 2.0,
        ..Scene::one_body(window)
    };
    scene.throw(Projectile {
        at: Vec3::new(-0.26, 0.1, 0.0),
        ..Projectile::ball(0.25, 0.0197, 14.0)
    });
    Ok(scene)
}

/// The door of a shower on two hinges, and a steel knob.
pub(crate) fn shower_door() -> Result<Scene, SceneError> {
    let size = [0.7, 1.85, 0.008];
    // Hinges along parts of the left edge.
    let hinge = |[low, high]: [f64; 2]| {
        Support::clamped(Region::Box {
            low: DVec3::new(f64::NEG_INFINITY, low, f64::NEG_INFINITY),
            high: DVec3::new(0.02, high, f64::INFINITY),
        })
    };
    let door = BodySpec {
        modes: 60,
        place: Place::Centre(Vec3::new(0.0, 0.94, 0.0)),
        supports: [[0.15, 0.35], [1.5, 1.7]].map(hinge).to_vec(),
        resolution: Some(TETS),
        ..pane("shower door", Shape::Box { size })?
    };
    let mut scene = Scene {
        name: "shower-door".into(),
        summary: "a shower door of tempered glass that is hit by a steel knob".into(),
        look_from: Vec3::new(0.35, 0.2, 1.0),
        duration: 2.0,
        ..Scene::one_body(door)
    };
    scene.throw(Projectile {
        at: Vec3::new(0.2, -0.1, 0.0),
        ..Projectile::ball(0.6, 0.0264, 15.0)
    });
    Ok(scene)
}

fn pane(name: &str, shape: Shape) -> Result<BodySpec, SceneError> {
    let glass = Material::preset("tempered-glass")?;
    Ok(BodySpec::new(name, BodySource::Shape(shape), glass))
}
