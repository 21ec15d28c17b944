//! Table 1 of `[G12]`, measured.

use std::time::{Duration, Instant};

use crate::reference::{Field, Options as Reading, fracture};
use frangible::internals::impact_traced;
use frangible::{Asset, Body, Breakable, Contact, FractureConfig, ImpactReport, Outcome, impact};
use frangible_rapier::{WorldConfig, collision_shape};
use serde::Serialize;

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

/// Wall-clock times of an impact, s: medians of equal runs, each for itself.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Stages {
    /// Contact duration, response of the modes.
    pub response: f64,
    /// Displacements u = Φ q.
    pub displacements: f64,
    /// Stresses at weak points, cracks.
    pub cracks: f64,
    /// Fragments.
    pub fragments: f64,
    /// The whole call.
    pub total: f64,
    /// Number of runs.
    pub runs: usize,
}

/// A body in one model.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct InModel {
    /// The body, its contact and its code in the processor's caches.
    pub warm: Stages,
    /// The first impact on a body just read from its file, caches swept.
    pub cold: Stages,
    /// Making the colliders of all fragments, s.
    pub colliders: f64,
    /// The paper's algorithms word for word in f64, without fragments' surfaces, one run, s.
    pub reference: Option<f64>,
    /// Steps in time.
    pub steps: usize,
    /// Contact duration, s.
    pub contact_duration: f64,
    /// Tetrahedra crossed by cracks.
    pub crossed: usize,
    /// Cracks.
    pub cracks: usize,
    /// Area of the cracks, m².
    pub crack_area: f64,
    /// Fragments; 1 where it holds.
    pub fragments: usize,
}

/// A line of the table.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// Body, with the paper's figures.
    pub subject: Subject,
    /// Nodes of the fracture mesh.
    pub nodes: usize,
    /// Its tetrahedra.
    pub tets: usize,
    /// Quadratic elements that carry the modes.
    pub analysis_elements: usize,
    /// Their nodes.
    pub analysis_nodes: usize,
    /// Modes.
    pub modes: usize,
    /// Weak points.
    pub weak_points: usize,
    /// Size of the baked file, bytes.
    pub file_size: u64,
    /// The bake, s.
    pub bake: f64,
    /// Reading and checking the file, s.
    pub load: f64,
    /// Time from the file's content to a body, s.
    pub ready: f64,
    /// Results in the paper's model, at 16 samples per period.
    pub paper: InModel,
    /// Results in the paper's model, at two samples per period of the highest mode that matters: the limit that the paper names.
    pub two_samples: InModel,
    /// Our model.
    pub ours: InModel,
}

/// Measures one body.
///
/// # Errors
/// A body that does not bake, or whose file cannot be read.
pub fn measure(
    subject: &'static Subject,
    cache: &Cache,
    options: &Options,
    progress: &mut dyn FnMut(&str, f64),
) -> Result<Row> {
    let geometry = || subject.geometry();
    let baked = cache.body(subject.file(), MODES, subject.material, geometry, progress)?;
    let contact = subject.contact(&baked.asset, subject.blow.speed)?;
    let body = Breakable::uniform(baked.asset.clone())?.body(SEED);
    let mut loads = Loads::default();
    let mut tell = |what: &str, share: f64| progress(&format!("{}: {what}", subject.name), share);
    tell("the paper's model", 0.0);
    let mut config = FractureConfig::as_in_the_paper();
    let mut paper = in_model(&body, &contact, &config, &baked, options, &mut loads)?;
    if options.reference {
        tell("the paper word for word", 0.3);
        let clock = Instant::now();
        fracture(
            &body,
            std::slice::from_ref(&contact),
            Field::Embedded,
            &Reading::default(),
        )?;
        paper.reference = Some(clock.elapsed().as_secs_f64());
    }
    config.samples_per_period = 2.0;
    let two_samples = in_model(&body, &contact, &config, &baked, options, &mut loads)?;
    tell("our model", 0.6);
    let contact = subject.contact(&baked.asset, subject.blow.speed_ours)?;
    let config = FractureConfig::default();
    let ours = in_model(&body, &contact, &config, &baked, options, &mut loads)?;
    let asset = &baked.asset;
    Ok(Row {
        subject: *subject,
        nodes: asset.fracture().positions.len(),
        tets: asset.fracture().tets.len(),
        analysis_elements: asset.analysis().elements.len(),
        analysis_nodes: asset.analysis().nodes.len(),
        modes: asset.modes().count(),
        weak_points: body.weak_tets().len(),
        file_size: std::fs::metadata(&baked.path).map_or(0, |about| about.len()),
        bake: baked.seconds,
        load: Times::new(loads.load).median(),
        ready: Times::new(loads.ready).median(),
        paper,
        two_samples,
        ours,
    })
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
) -> Result<InModel> {
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
    Ok(InModel {
        warm: medians(&warm),
        cold: medians(&cold),
        colliders: Times::new(colliders).median(),
        reference: None,
        steps: report.time_steps,
        contact_duration: report.contact_duration,
        crossed: trace.cracks.iter().map(Vec::len).sum(),
        cracks: report.cracks,
        crack_area: report.crack_area,
        fragments: match &outcome {
            Outcome::Broke(fracture) => fracture.fragments.len(),
            _ => 1,
        },
    })
}

fn timed(body: &Body, contacts: &[Contact], config: &FractureConfig) -> Result<(Stages, Outcome)> {
    let clock = Instant::now();
    let outcome = impact(body, contacts, config)?;
    let total = clock.elapsed().as_secs_f64();
    Ok((stages(outcome.report(), total), outcome))
}

fn stages(report: &ImpactReport, total: f64) -> Stages {
    let t = &report.timings;
    Stages {
        response: t.response,
        displacements: t.stress,
        cracks: t.cracks,
        fragments: t.fragments,
        total,
        runs: 1,
    }
}

/// Medians of the stages, each for itself: they need not sum to the median of the whole.
fn medians(runs: &[Stages]) -> Stages {
    let median = |part: fn(&Stages) -> f64| Times::new(runs.iter().map(part).collect()).median();
    Stages {
        response: median(|s| s.response),
        displacements: median(|s| s.displacements),
        cracks: median(|s| s.cracks),
        fragments: median(|s| s.fragments),
        total: median(|s| s.total),
        runs: runs.len(),
    }
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
