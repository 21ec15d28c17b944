//! Table 1 of `[G12]`, measured.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use crate::reference::{Field, Options as Reading, fracture};
use frangible::internals::impact_traced;
use frangible::{Asset, Body, Breakable, Contact, FractureConfig, Outcome, impact};
use frangible_rapier::{WorldConfig, collision_shape};
use serde_json::{Value, json};

use crate::Result;
use crate::bench::cache::{Baked, Cache};
use crate::bench::stats::Times;
use crate::bench::subjects::{MODES, Subject};

/// Seed of the weak points.
const SEED: u64 = 1;
/// Runs before the warm ones count.
const WARM_UP: usize = 3;
/// One body in one model is run no longer than this, once it has run [`FEWEST`] times.
const LIMIT: Duration = Duration::from_secs(10);
const FEWEST: usize = 3;
/// Loads of a body for its cold runs.
const COLD_RUNS: usize = 9;
/// Written between a load and a cold run, bytes: nothing of the body is left in the processor's own caches.
const SWEEP: usize = 64 << 20;

/// Options of the benchmark.
#[derive(Clone, Debug)]
pub struct Options {
    /// Warm runs of each body in each model, at most.
    pub runs: usize,
    /// Also run the paper's algorithms word for word.
    pub reference: bool,
}

/// Measures one body.
///
/// # Errors
/// A body that does not bake, or whose file cannot be read.
pub fn measure(subject: &'static Subject, cache: &Cache, options: &Options) -> Result<Value> {
    let geometry = || subject.geometry();
    let baked = cache.body(subject.file(), MODES, subject.material, geometry)?;
    let contact = subject.contact(&baked.asset, subject.blow.speed)?;
    let body = Breakable::uniform(baked.asset.clone())?.body(SEED);
    let mut loads = Loads::default();
    let mut config = FractureConfig::as_in_the_paper();
    let mut paper = in_model(&body, &contact, &config, &baked, options, &mut loads)?;
    if options.reference {
        let clock = Instant::now();
        fracture(
            &body,
            std::slice::from_ref(&contact),
            Field::Embedded,
            &Reading::default(),
        )?;
        paper["reference_s"] = json!(clock.elapsed().as_secs_f64());
    }
    config.samples_per_period = 2.0;
    let two_samples = in_model(&body, &contact, &config, &baked, options, &mut loads)?;
    let contact = subject.contact(&baked.asset, subject.blow.speed_ours)?;
    let config = FractureConfig::default();
    let ours = in_model(&body, &contact, &config, &baked, options, &mut loads)?;
    let asset = &baked.asset;
    Ok(json!({
        "subject": subject,
        "nodes": asset.fracture().positions.len(),
        "tets": asset.fracture().tets.len(),
        "analysis_elements": asset.analysis().elements.len(),
        "analysis_nodes": asset.analysis().nodes.len(),
        "modes": asset.modes().count(),
        "weak_points": body.weak_tets().len(),
        "file_bytes": std::fs::metadata(&baked.path).map_or(0, |about| about.len()),
        "bake_s": baked.seconds,
        "load_s": Times::new(loads.load).median(),
        "ready_s": Times::new(loads.ready).median(),
        "paper": paper,
        "two_samples": two_samples,
        "ours": ours,
    }))
}

/// Times of reading a body, s.
#[derive(Default)]
struct Loads {
    load: Vec<f64>,
    ready: Vec<f64>,
}

fn in_model(
    body: &Body,
    contact: &Contact,
    config: &FractureConfig,
    baked: &Baked,
    options: &Options,
    loads: &mut Loads,
) -> Result<Value> {
    let contacts = [contact.clone()];
    let mut cold = Vec::new();
    for _ in 0..COLD_RUNS.min(options.runs) {
        let clock = Instant::now();
        let asset = Asset::load(&baked.path)?;
        loads.load.push(clock.elapsed().as_secs_f64());
        let clock = Instant::now();
        let fresh = Breakable::uniform(asset)?.body(SEED);
        loads.ready.push(clock.elapsed().as_secs_f64());
        sweep();
        cold.push(timed(&fresh, &contacts, config)?.0);
    }
    for _ in 0..WARM_UP {
        impact(body, &contacts, config)?;
    }
    let (mut warm, mut colliders) = (Vec::new(), Vec::new());
    let start = Instant::now();
    while warm.len() < options.runs && (warm.len() < FEWEST || start.elapsed() < LIMIT) {
        let (stages, outcome) = timed(body, &contacts, config)?;
        warm.push(stages);
        colliders.push(make_colliders(&outcome));
    }
    let (outcome, trace) = impact_traced(body, &contacts, config)?;
    let report = outcome.report();
    Ok(json!({
        "warm_s": medians(&warm),
        "cold_s": medians(&cold),
        "warm_runs": warm.len(),
        "colliders_s": Times::new(colliders).median(),
        "steps": report.time_steps,
        "contact_duration_s": report.contact_duration,
        "crossed": trace.cracks.iter().map(Vec::len).sum::<usize>(),
        "cracks": report.cracks,
        "crack_area_m2": report.crack_area,
        "fragments": match &outcome {
            Outcome::Broke(fracture) => fracture.fragments.len(),
            _ => 1,
        },
    }))
}

/// Stages of an impact, in the order of [`timed`]; `stresses` are the displacements u = Φ q.
const STAGES: [&str; 5] = ["response", "stresses", "cracks", "fragments", "total"];

/// Wall-clock times of an impact, s.
fn timed(
    body: &Body,
    contacts: &[Contact],
    config: &FractureConfig,
) -> Result<([f64; 5], Outcome)> {
    let clock = Instant::now();
    let outcome = impact(body, contacts, config)?;
    let total = clock.elapsed().as_secs_f64();
    let t = &outcome.report().timings;
    Ok((
        [t.response, t.stress, t.cracks, t.fragments, total],
        outcome,
    ))
}

/// Medians of the stages, each for itself: they need not sum to the median of the whole.
fn medians(runs: &[[f64; 5]]) -> BTreeMap<&'static str, f64> {
    let median = |i: usize| Times::new(runs.iter().map(|run| run[i]).collect()).median();
    STAGES
        .iter()
        .enumerate()
        .map(|(i, name)| (*name, median(i)))
        .collect()
}

/// Time for making the fragments' colliders, s, which a world does before they move.
fn make_colliders(outcome: &Outcome) -> f64 {
    let Outcome::Broke(fracture) = outcome else {
        return 0.0;
    };
    let config = WorldConfig::default();
    let clock = Instant::now();
    for fragment in &fracture.fragments {
        std::hint::black_box(collision_shape(fragment, &config));
    }
    clock.elapsed().as_secs_f64()
}

/// Writes over the caches.
fn sweep() {
    let mut bytes = vec![1_u8; SWEEP];
    for (i, byte) in bytes.iter_mut().enumerate().step_by(64) {
        *byte = i as u8;
    }
    std::hint::black_box(&bytes);
}
