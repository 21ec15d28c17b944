//! Compares the pipeline with the reference over generated impacts and times both.
//!
//! `cargo run --release -p frangible-reference --example agreement -- [IMPACTS PER BODY]`

use std::error::Error;
use std::time::Instant;

use frangible::{FractureConfig, impact, impact_traced};
use frangible_reference::agreement::{MARGIN, compare};
use frangible_reference::bodies::{Case, baked_cases, impact as generate, linear_cases};
use frangible_reference::{Field, Options, fracture};

fn main() -> Result<(), Box<dyn Error>> {
    let impacts = match std::env::args().nth(1) {
        Some(n) => n.parse()?,
        None => 100,
    };
    println!(
        "body, elements | impacts, broke, cracked only | outside the margin, inside | pipeline, reference (ms)"
    );
    println!("The paper's elements (linear):");
    for case in linear_cases()? {
        run(&case, Field::Linear, impacts)?;
    }
    println!("Quadratic elements:");
    for case in baked_cases()? {
        run(&case, Field::Embedded, impacts)?;
    }
    Ok(())
}

fn run(case: &Case, field: Field, impacts: u64) -> Result<(), Box<dyn Error>> {
    let mut config = FractureConfig::as_in_the_paper();
    config.crumb_share = 0.0;
    let (mut broke, mut cracked, mut inside, mut outside) = (0, 0, 0, 0);
    let (mut pipeline_seconds, mut reference_seconds) = (0.0, 0.0);
    for number in 0..impacts {
        let (body, contacts) = generate(case, number)?;
        let start = Instant::now();
        impact(&body, &contacts, &config)?;
        pipeline_seconds += start.elapsed().as_secs_f64();
        let (outcome, trace) = impact_traced(&body, &contacts, &config)?;
        let start = Instant::now();
        let reference = fracture(&body, &contacts, field, &Options::default())?;
        reference_seconds += start.elapsed().as_secs_f64();
        if reference.fragment_of_node.iter().any(|&f| f > 0) {
            broke += 1;
        } else if !reference.cracks.is_empty() {
            cracked += 1;
        }
        if let Err(mismatch) = compare(outcome.report(), &trace, &reference) {
            let which = if mismatch.margin < MARGIN {
                &mut inside
            } else {
                &mut outside
            };
            *which += 1;
            println!(
                "  impact {number}: {} (margin {:.1e})",
                mismatch.what, mismatch.margin
            );
        }
    }
    let ms = 1e3 / impacts as f64;
    println!(
        "{}, {} | {impacts}, {broke}, {cracked} | {outside}, {inside} | {:.2}, {:.1}",
        case.asset.name,
        case.asset.fracture.tets.len(),
        pipeline_seconds * ms,
        reference_seconds * ms,
    );
    Ok(())
}
