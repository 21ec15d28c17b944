//! Compares the pipeline with the reference over generated impacts, times both, and shows the effect of other readings of the paper.
//!
//! `cargo run --release -p frangible-lab --example agreement -- [IMPACTS PER BODY]`

use std::error::Error;
use std::sync::OnceLock;
use std::time::Instant;

use frangible::internals::impact_traced;
use frangible::{FractureConfig, impact};
use frangible_lab::reference::agreement::{MARGIN, compare, compare_first_start};
use frangible_lab::reference::bodies::{Case, baked_cases, impact as generate, linear_cases};
use frangible_lab::reference::{
    EnergyTest, Field, Initiation, Marks, Options, TimeStep, first_crack, fracture,
};

fn main() -> Result<(), Box<dyn Error>> {
    let impacts = match std::env::args().nth(1) {
        Some(n) => n.parse()?,
        None => 100,
    };
    let (linear, baked) = (linear_cases()?, baked_cases()?);
    println!(
        "body, tetrahedra: impacts, torn; mismatches outside the margin, inside; pipeline, reference (ms)"
    );
    println!("The paper's model, linear elements:");
    run(&linear, impacts, Field::Linear, false)?;
    println!("The paper's model, quadratic elements:");
    run(&baked, impacts, Field::Embedded, false)?;
    println!("Our model until its first crack, quadratic elements:");
    run(&baked, impacts, Field::Embedded, true)?;
    println!(
        "Readings of the paper, linear elements, means of {} impacts a body:",
        impacts.min(20)
    );
    readings(&linear, impacts.min(20))
}

/// Processor time of this thread if Linux reports it, else the time on the clock; s.
fn seconds() -> f64 {
    static START: OnceLock<Instant> = OnceLock::new();
    let elapsed = || START.get_or_init(Instant::now).elapsed().as_secs_f64();
    std::fs::read_to_string("/proc/thread-self/schedstat")
        .ok()
        .and_then(|text| text.split_whitespace().next()?.parse::<f64>().ok())
        .map_or_else(elapsed, |nanoseconds| nanoseconds * 1e-9)
}

fn run(cases: &[Case], impacts: u64, field: Field, ours: bool) -> Result<(), Box<dyn Error>> {
    let mut config = FractureConfig::with_given_impulses();
    if !ours {
        config = FractureConfig::as_in_the_paper();
        config.crumb_share = 0.0;
    }
    let mut all = [0; 4];
    for case in cases {
        // Tried, torn, outside, inside.
        let mut count = [impacts, 0, 0, 0];
        let (mut pipeline_seconds, mut reference_seconds) = (0.0, 0.0);
        for number in 0..impacts {
            let (body, contacts) = generate(case, number)?;
            let start = seconds();
            impact(&body, &contacts, &config)?;
            pipeline_seconds += seconds() - start;
            let (outcome, trace) = impact_traced(&body, &contacts, &config)?;
            let report = outcome.report();
            let start = seconds();
            let difference = if ours {
                let options = Options::first_crack_of_ours();
                let reference = first_crack(&body, &contacts, field, &options)?;
                reference_seconds += seconds() - start;
                compare_first_start(report, &trace, &reference)
            } else {
                let reference = fracture(&body, &contacts, field, &Options::default())?;
                reference_seconds += seconds() - start;
                compare(report, &trace, &reference)
            };
            count[1] += u64::from(!trace.cracks.is_empty());
            if let Err(mismatch) = difference {
                let inside = mismatch.margin < MARGIN;
                count[if inside { 3 } else { 2 }] += 1;
                println!(
                    "    {number}: {}, margin {:.1e}",
                    mismatch.what, mismatch.margin
                );
            }
        }
        let ms = 1e3 / impacts as f64;
        println!(
            "  {}, {}: {impacts}, {}; {}, {}; {:.1}, {:.1}",
            case.asset.name(),
            case.asset.fracture().tets.len(),
            count[1],
            count[2],
            count[3],
            pipeline_seconds * ms,
            reference_seconds * ms,
        );
        for (sum, n) in all.iter_mut().zip(count) {
            *sum += n;
        }
    }
    let [tried, torn, outside, inside] = all;
    println!("  all: {tried} impacts, {torn} torn; {outside} outside the margin, {inside} inside");
    Ok(())
}

fn readings(cases: &[Case], impacts: u64) -> Result<(), Box<dyn Error>> {
    let default = Options::default();
    let readings = [
        ("as compared above", default),
        (
            "Eq. 3 as printed",
            Options {
                time_step: TimeStep::AsPrinted,
                ..default
            },
        ),
        (
            "half a period a step",
            Options {
                time_step: TimeStep::Nyquist,
                ..default
            },
        ),
        (
            "the nearest weak element",
            Options {
                initiation: Initiation::NearestWeak,
                ..default
            },
        ),
        (
            "Algorithm 2's energy test",
            Options {
                energy_test: EnergyTest::AsPrinted,
                ..default
            },
        ),
        (
            "marks at the nodes",
            Options {
                marks: Marks::Nodes,
                ..default
            },
        ),
        // The constant that gives Hertz' duration for a period of 1 ms, a radius of 2 cm.
        ("all as printed, c = 0.02", Options::as_printed(0.02)),
    ];
    for (name, options) in readings {
        let (mut steps, mut cracks, mut area, mut pieces) = (0, 0, 0.0, 0);
        for case in cases {
            for number in 0..impacts {
                let (body, contacts) = generate(case, number)?;
                let result = fracture(&body, &contacts, Field::Linear, &options)?;
                steps += result.steps;
                cracks += result.cracks.len();
                area += result.cracks.iter().map(|c| c.area).sum::<f64>();
                pieces += result.fragment_of_node.iter().max().map_or(0, |&f| f + 1);
            }
        }
        let count = (cases.len() as u64 * impacts) as f64;
        println!(
            "  {name}: {:.0} steps, {:.1} cracks, {:.1} cm², {:.1} pieces",
            steps as f64 / count,
            cracks as f64 / count,
            area * 1e4 / count,
            f64::from(pieces) / count,
        );
    }
    Ok(())
}
