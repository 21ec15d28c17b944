//! Measures of the cracks of the scenes: how many run away from the blow, how many around it, where the first one starts, which parts stay whole. The
//! page docs/real-breaks.md puts them beside descriptions of real breaks.
//!
//!     cargo run --release -p frangible-lab --example real_breaks -- [SEEDS] > docs/real-breaks/measured.md
//!
//! The blow is that of a scene's first break, computed once; only the seed of the weak points changes.

mod broken;
mod features;
mod subjects;

use std::error::Error;

use broken::Broken;
use features::common;
use frangible::internals::impact_traced;
use frangible::{Outcome, impact};
use subjects::{Struck, Subject};

fn main() -> Result<(), Box<dyn Error>> {
    let seeds: u64 = match std::env::args().nth(1) {
        Some(n) => n.parse()?,
        None => 10,
    };
    println!(
        "# Cracks of the scenes, counted\n\n\
         Written by `cargo run --release -p frangible-lab --example real_breaks > docs/real-breaks/measured.md`. \
         [Beside real breaks](../real-breaks.md) says what to make of the numbers. Each blow is given to {seeds} bodies that differ in their \
         weak points; the table has the mean of those that broke, and the smallest and the largest. \
         All cracks count, also those that part nothing.\n\n\
         A crack *runs away* from an axis where its normal lies within 45° of the direction around the axis, and *around* it elsewhere. \
         Of cracks without a preference that stand upright in a wall, half of the area runs away; in a solid, 29 %. \
         An *arm* is a place where cracks that run away from the point of impact cross a circle about it; places less than one and a half \
         edges of a tetrahedron apart are one. A *ring* is such a place on a straight line out from the point of impact, of cracks that run \
         around it. A part counts as a *part* of a zone where it has 2 % of the zone's nodes or more."
    );
    for subject in subjects::all()? {
        measure(&subject, seeds)?;
    }
    slowest(seeds)?;
    Ok(())
}

/// Breaks a subject with every seed, and prints its table.
fn measure(subject: &Subject, seeds: u64) -> Result<(), Box<dyn Error>> {
    let mut broken = Vec::new();
    for seed in 1..=seeds {
        let body = subject.kind.body(seed);
        let (outcome, trace) = impact_traced(&body, &subject.contacts, &subject.config)?;
        broken.extend(Broken::of(subject, outcome, &trace));
    }
    println!("\n## {}\n", subject.title);
    println!("{} of {seeds} broke.\n", broken.len());
    println!("| | mean | least to most |\n|---|---:|---:|");
    for feature in common().iter().chain(&subject.features) {
        let found: Vec<f64> = broken.iter().filter_map(&feature.reading).collect();
        if found.is_empty() {
            println!("| {} | – | |", feature.name);
            continue;
        }
        let mean = found.iter().sum::<f64>() / found.len() as f64;
        let (least, most) = found
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), &x| {
                (a.min(x), b.max(x))
            });
        let shown = |x: f64| match feature.unit {
            "%" => format!("{} %", rounded(100.0 * x, 0)),
            "mm" => format!("{} mm", rounded(1e3 * x, 1)),
            "µs" => format!("{} µs", rounded(1e6 * x, 0)),
            "kN" => format!("{} kN", rounded(1e-3 * x, 1)),
            _ => rounded(x, 1),
        };
        let name = &feature.name;
        println!(
            "| {name} | {} | {} to {} |",
            shown(mean),
            shown(least),
            shown(most)
        );
    }
    Ok(())
}

/// The number is written with so many decimals, and zero has no sign.
fn rounded(x: f64, decimals: usize) -> String {
    let text = format!("{x:.decimals$}");
    match text.strip_prefix('-') {
        Some(size) if size.parse::<f64>() == Ok(0.0) => size.to_string(),
        _ => text,
    }
}

/// Prints how slow a ball of 1 kg still breaks the bottle, hit where the ball of the scene hits it, and how slow a fall the drinking glass, on its
/// rim as in the scene.
fn slowest(seeds: u64) -> Result<(), Box<dyn Error>> {
    let [first, half, last] = slowest_of(&subjects::bottle_and_heavy_ball()?, seeds)?;
    let energy = |speed: f64| 0.5 * speed * speed;
    println!(
        "\n## bottle: the slowest ball of 1 kg that breaks it\n\n\
         A steel ball of 1 kg hits the empty, free bottle from the side, faster by 5 % each time, from {} m/s. Of {seeds} bottles the first \
         breaks at {first:.2} m/s, the last at {last:.2} m/s, half of them at {half:.2} m/s or less: kinetic energies of {:.2}, {:.2} and {:.2} J.",
        subjects::SLOWEST,
        energy(first),
        energy(last),
        energy(half),
    );
    let [first, half, last] = slowest_of(&subjects::falling_glass()?, seeds)?;
    let height = |speed: f64| speed * speed / (2.0 * 9.81);
    println!(
        "\n## glass: the slowest fall that breaks it\n\n\
         The drinking glass falls on its rim on stone, as in its scene, faster by 5 % each time, from {} m/s. Of {seeds} glasses the first \
         breaks at {first:.2} m/s, the last at {last:.2} m/s, half of them at {half:.2} m/s or less: heights of {:.2}, {:.2} and {:.2} m.",
        subjects::SLOWEST,
        height(first),
        height(last),
        height(half),
    );
    Ok(())
}

/// The slowest speeds that break the first body, half of them and the last, m/s.
fn slowest_of(struck: &Struck, seeds: u64) -> Result<[f64; 3], Box<dyn Error>> {
    let mut found = Vec::new();
    for seed in 1..=seeds {
        let body = struck.kind.body(seed);
        let breaks = |speed: f64| -> Result<bool, Box<dyn Error>> {
            let hit = struck.at(speed);
            let outcome = impact(&body, std::slice::from_ref(&hit), &struck.config)?;
            Ok(matches!(outcome, Outcome::Broke(_)))
        };
        let mut speed = subjects::SLOWEST;
        while !breaks(speed)? {
            speed *= 1.05;
        }
        found.push(speed);
    }
    found.sort_by(f64::total_cmp);
    Ok([
        found[0],
        found[(found.len() - 1) / 2],
        found[found.len() - 1],
    ])
}
