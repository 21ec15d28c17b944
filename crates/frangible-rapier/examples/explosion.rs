//! An explosion between three panes: `cargo run --release -p frangible-rapier --example explosion`.

use frangible_rapier::rapier3d::dynamics::RigidBodyBuilder;
use std::error::Error;

use frangible::{Breakable, Material};
use frangible_bake::{BakeSpec, Region, Shape, Support, bake};
use frangible_rapier::rapier3d::math::{Pose, Vector};
use frangible_rapier::{BreakCause, BreakableWorld, WorldConfig};

fn main() -> Result<(), Box<dyn Error>> {
    let mut spec = BakeSpec::for_games(
        "pane",
        Shape::plate(0.6, 0.4, 0.004),
        Material::preset("glass")?,
    )?;
    let edges = [Region::below(0, 0.01), Region::above(0, 0.59)];
    spec.supports = edges.map(Support::clamped).to_vec();
    let kind = Breakable::new(bake(&spec)?)?;
    let mut world = BreakableWorld::new(WorldConfig::default())?;
    let mut panes = Vec::new();
    for (seed, distance) in [(1, 0.5), (2, 2.0), (3, 8.0)] {
        let pose = Pose::translation(0.0, 0.0, -distance);
        let pane = world.insert(kind.body(seed), RigidBodyBuilder::dynamic().pose(pose))?;
        panes.push((pane, distance));
    }

    // 30 Pa·s at one metre within a third of a millisecond: some ten grams of explosive.
    world.blast(Vector::ZERO, 30.0, 3e-4)?;
    let mut broke = Vec::new();
    for _ in 0..30 {
        for event in world.step()? {
            assert_eq!(event.cause, BreakCause::Blast);
            broke.push((event.parent, event.fragments.len()));
        }
    }
    for (pane, distance) in panes {
        match broke.iter().find(|(parent, _)| *parent == pane) {
            Some((_, pieces)) => println!("{distance} m away: {pieces} pieces"),
            None => println!("{distance} m away: whole"),
        }
    }
    Ok(())
}
