//! A hundred pots under a budget: work is spread over frames, so that none takes long.
//! `cargo run --release -p frangible-rapier --example pots`

use frangible_rapier::rapier3d::dynamics::RigidBodyBuilder;
use std::error::Error;
use std::time::{Duration, Instant};

use frangible::{Breakable, Material};
use frangible_bake::{BakeSpec, Shape, bake};
use frangible_rapier::rapier3d::math::{Pose, Vector};
use frangible_rapier::{BreakableWorld, SurfaceProperties, WorldConfig};

fn main() -> Result<(), Box<dyn Error>> {
    let spec = BakeSpec::for_games("pot", Shape::bowl(), Material::preset("porcelain")?)?;
    let kind = Breakable::new(bake(&spec)?)?;

    // One pot a frame at most; the fracture has three frames for each, on other threads.
    let mut config = WorldConfig::for_games();
    // Pieces below 10 g are debris, of which 100 are kept; those below 2 g are dust, and gone after a second.
    (config.debris_mass, config.dust_mass, config.max_debris) = (1e-2, 2e-3, 100);
    let mut world = BreakableWorld::new(config)?;
    world.insert_fixed_half_space(Vector::ZERO, Vector::Y, SurfaceProperties::STONE)?;
    for i in 0..100_u8 {
        let (row, column) = (f32::from(i / 10), f32::from(i % 10));
        let start = Pose::translation(0.25 * row, 1.0 + 0.15 * column, 0.25 * column);
        world.insert(
            kind.body(u64::from(i)),
            RigidBodyBuilder::dynamic().pose(start),
        )?;
    }

    let (mut broke, mut frames) = (0, Vec::new());
    for _ in 0..180 {
        let clock = Instant::now();
        broke += world.step()?.len();
        frames.push(1e3 * clock.elapsed().as_secs_f64());
        // The next frame begins when it is due; other threads have the time in between.
        std::thread::sleep(Duration::from_millis(16).saturating_sub(clock.elapsed()));
    }
    frames.sort_by(f64::total_cmp);
    let [median, late, longest] = [90, 178, 179].map(|k| frames[k]);
    println!(
        "{broke} pots broke; {} bodies are in the world",
        world.physics.bodies.len()
    );
    println!(
        "frames: {median:.1} ms in the median, {late:.1} ms the 99th of 100, {longest:.1} ms the longest"
    );
    Ok(())
}
