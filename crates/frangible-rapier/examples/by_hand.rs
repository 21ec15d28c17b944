//! A blow on a plate without an engine: question, blow, and outcome. `cargo run --release -p frangible-rapier --example by_hand`.

use std::error::Error;

use frangible::glam::Vec3;
use frangible::{Body, Contact, FractureConfig, Material, Outcome, Striker, impact, would_break};
use frangible_bake::{BakeSpec, Shape, bake};

fn main() -> Result<(), Box<dyn Error>> {
    // Once for each kind of object: tetrahedra and vibration modes of a porcelain plate of 20 × 20 × 0.8 cm.
    let porcelain = Material::preset("porcelain")?;
    let spec = BakeSpec::for_games("tile", Shape::plate(0.2, 0.2, 0.008), porcelain)?;
    let asset = bake(&spec)?;
    println!("lowest mode: {:.0} Hz", asset.modes().frequency(0));

    // One body of that kind. The seed says where its weak points are; the origin is its centre of mass.
    let body = Body::new(asset.into(), 1)?;
    let config = FractureConfig::default();

    // A steel ball of 100 g and 14.5 mm radius comes down on the middle of the upper face.
    let ball = Striker::ball(&Material::preset("steel")?, 0.1, 0.0145);
    let (middle, down) = (Vec3::new(0.0, 0.0, 0.004), Vec3::NEG_Z);
    for speed in [0.5, 2.0, 8.0] {
        let blow = [Contact::strike(middle, down, speed, ball.clone())];
        if !would_break(&body, &blow, &config)? {
            println!("{speed} m/s: it holds");
        } else if let Outcome::Broke(fracture) = impact(&body, &blow, &config)? {
            let report = &fracture.report;
            println!(
                "{speed} m/s: {} pieces, {} cracks of {:.0} cm² after {:.0} µs",
                fracture.fragments.len(),
                report.cracks,
                1e4 * report.crack_area,
                1e6 * report.first_crack_time.unwrap_or(0.0)
            );
            let mass: f64 = fracture.fragments.iter().map(|piece| piece.mass.mass).sum();
            println!("  the pieces weigh {:.1} g together", 1e3 * mass);
        }
    }
    Ok(())
}
