//! Effect of the residual vector, which stands for the modes that are not followed.

use frangible::glam::Vec3;
use frangible::internals::stress::largest_eigenvalue;
use frangible::{Asset, Body, Contact, FractureConfig, Material, Striker};
use frangible_bake::{BakeError, BakeSpec, Shape, bake};
use serde_json::{Value, json};

use crate::verify::blows::probe::{blow, body, following};

/// Modes of each body.
const MODES: usize = 400;

/// Peak stress over that of all modes.
pub(super) fn compute() -> Result<Vec<Value>, BakeError> {
    let of = |shape: Shape, name: &str| -> Result<Asset, BakeError> {
        let mut material = Material::preset(name).expect("brick and glass are presets");
        material.weak_point_density = 1e15;
        let spec = BakeSpec {
            modes: MODES,
            analysis: Some(shape.size_for(1500.0)?),
            fracture: Some(shape.size_for(9000.0)?),
            ..BakeSpec::new(name, shape, material)
        };
        bake(&spec)
    };
    let brick = of(Shape::block([0.21, 0.1, 0.05]), "brick")?;
    let glass = of(Shape::drinking_glass(), "glass")?;
    let corner = Vec3::new(-0.105, -0.05, -0.025);
    let cases = [
        (&brick, "brick on its corner", corner, -corner, 80),
        (
            &brick,
            "brick on its face",
            Vec3::new(0.03, 0.01, -0.025),
            Vec3::Z,
            80,
        ),
        (
            &glass,
            "glass on its rim",
            Vec3::new(0.0375, 0.0, 0.05),
            Vec3::new(-0.6, 0.0, -0.8),
            120,
        ),
        (
            &glass,
            "glass on its wall",
            Vec3::new(0.0365, 0.0, 0.005),
            Vec3::NEG_X,
            120,
        ),
    ];
    let stone = Striker::fixed(&Material::preset("stone").expect("stone is a preset"));
    let mut rows = Vec::new();
    for (asset, name, point, normal, followed) in cases {
        let contact = Contact::strike(point, normal.normalize(), 3.0, stone.clone());
        let peak = |modes: usize, residual: bool| {
            let mut config = FractureConfig::default();
            (config.residual, config.near_field) = (residual, None);
            let body = body(following(asset.clone(), modes))?;
            largest(&body, contact.clone(), &config)
        };
        let all = peak(MODES, true)?;
        let [without, with] = [peak(followed, false)? / all, peak(followed, true)? / all];
        rows.push(json!({ "name": name, "followed": followed, "without": without, "with": with }));
    }
    Ok(rows)
}

/// Largest tension over time, near the contact and at some places elsewhere, Pa.
fn largest(body: &Body, contact: Contact, config: &FractureConfig) -> Result<f64, BakeError> {
    let blow = blow(body, contact, config)?;
    let report = &blow.reports()[0];
    let mesh = body.asset().fracture();
    let near = |&e: &u32| mesh.centroid(e as usize).distance(report.point) < 0.02;
    let (under, rest): (Vec<u32>, Vec<u32>) = body.weak_tets().iter().partition(|e| near(e));
    let under = under.iter().step_by((under.len() / 150).max(1));
    let tets: Vec<u32> = under.chain(rest.iter().step_by(60)).copied().collect();
    let steps = report.force.len();
    let mut most = 0.0_f32;
    for step in (0..steps).step_by((steps / 24).max(1)) {
        for &tet in &tets {
            most = most.max(largest_eigenvalue(&blow.stress(body, tet, step, config)));
        }
    }
    Ok(f64::from(most))
}
