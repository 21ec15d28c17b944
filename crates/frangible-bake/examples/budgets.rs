//! Prints the table of budgets in `book/src/how-to/games.md`: what a drinking glass takes that lands on stone, by how finely it was baked.

use std::error::Error;
use std::time::Instant;

use frangible::glam::Vec3;
use frangible::{Breakable, Contact, FractureConfig, Material, Outcome, Striker, impact};
use frangible_bake::{BakeSpec, Shape, bake};

/// Speed of the glass, m/s.
const SPEED: f64 = 4.0;
const PLACES: usize = 40;

fn main() -> Result<(), Box<dyn Error>> {
    let glass = Material::preset("glass")?;
    let shape = Shape::drinking_glass();
    let sized = |tets: f64, modes: usize| -> Result<BakeSpec, Box<dyn Error>> {
        Ok(BakeSpec {
            fracture: Some(shape.size_for(tets)?),
            modes,
            ..BakeSpec::new("glass", shape.clone(), glass.clone())
        })
    };
    let specs = [
        BakeSpec::for_games("glass", shape.clone(), glass.clone())?,
        sized(5000.0, 60)?,
        sized(15000.0, 100)?,
        BakeSpec::new("glass", shape.clone(), glass.clone()),
    ];
    println!("| tetrahedra | modes | bake | break | a break, median | at most |");
    println!("|---|---|---|---|---|---|");
    for spec in specs {
        let start = Instant::now();
        let asset = bake(&spec)?;
        let baked = start.elapsed().as_secs_f64();
        let kind = Breakable::uniform(asset)?;
        let (tets, modes) = (kind.asset().fracture().tets.len(), spec.modes);
        let mut times = breaks(&kind)?;
        times.sort_by(f64::total_cmp);
        let broke = times.len();
        let (Some(median), Some(most)) = (times.get(broke / 2), times.last()) else {
            return Err(format!("no blow breaks the glass of {tets} tetrahedra").into());
        };
        let [median, most] = [median, most].map(|time| 1e3 * time);
        println!(
            "| {tets} | {modes} | {baked:.1} s | {broke} of {PLACES} | {median:.1} ms | {most:.1} ms |"
        );
    }
    Ok(())
}

/// Times of the blows that break a glass, s, at places all over its surface, each with weak points of its own.
fn breaks(kind: &Breakable) -> Result<Vec<f64>, Box<dyn Error>> {
    let config = FractureConfig::default();
    let surface = kind.asset().surface();
    let mut times = Vec::new();
    for k in 0..PLACES {
        let triangle = (k * surface.triangles.len() + surface.triangles.len() / 2) / PLACES;
        let corners =
            surface.triangles[triangle].map(|v| kind.asset().surface_positions()[v as usize]);
        let point = corners.iter().sum::<Vec3>() / 3.0;
        let inwards = -surface.normals[triangle][0];
        let stone = Striker::fixed(&Material::preset("stone")?);
        let blow = Contact::collision(kind.asset(), point, inwards, SPEED, stone);
        let body = kind.body(k as u64);
        body.prepare_for_blows(&config);
        let start = Instant::now();
        let outcome = impact(&body, &[blow], &config)?;
        let time = start.elapsed().as_secs_f64();
        if let Outcome::Broke(_) = outcome {
            times.push(time);
        }
    }
    Ok(times)
}
