//! Memory over ten thousand breaks of pieces: tiles rain on a floor and break; pieces that can break again are thrown at the floor anew,
//! until they are too small; the oldest bodies are swept away.
//!
//!     cargo run --release -p frangible-lab --example soak -- 10000 docs
//!
//! The number is that of the breaks of pieces. Prints a line for every two hundredth of them: breaks of pieces, of tiles, the most breaks
//! that a piece comes from, bodies, breakable ones, resident memory; and writes `soak.md` and `soak.png` into the folder, if one is given.

use std::collections::VecDeque;
use std::error::Error;
use std::io::Write as _;
use std::path::Path;
use std::sync::Arc;

use frangible::{Body, Breakable, Material};
use frangible_bake::pieces::{Method, Pieces};
use frangible_bake::{BakeSpec, MeshSize, Shape, bake};
use frangible_lab::plot::{Axis, Chart, Marker, Series, png};
use frangible_rapier::rapier3d::dynamics::{RigidBodyBuilder, RigidBodyHandle};
use frangible_rapier::rapier3d::math::{Pose, Vector};
use frangible_rapier::{BreakableWorld, Breaking, SurfaceProperties, WorldConfig};

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

fn main() -> Result<(), Box<dyn Error>> {
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
    let mut curve: Vec<[f64; 6]> = Vec::new();
    let (mut tiles, mut again, mut deepest, mut told) = (0, 0, 0, 0);
    let mut bodies: VecDeque<RigidBodyHandle> = VecDeque::new();
    let mut out = std::io::stdout().lock();
    writeln!(
        out,
        "breaks of pieces,of tiles,most breaks in a row,bodies,breakable,resident MB"
    )?;
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
            let (all, breakable) = (world.physics.bodies.len(), world.breakables().count());
            let resident = resident_mb();
            writeln!(
                out,
                "{again},{tiles},{deepest},{all},{breakable},{resident:.1}"
            )?;
            out.flush()?;
            curve.push([
                again as f64,
                tiles as f64,
                f64::from(deepest),
                all as f64,
                breakable as f64,
                resident,
            ]);
        }
        if again >= wanted {
            break;
        }
    }
    match std::env::args().nth(2) {
        Some(folder) => write(Path::new(&folder), &curve),
        None => Ok(()),
    }
}

/// The memory's curve as a picture, and some of its points as a table.
fn write(folder: &Path, curve: &[[f64; 6]]) -> Result<(), Box<dyn Error>> {
    let chart = Chart {
        title: "Resident memory over breaks of pieces".into(),
        x: Axis::linear("breaks of pieces"),
        y: Axis::linear("MB").including(0.0),
        series: vec![Series {
            name: "the whole process".into(),
            points: curve.iter().map(|row| (row[0], row[5])).collect(),
            marker: Marker::Nothing,
            line: true,
        }],
    };
    std::fs::write(folder.join("soak.png"), png(&chart.draw(720, 420))?)?;
    let wanted = curve.last().map_or(0.0, |row| row[0]);
    let mut page = format!(
        "# Memory over {wanted} breaks of pieces\n\nGenerated by the example `soak` of `frangible-lab`: porcelain tiles rain on a stone floor and break. \
         Their pieces are\nthrown at the floor anew, and break again, until they weigh less than {LEAST_MASS} kg or come from more than \
         {GENERATIONS} breaks; the oldest bodies are\nswept away. All tiles share one asset and pieces their tile's mesh.\n\n\
         ![Resident memory over breaks of pieces](soak.png)\n\n\
         | breaks of pieces | of tiles | breaks in a row, at most | bodies | breakable | resident, MB |\n| --- | --- | --- | --- | --- | --- |\n",
    );
    for row in curve
        .iter()
        .step_by(curve.len().div_ceil(11).max(1))
        .chain(curve.last())
    {
        let [again, tiles, deepest, bodies, breakable, resident] = row;
        page += &format!(
            "| {again} | {tiles} | {deepest} | {bodies} | {breakable} | {resident:.1} |\n"
        );
    }
    Ok(std::fs::write(folder.join("soak.md"), page)?)
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
