//! Bodies baked once per test program, and blows on them.

pub(crate) mod drawn;
pub(crate) mod made;

use std::sync::{Arc, OnceLock};

use frangible::glam::Vec3;
use frangible::{Asset, Breakable, Contact, FractureConfig, Material, Outcome, Striker, impact};
use frangible_bake::{BakeSpec, Shape, bake};

/// A fracture mesh with edges `coarser` times the default's, and few modes.
fn bake_small(name: &str, shape: Shape, material: &str, modes: usize, coarser: f64) -> Arc<Asset> {
    let mut size = shape.fracture_size().unwrap();
    size.edge *= coarser;
    let material = Material::preset(material).unwrap();
    let spec = BakeSpec {
        modes,
        fracture: Some(size),
        ..BakeSpec::new(name, shape, material)
    };
    Arc::new(bake(&spec).unwrap())
}

/// Drinking glass, axis z, rim on top.
pub(crate) fn glass() -> &'static Arc<Asset> {
    static ASSET: OnceLock<Arc<Asset>> = OnceLock::new();
    ASSET.get_or_init(|| bake_small("glass", Shape::drinking_glass(), "glass", 40, 1.5))
}

/// Window pane 0.3 × 0.3 m, 4 mm thick, its normal z.
pub(crate) fn pane() -> &'static Arc<Asset> {
    static ASSET: OnceLock<Arc<Asset>> = OnceLock::new();
    ASSET.get_or_init(|| bake_small("pane", Shape::plate(0.3, 0.3, 0.004), "glass", 40, 2.4))
}

/// Brick.
pub(crate) fn block() -> &'static Arc<Asset> {
    static ASSET: OnceLock<Arc<Asset>> = OnceLock::new();
    ASSET.get_or_init(|| bake_small("block", Shape::block([0.21, 0.1, 0.05]), "brick", 40, 1.8))
}

/// Steel ball of this mass, kg.
pub(crate) fn steel_ball(mass: f64) -> Striker {
    let steel = Material::preset("steel").unwrap();
    let radius = (mass / steel.density * 0.75 / std::f64::consts::PI).cbrt();
    Striker::ball(&steel, mass, radius).with_restitution(0.5)
}

/// Level stone floor.
pub(crate) fn stone_floor() -> Striker {
    Striker::fixed(&Material::preset("stone").unwrap()).with_restitution(0.5)
}

/// A blow at `point` in direction `normal`, with the impulse of a central rigid-body collision at `speed`.
pub(crate) fn blow(
    asset: &Asset,
    point: Vec3,
    normal: Vec3,
    speed: f64,
    striker: Striker,
) -> Contact {
    Contact::collision(asset, point, normal, speed, striker)
}

/// The outermost node near the rim at this azimuth, degrees.
pub(crate) fn rim_point(asset: &Asset, degrees: f32) -> Vec3 {
    let top = asset
        .fracture()
        .positions
        .iter()
        .map(|p| p.z)
        .fold(f32::MIN, f32::max);
    let (sin, cos) = degrees.to_radians().sin_cos();
    let radius = asset
        .fracture()
        .positions
        .iter()
        .map(|p| p.truncate().length())
        .fold(0.0, f32::max);
    Vec3::new(radius * cos, radius * sin, top - 0.002)
}

/// A steel ball of 60 g hits the glass at its rim, from outside and a little from above.
pub(crate) fn rim_hit(degrees: f32, speed: f64) -> Contact {
    let point = rim_point(glass(), degrees);
    let inwards = -Vec3::new(point.x, point.y, 0.0).normalize();
    blow(
        glass(),
        point,
        inwards + 0.3 * Vec3::NEG_Z,
        speed,
        steel_ball(0.06),
    )
}

/// A steel ball of 130 g hits the pane at (x, y).
pub(crate) fn pane_hit(x: f32, y: f32, speed: f64) -> Contact {
    blow(
        pane(),
        Vec3::new(x, y, 0.002),
        Vec3::NEG_Z,
        speed,
        steel_ball(0.13),
    )
}

/// The block lands on its corner, its centre above it.
pub(crate) fn corner_hit(speed: f64) -> Contact {
    let corner = Vec3::new(0.105, 0.05, -0.025);
    blow(block(), corner, -corner, speed, stone_floor())
}

pub(crate) fn strike(
    asset: &Arc<Asset>,
    seed: u64,
    contacts: &[Contact],
    config: &FractureConfig,
) -> Outcome {
    impact(
        &Breakable::uniform(Arc::clone(asset)).unwrap().body(seed),
        contacts,
        config,
    )
    .unwrap()
}

pub(crate) fn pieces(outcome: &Outcome) -> usize {
    match outcome {
        Outcome::Broke(fracture) => fracture.fragments.len(),
        _ => 1,
    }
}

/// Mean of a number over seeds 1..=n.
pub(crate) fn mean(seeds: u64, f: impl Fn(u64) -> f64) -> f64 {
    (1..=seeds).map(f).sum::<f64>() / seeds as f64
}
