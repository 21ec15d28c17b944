//! A level designer paints where a plate is weak, and there it breaks: `cargo run --release -p frangible-rapier --example painted`.

use std::error::Error;
use std::sync::Arc;

use frangible::internals::{Factors, Fields};
use frangible::{Breakable, Material, Striker, impact};
use frangible_bake::{BakeSpec, Shape, bake};
use frangible_rapier::rapier3d::prelude::*;

fn main() -> Result<(), Box<dyn Error>> {
    let porcelain = Material::preset("porcelain")?;
    let spec = BakeSpec::for_games("tile", Shape::plate(0.3, 0.2, 0.008), porcelain.clone())?;
    let asset = Arc::new(bake(&spec)?);

    // A quarter of the strength along a scored line; a game would take it from vertex colours (`frangible_bake::weakness::from_paint`).
    let scored = Fields::from_function(&asset, |p| {
        let on_the_line = (p.x - 0.05).abs() < 0.012;
        if on_the_line {
            Factors::of_strength(0.25)
        } else {
            Factors::ONE
        }
    });
    let plain = Fields::of_material(&porcelain);

    let mallet = Striker::ball(&Material::preset("rubber")?, 0.3, 0.05);
    for (name, fields) in [
        ("plain", plain),
        ("scored", scored.scattered_as(&porcelain)),
    ] {
        let kind = Breakable::new(Arc::clone(&asset))?.with_fields(fields)?;
        let body = kind.body(1);
        let point = Vector::new(0.0, 0.0, 0.004);
        let blow = frangible::Contact::strike(point, Vector::NEG_Z, 8.0, mallet.clone());
        let outcome = impact(
            &body,
            std::slice::from_ref(&blow),
            &frangible::FractureConfig::default(),
        )?;
        let report = outcome.report();
        match report.first_crack_point {
            Some(at) => println!("{name}: first crack at x = {:+.3} m", at.x),
            None => println!("{name}: no crack"),
        }
    }
    Ok(())
}
