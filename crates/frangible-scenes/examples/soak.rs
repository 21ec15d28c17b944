//! Memory over ten thousand breaks: tiles rain on a floor, break, and their pieces break again; the oldest bodies are swept away.
//!
//!     cargo run --release -p frangible-scenes --example soak -- [breaks] > soak.csv
//!
//! Prints a line for every two hundredth of the breaks: breaks, breaks of pieces, bodies, breakable ones, resident memory.

use std::collections::VecDeque;
use std::error::Error;
use std::io::Write as _;
use std::sync::Arc;

use frangible::{Breakable, Material};
use frangible_bake::{BakeSpec, MeshSize, Shape, bake};
use frangible_pieces::{Method, Pieces};
use frangible_rapier::rapier3d::dynamics::RigidBodyHandle;
use frangible_rapier::rapier3d::math::{Pose, Vector};
use frangible_rapier::{BreakableWorld, Breaking, SurfaceProperties, WorldConfig};

/// Bodies in the world, but for the floor; the oldest go first.
const MOST: usize = 120;
/// Steps between two tiles.
const EVERY: u64 = 6;

fn main() -> Result<(), Box<dyn Error>> {
    let wanted: usize = match std::env::args().nth(1) {
        Some(number) => number.parse()?,
        None => 10_000,
    };
    let shape = Shape::plate(0.1, 0.1, 0.006);
    let spec = BakeSpec {
        modes: 30,
        fracture: Some(MeshSize {
            edge: 0.006,
            ..shape.fracture_size()?
        }),
        ..BakeSpec::new("tile", shape, Material::preset("porcelain")?)
    };
    let (asset, _) = bake(&spec, &mut |_| {})?;
    eprintln!("{} tetrahedra", asset.fracture.tets.len());
    let kind = Breakable::new(Arc::new(asset))?;
    let mut config = WorldConfig::default();
    config.breaking = Breaking::AfterStep {
        budget: 20_000,
        delay: 0,
    };
    config.dust_mass = 1e-3;
    config.pieces.least_mass = 2e-3;
    let mut world = BreakableWorld::new(config)?;
    let mut pieces = Pieces::new(Method::Auto);
    (pieces.elements, pieces.modes) = (Some(100), 15);
    world.set_piece_model(Some(Arc::new(pieces)));
    world.insert_fixed_half_space(Vector::ZERO, Vector::Y, SurfaceProperties::STONE)?;
    let (mut breaks, mut again, mut told) = (0, 0, 0);
    let mut bodies: VecDeque<RigidBodyHandle> = VecDeque::new();
    let mut out = std::io::stdout().lock();
    writeln!(out, "breaks,breaks of pieces,bodies,breakable,resident MB")?;
    for step in 0_u64.. {
        if step % EVERY == 0 {
            let turn = 0.37 * step as f32;
            let place = Vector::new(0.5 * turn.sin(), 1.0, 0.5 * (1.7 * turn).cos());
            let pose = Pose::new(place, Vector::new(turn.cos(), 0.0, turn.sin()));
            let down = Vector::new(0.0, -7.0, 0.0);
            let tile = world.insert_breakable(kind.body(step), pose, down, Vector::ZERO)?;
            bodies.push_back(tile);
        }
        for event in world.step()? {
            breaks += 1;
            again += usize::from(event.asset.portion.is_some());
            bodies.extend(&event.fragments);
        }
        bodies.retain(|&h| world.physics.bodies.contains(h));
        while bodies.len() > MOST {
            if let Some(oldest) = bodies.pop_front() {
                world.physics.remove_body(oldest);
            }
        }
        if breaks * 200 / wanted > told {
            told = breaks * 200 / wanted;
            let (all, breakable) = (world.physics.bodies.len(), world.breakables().count());
            let resident = resident_mb();
            writeln!(out, "{breaks},{again},{all},{breakable},{resident:.1}")?;
            out.flush()?;
        }
        if breaks >= wanted {
            break;
        }
    }
    Ok(())
}

/// Resident memory of this process, MB; zero where the system does not tell.
fn resident_mb() -> f64 {
    let pages = std::fs::read_to_string("/proc/self/statm").ok();
    let pages = pages.and_then(|all| all.split_whitespace().nth(1)?.parse::<f64>().ok());
    pages.map_or(0.0, |pages| pages * 4096.0 / 1e6)
}
