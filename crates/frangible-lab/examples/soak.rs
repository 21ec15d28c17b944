//! Memory over ten thousand breaks of pieces: tiles rain on a floor and break; pieces that can break again are thrown at the floor anew,
//! until they are too small; the oldest bodies are swept away.
//!
//!     cargo run --release -p frangible-lab --example soak -- 10000
//!
//! The number is that of the breaks of pieces. Prints JSON, for `docs/data/soak.json`, with a row for every two hundredth of them.

use std::collections::VecDeque;
use std::sync::Arc;

use frangible::{Body, Breakable, Material};
use frangible_bake::pieces::{Method, Pieces};
use frangible_bake::{BakeSpec, MeshSize, Shape, bake};
use frangible_lab::data::{Measures, stored};
use frangible_rapier::rapier3d::dynamics::{RigidBodyBuilder, RigidBodyHandle};
use frangible_rapier::rapier3d::math::{Pose, Vector};
use frangible_rapier::{BreakableWorld, Breaking, SurfaceProperties, WorldConfig};
use serde_json::json;

/// Bodies in the world, but for the floor; the oldest go first.
const MOST: usize = 150;
/// Steps between two tiles.
const TILES: u64 = 120;
/// Steps between two throws of a piece.
const THROWS: u64 = 2;
/// Speed at which tiles set out for the floor, 1 m below, m/s.
const TILE_SPEED: f32 = 5.0;
/// Speed at which pieces set out for the floor, 0.3 m below, m/s.
const PIECE_SPEED: f32 = 8.0;
/// Lighter pieces do not break again and fall through the floor, kg.
const LEAST_MASS: f32 = 2e-2;
/// A piece breaks again if it comes from fewer breaks than this.
const GENERATIONS: u32 = 6;

fn main() -> frangible_lab::Result<()> {
    let wanted: usize = match std::env::args().nth(1) {
        Some(number) => number.parse()?,
        None => 10_000,
    };
    let shape = Shape::plate(0.2, 0.2, 0.01);
    let spec = BakeSpec {
        modes: 30,
        fracture: Some(MeshSize {
            edge: 0.015,
            ..shape.fracture_size()?
        }),
        ..BakeSpec::new("tile", shape, Material::preset("porcelain")?)
    };
    let asset = bake(&spec)?;
    eprintln!("{} tetrahedra", asset.fracture().tets.len());
    let kind = Breakable::uniform(Arc::new(asset))?;
    let mut config = WorldConfig::default();
    config.breaking = Breaking::AfterStep {
        budget: 20_000,
        delay: 0,
    };
    config.dust_mass = LEAST_MASS;
    config.pieces.least_mass = LEAST_MASS;
    config.pieces.least_tets = 20;
    config.pieces.generations = GENERATIONS;
    let mut world = BreakableWorld::new(config)?;
    let mut pieces = Pieces::new(Method::Auto);
    (pieces.elements, pieces.modes) = (Some(40), 8);
    world = world.with_piece_model(pieces);
    world.insert_fixed_half_space(Vector::ZERO, Vector::Y, SurfaceProperties::STONE)?;
    let mut curve = Vec::new();
    let (mut tiles, mut again, mut deepest, mut told) = (0, 0, 0, 0);
    let mut bodies: VecDeque<RigidBodyHandle> = VecDeque::new();
    for step in 0_u64.. {
        let turn = 0.37 * step as f32;
        let tile = step % TILES == 0;
        let (height, speed) = if tile {
            (1.0, TILE_SPEED)
        } else {
            (0.3, PIECE_SPEED)
        };
        let place = Vector::new(0.5 * turn.sin(), height, 0.5 * (1.7 * turn).cos());
        let pose = Pose::new(place, Vector::new(turn.cos(), 0.0, turn.sin()));
        let down = Vector::new(0.0, -speed, 0.0);
        if tile {
            let tile = world.insert(
                kind.body(step),
                RigidBodyBuilder::dynamic().pose(pose).linvel(down),
            )?;
            bodies.push_back(tile);
        } else if step % THROWS == 0 {
            // The piece that has been breakable for longest, and behind all others next time.
            let of_piece = |h: &RigidBodyHandle| world.breakable(*h).is_some_and(is_piece);
            let next = bodies.iter().position(of_piece);
            if let Some(piece) = next.and_then(|at| bodies.remove(at)) {
                bodies.push_back(piece);
                if let Some(body) = world.physics.bodies.get_mut(piece) {
                    body.set_position(pose, true);
                    body.set_linvel(down, true);
                    body.set_angvel(Vector::ZERO, true);
                }
            }
        }
        for event in world.step()? {
            match event.asset.portion() {
                Some(portion) => {
                    again += 1;
                    deepest = deepest.max(portion.generation() + 1);
                }
                None => tiles += 1,
            }
            bodies.extend(&event.fragments);
        }
        bodies.retain(|&h| world.physics.bodies.contains(h));
        while bodies.len() > MOST {
            if let Some(oldest) = bodies.pop_front() {
                world.physics.remove_body(oldest);
            }
        }
        if again * 200 / wanted > told {
            told = again * 200 / wanted;
            curve.push(json!({
                "of_pieces": again,
                "of_tiles": tiles,
                "in_a_row": deepest,
                "bodies": world.physics.bodies.len(),
                "breakable": world.breakables().count(),
                "resident_mb": resident_mb(),
            }));
        }
        if again >= wanted {
            break;
        }
    }
    println!(
        "{:#}",
        stored(
            Measures::Scenes,
            true,
            &json!({ "breaks": again, "curve": curve })
        )?
    );
    Ok(())
}

fn is_piece(body: &Body) -> bool {
    body.asset().portion().is_some()
}

/// Resident memory of this process, MB; zero where the system does not tell.
fn resident_mb() -> f64 {
    let pages = std::fs::read_to_string("/proc/self/statm").ok();
    let pages = pages.and_then(|all| all.split_whitespace().nth(1)?.parse::<f64>().ok());
    pages.map_or(0.0, |pages| pages * 4096.0 / 1e6)
}
