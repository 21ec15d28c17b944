//! Built-in scenes for the eye: things that everybody has seen break.
//!
//! The glass here is annealed; `tempered.rs` and `laminated.rs` have panes of tempered and of laminated glass.

use std::f32::consts::FRAC_PI_2;

use frangible::Material;
use frangible::glam::{Quat, Vec3};
use frangible_bake::{Shape, Station};

use crate::body::BodySpec;
use crate::error::SceneError;
use crate::projectile::Projectile;
use crate::scene::Scene;
use crate::source::BodySource;

/// Tetrahedra of the bottle and of the bulb.
const THIN: usize = 60_000;

/// A wine glass that falls on the edge of its foot.
pub(crate) fn wine_glass() -> Result<Scene, SceneError> {
    let source = BodySource::Ready {
        name: "wine_glass".into(),
        resolution: None,
    };
    let glass = BodySpec {
        rotation: tilted(35.0),
        ..body("wine-glass", source, "glass")?
    };
    Ok(dropped(
        glass,
        "a wine glass dropped on the edge of its foot",
        1.0,
    ))
}

/// A bottle and a steel ball of 4 g, from a catapult.
pub(crate) fn bottle() -> Result<Scene, SceneError> {
    let bottle = BodySpec {
        rotation: upright(),
        resolution: Some(THIN),
        ..body("bottle", BodySource::Shape(Shape::bottle()), "glass")?
    };
    let mut scene = Scene {
        summary: "a bottle hit by a steel ball from a slingshot".into(),
        look_from: Vec3::new(0.5, 0.45, 1.0),
        ..Scene::one_body(bottle)
    };
    scene.throw(Projectile {
        toward: Vec3::X,
        ..Projectile::ball(0.004, 0.0045, 45.0)
    });
    Ok(scene)
}

/// The glass of a light bulb.
pub(crate) fn bulb() -> Result<Scene, SceneError> {
    let bulb = BodySpec {
        rotation: tilted(30.0),
        resolution: Some(THIN),
        ..body("bulb", BodySource::Shape(bulb_shape()), "glass")?
    };
    Ok(Scene {
        seed: 3,
        ..dropped(
            bulb,
            "the glass of a light bulb, dropped on a stone floor",
            1.0,
        )
    })
}

/// A marble dancer that falls off a low shelf.
pub(crate) fn statue() -> Result<Scene, SceneError> {
    let source = BodySource::Ready {
        name: "statuette".into(),
        resolution: None,
    };
    let statue = BodySpec {
        rotation: tilted(25.0),
        ..body("statue", source, "marble")?
    };
    Ok(dropped(
        statue,
        "a marble dancer falling off a low shelf",
        0.45,
    ))
}

/// A chandelier of glass that falls from a low ceiling, on the ends of its arms.
pub(crate) fn chandelier() -> Result<Scene, SceneError> {
    let source = BodySource::Ready {
        name: "chandelier".into(),
        resolution: None,
    };
    let chandelier = BodySpec {
        modes: 200,
        rotation: tilted(60.0),
        ..body("chandelier", source, "glass")?
    };
    Ok(dropped(
        chandelier,
        "a glass chandelier of twelve arms dropped on the ends of its arms",
        0.5,
    ))
}

/// A bulb 60 mm across and 95 mm long with an open neck; its wall of 1 mm is about twice as thick as a real one's.
fn bulb_shape() -> Shape {
    let station = |outer: [f64; 2], inner: [f64; 2]| Station::smooth(outer, inner);
    let profile = vec![
        station([0.0, 0.0], [0.0, 0.001]),
        station([0.012, 0.0025], [0.0116, 0.0034]),
        station([0.022, 0.0095], [0.0213, 0.0102]),
        station([0.0280, 0.0190], [0.0271, 0.0194]),
        station([0.0300, 0.0300], [0.0290, 0.0300]),
        station([0.0285, 0.0400], [0.0275, 0.0397]),
        station([0.0235, 0.0530], [0.0226, 0.0525]),
        station([0.0180, 0.0660], [0.0171, 0.0656]),
        station([0.0145, 0.0780], [0.0135, 0.0779]),
        station([0.0130, 0.0950], [0.0120, 0.0950]),
    ];
    Shape::Revolution { profile }
}

/// Shapes are baked with their axis along z; y is up here.
fn upright() -> Quat {
    Quat::from_rotation_x(-FRAC_PI_2)
}

fn tilted(degrees: f32) -> Quat {
    Quat::from_rotation_z(degrees.to_radians()) * upright()
}

fn body(name: &str, source: BodySource, material: &str) -> Result<BodySpec, SceneError> {
    Ok(BodySpec {
        modes: 120,
        ..BodySpec::new(name, source, Material::preset(material)?)
    })
}

fn dropped(body: BodySpec, summary: &str, height: f64) -> Scene {
    let mut scene = Scene {
        summary: summary.into(),
        ..Scene::one_body(body)
    };
    scene.drop_all(height);
    scene
}
