//! Two physics engines play equal scenes: `cargo run --release --example engines [-- --write]` plays each with thirty seeds in Rapier and in
//! Avian, and prints a page of the outcomes, or writes it to `docs/engines.md`.

mod alone;
mod in_avian;
mod in_rapier;
mod page;
mod scenes;

use std::error::Error;
use std::path::Path;

use bevy_frangible::FrangibleAsset;
use bevy_frangible::frangible::glam::Quat;
use bevy_frangible::frangible::{Asset, Breakable, Material};
use frangible_bake::{BakeSpec, Region, Shape, Support, bake};

use scenes::{Outcome, RATES, Scene, ball_on_pane, brick_on_plate, dropped};

/// Seeds of each scene.
const SEEDS: u64 = 30;

/// Outcomes of a scene, one for each seed.
#[derive(Default)]
struct Played {
    /// In Rapier and in Avian, with the most steps per second.
    engines: [Vec<Outcome>; 2],
    /// Speed that a ball loses, m/s: without an engine, and in each engine with each number of steps per second. Empty in other scenes.
    alone: Vec<f64>,
    lost: [[Vec<f64>; RATES.len()]; 2],
}

fn kind(spec: &BakeSpec) -> Result<Breakable, Box<dyn Error>> {
    Ok(FrangibleAsset::new(bake(spec)?)?.0)
}

fn all() -> Result<Vec<Scene>, Box<dyn Error>> {
    let [steel, stone, glass, porcelain] =
        ["steel", "stone", "glass", "porcelain"].map(Material::preset);
    let (steel, stone) = (steel?, stone?);
    let bodies = Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates/frangible/tests/bodies");
    let pane = FrangibleAsset::new(Asset::load(bodies.join("pane.frangible"))?)?.0;
    let tumbler = kind(&BakeSpec::for_games(
        "glass",
        Shape::drinking_glass(),
        glass?,
    )?)?;
    let mut plate = BakeSpec::for_games("plate", Shape::plate(0.25, 0.25, 0.006), porcelain?)?;
    let edges = [Region::below(0, 0.01), Region::above(0, 0.24)];
    plate.supports = edges.map(Support::clamped).to_vec();
    let plate = kind(&plate)?;
    // It comes down with the edge of its foot first.
    let tilted = Quat::from_rotation_z(0.6) * Quat::from_rotation_x(-std::f32::consts::FRAC_PI_2);
    let mut scenes: Vec<Scene> = [4.0, 6.0, 12.0, 20.0, 30.0]
        .map(|speed| ball_on_pane(&pane, &steel, speed))
        .to_vec();
    scenes.extend([3.0, 5.0].map(|speed| dropped("glass", &tumbler, &stone, tilted, speed)));
    scenes.extend([2.0, 4.0].map(|speed| brick_on_plate(&plate, &stone, speed)));
    Ok(scenes)
}

fn play(scene: &Scene) -> Result<Played, Box<dyn Error>> {
    let mut played = Played::default();
    for seed in 0..SEEDS {
        let alone = alone::lost(scene, seed)?;
        played.alone.extend(alone);
        for (k, rate) in RATES.into_iter().enumerate() {
            let last = k + 1 == RATES.len();
            if alone.is_none() && !last {
                continue;
            }
            let outcomes = [
                in_rapier::run(scene, seed, rate)?,
                in_avian::run(scene, seed, rate),
            ];
            for (engine, outcome) in outcomes.into_iter().enumerate() {
                if alone.is_some() {
                    played.lost[engine][k].extend(scene.lost(&outcome));
                }
                if last {
                    played.engines[engine].push(outcome);
                }
            }
        }
    }
    Ok(played)
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut played = Vec::new();
    for scene in all()? {
        eprintln!("{}", scene.name);
        let outcomes = play(&scene)?;
        played.push((scene, outcomes));
    }
    let page = page::page(&played);
    if std::env::args().any(|word| word == "--write") {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/engines.md");
        // What follows is not from here: what the example `passage` of Rapier measures, and the section that `cargo xtask c --engines` writes.
        let whole = std::fs::read_to_string(&path).unwrap_or_default();
        let kept = whole.find("\n## Later contacts\n");
        let kept = kept.map_or("", |at| &whole[at..]);
        // Whole under its name, or not at all.
        let draft = path.with_extension("md.new");
        std::fs::write(&draft, page + kept)?;
        std::fs::rename(&draft, &path)?;
    } else {
        print!("{page}");
    }
    Ok(())
}
