//! Speed of a ball behind the pane that it breaks, by the length of a step and by the detail of the pieces' colliders, to tell the blow's part
//! from the engine's. A measuring tool: `cargo run --release -p frangible-rapier --example passage -- 20 40` throws at
//! 20 m/s with forty seeds.

use std::error::Error;
use std::f32::consts::PI;
use std::sync::Arc;

use frangible::internals::Fields;
use frangible::{Asset, Breakable, Material};
use frangible_rapier::rapier3d::geometry::SharedShape;
use frangible_rapier::rapier3d::math::{Pose, Vector};
use frangible_rapier::{
    BreakableWorld, ColliderDetail, SurfaceProperties, WorldConfig, WorldError,
};

/// Parts of a piece's collider, points of each, and the largest share of a hull's volume that is not the piece's.
const DETAILS: [(usize, usize, f32); 2] = [(12, 48, 1.15), (4, 24, 1.5)];

/// Steps per second.
const RATES: [f32; 4] = [240.0, 480.0, 960.0, 1920.0];

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args().skip(1);
    let speed: f32 = words.next().map_or(Ok(20.0), |word| word.parse())?;
    let seeds: u64 = words.next().map_or(Ok(40), |word| word.parse())?;
    let bodies = concat!(env!("CARGO_MANIFEST_DIR"), "/../frangible/tests/bodies");
    let pane = Asset::load(format!("{bodies}/pane.frangible"))?;
    let fields = Fields::of_material(&pane.material);
    let pane = Breakable::new(Arc::new(pane))?.with_fields(fields)?;
    let steel = Material::preset("steel")?;
    println!(
        "| steps per second | parts, points, hull | broke | speed at the end, m/s |\n|---|---|---|---|"
    );
    for detail in DETAILS {
        for rate in RATES {
            let ends = (0..seeds).map(|seed| thrown((&pane, &steel), seed, (speed, rate), detail));
            let ends = ends.collect::<Result<Vec<_>, _>>()?;
            let broke = ends.iter().filter(|(_, broke)| *broke).count();
            let n = seeds as f64;
            let mean = ends.iter().map(|(end, _)| end).sum::<f64>() / n;
            let squares: f64 = ends.iter().map(|(end, _)| (end - mean).powi(2)).sum();
            let error = (squares / (n * (n - 1.0))).sqrt();
            println!("| {rate} | {detail:?} | {broke} of {seeds} | {mean:.2} ± {error:.2} |");
        }
    }
    Ok(())
}

/// The ball's speed after 0.06 s of one throw and its flight, m/s, and whether the pane broke.
fn thrown(
    (pane, steel): (&Breakable, &Material),
    seed: u64,
    (speed, rate): (f32, f32),
    (parts, hull_points, ratio): (usize, usize, f32),
) -> Result<(f64, bool), WorldError> {
    let mut config = WorldConfig::plain();
    (config.gravity, config.dt) = (Vector::ZERO, 1.0 / rate);
    config.fragment_collider = ColliderDetail { parts, hull_points };
    config.hull_volume_ratio = ratio;
    let mut world = BreakableWorld::new(config)?;
    world.insert_breakable(pane.body(seed), Pose::IDENTITY, Vector::ZERO, Vector::ZERO)?;
    let radius = 0.0158_f32;
    let mass = steel.density as f32 * 4.0 / 3.0 * PI * radius.powi(3);
    let (shape, surface) = (
        SharedShape::ball(radius),
        SurfaceProperties::of(steel, radius),
    );
    let start = Pose::translation(0.01, 0.005, 0.1);
    let ball = world.insert_rigid(shape, mass, surface, start, Vector::NEG_Z * speed)?;
    let mut broke = false;
    for _ in 0..((0.06 + 0.1 / speed) * rate) as usize {
        broke |= !world.step()?.is_empty();
    }
    let end = world
        .physics
        .bodies
        .get(ball)
        .map_or(Vector::ZERO, |b| b.linvel());
    Ok((f64::from(-end.z), broke))
}
