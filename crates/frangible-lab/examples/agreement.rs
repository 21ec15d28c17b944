//! Compares the pipeline with the reference over generated impacts, and shows the effect of other readings of the paper.
//!
//! `cargo run --release -p frangible-lab --example agreement -- [IMPACTS PER BODY]` prints JSON, for `docs/data/agreement.json`.

use frangible::FractureConfig;
use frangible::internals::impact_traced;
use frangible_lab::Result;
use frangible_lab::data::{Measures, stored};
use frangible_lab::reference::agreement::{MARGIN, compare, compare_first_start};
use frangible_lab::reference::bodies::{Case, baked_cases, impact as generate, linear_cases};
use frangible_lab::reference::{
    EnergyTest, Field, Initiation, Marks, Options, TimeStep, first_crack, fracture,
};
use serde_json::{Value, json};

/// Impacts on each body for the means of a reading, at most.
const READ: u64 = 20;

fn main() -> Result<()> {
    let impacts = std::env::args().nth(1).map_or(Ok(60), |n| n.parse())?;
    let (linear, baked) = (linear_cases()?, baked_cases()?);
    let agreement = [
        agreement(
            "the paper's model, linear elements",
            &linear,
            impacts,
            Field::Linear,
            false,
        )?,
        agreement(
            "the paper's model, quadratic elements",
            &baked,
            impacts,
            Field::Embedded,
            false,
        )?,
        agreement(
            "ours until its first crack",
            &baked,
            impacts,
            Field::Embedded,
            true,
        )?,
    ];
    let readings = readings(&linear, impacts.min(READ))?;
    let found = json!({ "agreement": agreement, "readings": readings });
    println!("{:#}", stored(Measures::Model, false, &found)?);
    Ok(())
}

fn agreement(model: &str, cases: &[Case], impacts: u64, field: Field, ours: bool) -> Result<Value> {
    let mut config = FractureConfig::with_given_impulses();
    if !ours {
        config = FractureConfig::as_in_the_paper();
        config.crumb_share = 0.0;
    }
    let (mut torn, mut inside, mut outside) = (0, 0, Vec::new());
    for case in cases {
        for number in 0..impacts {
            let (body, contacts) = generate(case, number)?;
            let (outcome, trace) = impact_traced(&body, &contacts, &config)?;
            let difference = if ours {
                let options = Options::first_crack_of_ours();
                let reference = first_crack(&body, &contacts, field, &options)?;
                compare_first_start(outcome.report(), &trace, &reference)
            } else {
                let reference = fracture(&body, &contacts, field, &Options::default())?;
                compare(outcome.report(), &trace, &reference)
            };
            torn += u64::from(!trace.cracks.is_empty());
            match difference {
                Err(other) if other.margin < MARGIN => inside += 1,
                Err(other) => outside.push(json!({
                    "body": case.asset.name(), "impact": number, "what": other.what, "margin": other.margin,
                })),
                Ok(()) => {}
            }
        }
    }
    let tried = impacts * cases.len() as u64;
    Ok(
        json!({ "model": model, "impacts": tried, "torn": torn, "inside": inside, "outside": outside }),
    )
}

/// Means over all bodies for each reading of the paper.
fn readings(cases: &[Case], impacts: u64) -> Result<Vec<Value>> {
    let with = |change: fn(&mut Options)| {
        let mut options = Options::default();
        change(&mut options);
        options
    };
    let readings = [
        ("as compared above", Options::default()),
        (
            "Eq. 3 as printed",
            with(|o| o.time_step = TimeStep::AsPrinted),
        ),
        (
            "half a period a step",
            with(|o| o.time_step = TimeStep::Nyquist),
        ),
        (
            "the nearest weak element",
            with(|o| o.initiation = Initiation::NearestWeak),
        ),
        (
            "Algorithm 2's energy test",
            with(|o| o.energy_test = EnergyTest::AsPrinted),
        ),
        ("marks at the nodes", with(|o| o.marks = Marks::Nodes)),
        // The constant that gives Hertz' duration for a period of 1 ms, a radius of 2 cm.
        ("all as printed, c = 0.02", Options::as_printed(0.02)),
    ];
    let mean = |(name, options): (&str, Options)| {
        let mut sums = [0.0; 4];
        for case in cases {
            for number in 0..impacts {
                let (body, contacts) = generate(case, number)?;
                let result = fracture(&body, &contacts, Field::Linear, &options)?;
                let area = result.cracks.iter().map(|c| c.area).sum::<f64>();
                let pieces = result.fragment_of_node.iter().max().map_or(0, |&f| f + 1);
                let found = [
                    result.steps as f64,
                    result.cracks.len() as f64,
                    area,
                    f64::from(pieces),
                ];
                sums = std::array::from_fn(|i| sums[i] + found[i]);
            }
        }
        let [steps, cracks, area, pieces] =
            sums.map(|sum| sum / (cases.len() as u64 * impacts) as f64);
        Ok(
            json!({ "reading": name, "steps": steps, "cracks": cracks, "area_m2": area, "pieces": pieces }),
        )
    };
    readings.into_iter().map(mean).collect()
}
