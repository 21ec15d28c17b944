//! Finds the speed at which a stone breaks a window, and changes nothing: `cargo run --release -p frangible-rapier --example ask`.

use frangible_rapier::rapier3d::dynamics::RigidBodyBuilder;
use std::error::Error;

use frangible::{Breakable, Material, Striker};
use frangible_bake::{BakeSpec, Region, Shape, Support, bake};
use frangible_rapier::rapier3d::prelude::*;
use frangible_rapier::{BreakableWorld, WorldConfig};

fn main() -> Result<(), Box<dyn Error>> {
    let mut spec = BakeSpec::for_games(
        "window",
        Shape::plate(0.6, 0.4, 0.004),
        Material::preset("glass")?,
    )?;
    let edges = [Region::below(0, 0.01), Region::above(0, 0.59)];
    spec.supports = edges.map(Support::clamped).to_vec();
    let kind = Breakable::new(bake(&spec)?)?;
    let mut world = BreakableWorld::new(WorldConfig::default())?;
    let window = world.insert(kind.body(1), RigidBodyBuilder::dynamic())?;

    println!("grams   least speed in the middle, near the frame (m/s)");
    for grams in [5.0_f64, 20.0, 80.0, 320.0] {
        let radius = (grams * 1e-3 / 2600.0 * 0.75 / std::f64::consts::PI).cbrt();
        let stone = Striker::ball(&Material::preset("stone")?, grams * 1e-3, radius);
        let least = |x: f32| -> Result<f32, Box<dyn Error>> {
            // Halving an interval: each question costs a millisecond or two.
            let (mut holds, mut breaks) = (0.1_f32, 60.0_f32);
            while breaks / holds > 1.05 {
                let speed = (holds * breaks).sqrt();
                let point = Vector::new(x, 0.0, 0.002);
                match world.would_break(window, point, Vector::NEG_Z, speed, stone.clone())? {
                    true => breaks = speed,
                    false => holds = speed,
                }
            }
            Ok(breaks)
        };
        println!("{grams:5.0}   {:6.1} {:6.1}", least(0.0)?, least(0.25)?);
    }
    Ok(())
}
