//! `frangible-lab`: measures, and writes the numbers as JSON.

mod args;
mod gallery;
mod output;

use std::path::Path;
use std::process::ExitCode;

use clap::Parser;
use frangible_lab::Result;
use frangible_lab::bench::cache::Cache;
use frangible_lab::bench::subjects::chosen;
use frangible_lab::bench::{again, contacts, gallery as breaks, roofline, table1};
use frangible_lab::compare::{Method, Options, SCENES, broken_scene, picture};
use frangible_lab::data::Measures;
use frangible_lab::real_breaks;
use frangible_lab::sound::{Heard, Levels, RATE};
use frangible_lab::verify::CASES;
use frangible_lab::verify::experiments::{Experiments, MassPlan, RearStarPlan, StarPlan};
use frangible_lab::verify::near_field;
use frangible_lab::verify::pieces::{Truth, TruthPlan, broken_scenes};
use frangible_recording::{make_folder, write_atomically};
use frangible_scenes::{GamePlan, scene, scene_of};
use serde_json::{Map, Value, json};

use args::{BenchArgs, Cli, Command, CompareArgs, Measured, PiecesArgs, RealBreaksArgs, Write};
use output::{Bar, Place};

/// Folder for the cracks that `tools/plot.py` draws.
const PATTERNS: &str = "target/lab/experiments";
/// Folder for the sounds that `tools/plot.py` draws.
const SOUNDS: &str = "target/lab/sound";

fn main() -> ExitCode {
    let result = match Cli::parse().command {
        Command::Verify(args) => verify(&args),
        Command::Experiments(args) => experiments(&args),
        Command::Pieces(args) => pieces(&args),
        Command::NearField(args) => plates(&args),
        Command::Sound(args) => sound(&args),
        Command::Levels(args) => levels(&args),
        Command::Figures(args) => figures(&args.names, &args.write),
        Command::Bench(args) => bench(&args),
        Command::Compare(args) => compare(&args),
        Command::Gallery(args) => gallery::run(&args),
        Command::RealBreaks(args) => count_real_breaks(&args),
        Command::Pages { docs } => output::fill_pages(&docs),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn verify(args: &Write) -> Result<()> {
    let place = Place::new(args, "verification", Measures::Model)?;
    let bar = Bar::new();
    let (mut all, mut failed) = (Map::new(), Vec::new());
    for (i, case) in CASES.iter().enumerate() {
        bar.show(case.title, i as f64 / CASES.len() as f64);
        let found = case.run()?;
        let checks: Vec<Value> = found.checks.iter().map(|check| check.data()).collect();
        let wrong = found.checks.iter().filter(|check| !check.passes());
        failed.extend(wrong.map(|check| format!("{}, {}", case.title, check.name)));
        let found = json!({ "title": case.title, "checks": checks, "curves": found.curves });
        all.insert(case.name.into(), found);
    }
    drop(bar);
    place.put(false, &all)?;
    if failed.is_empty() {
        return Ok(());
    }
    Err(format!("{} checks failed: {}", failed.len(), failed.join("; ")).into())
}

/// Also leaves the cracks of single plates where `tools/plot.py` looks for them.
fn experiments(args: &Write) -> Result<()> {
    let place = Place::new(args, "experiments", Measures::Model)?;
    let bar = Bar::new();
    let plans = (StarPlan::full(), RearStarPlan::full(), MassPlan::full());
    let hear = |share| bar.show("breaking plates and balls", share);
    let found = Experiments::compute(plans.0, plans.1, plans.2, &hear)?;
    drop(bar);
    let folder = Path::new(PATTERNS);
    make_folder(folder, &[], "--write")?;
    let patterns = serde_json::to_vec(&found.stars.patterns())?;
    write_atomically(&folder.join("patterns.json"), &patterns)?;
    place.put(false, &found)
}

fn pieces(args: &PiecesArgs) -> Result<()> {
    let place = Place::new(&args.write, "recursive", Measures::Scenes)?;
    let mut plan = TruthPlan::full();
    if let Some(count) = args.count {
        plan.baked = (plan.baked * count).div_ceil(plan.fragments).min(count);
        plan.fragments = count;
    }
    let bar = Bar::new();
    bar.show("breaking scenes", 0.0);
    let broken = broken_scenes()?;
    let found = Truth::compute(plan, &broken, &|share| bar.show("analysing pieces", share))?;
    drop(bar);
    place.put(true, &found.data())
}

fn plates(args: &Write) -> Result<()> {
    let place = Place::new(args, "near-field", Measures::Model)?;
    let bar = Bar::new();
    let found = near_field::compute(&|share| bar.show("hitting plates", share))?;
    drop(bar);
    place.put(false, &found)
}

/// Also leaves the sounds where `tools/plot.py` looks for them.
fn sound(args: &Write) -> Result<()> {
    let place = Place::new(args, "sound", Measures::Sound)?;
    let bar = Bar::new();
    let heard = Heard::compute(&|share| bar.show("simulating blows and sound", share))?;
    drop(bar);
    leave(&heard.sounds())?;
    place.put(false, &heard.data())
}

/// Also leaves the sounds where `tools/plot.py` looks for them.
fn levels(args: &Write) -> Result<()> {
    let place = Place::new(args, "levels", Measures::Sound)?;
    let bar = Bar::new();
    let heard = Levels::compute(&|share| bar.show("simulating scenes and sound", share))?;
    drop(bar);
    leave(&heard.sounds())?;
    place.put(false, &heard.data())
}

/// Writes sounds, each as loud as fits.
fn leave(sounds: &[(&str, &[f32])]) -> Result<()> {
    make_folder(SOUNDS.as_ref(), &[], "--write")?;
    for (name, samples) in sounds {
        let loudest = samples.iter().fold(0.0_f32, |most, s| most.max(s.abs()));
        let wav = frangible_sound::wav(samples, 1, RATE, f64::from(loudest))?;
        write_atomically(format!("{SOUNDS}/{name}.wav").as_ref(), &wav)?;
    }
    Ok(())
}

fn figures(names: &[String], args: &Write) -> Result<()> {
    let place = Place::new(args, "figures", Measures::Scenes)?;
    let bar = Bar::new();
    let found = frangible_lab::figures::compute(names, &|share| bar.show("figures", share))?;
    drop(bar);
    place.put(false, &found)
}

fn count_real_breaks(args: &RealBreaksArgs) -> Result<()> {
    let place = Place::new(&args.write, "real-breaks", Measures::Scenes)?;
    let bar = Bar::new();
    let seeds = args.seeds.unwrap_or(real_breaks::SEEDS);
    let found = real_breaks::compute(seeds, &|share| bar.show("breaking scenes", share))?;
    drop(bar);
    place.put(false, &found)
}

fn bench(args: &BenchArgs) -> Result<()> {
    let cache = Cache {
        folder: args.cache.clone(),
        // Numbers that stay must not be of a body, or a bake time, of another day.
        rebake: args.rebake || args.write.write.is_some(),
    };
    let runs = args.runs.unwrap_or(30);
    let (name, found) = match args.what {
        Measured::Table1 => {
            let options = table1::Options {
                runs,
                reference: !args.no_reference,
            };
            let rows = chosen(&args.bodies)?.into_iter();
            let rows = rows.map(|body| table1::measure(body, &cache, &options));
            ("table1", json!(rows.collect::<Result<Vec<_>>>()?))
        }
        Measured::Gallery => {
            let subjects = breaks::chosen(&args.bodies)?;
            ("breaks", json!(breaks::measure(&subjects, runs)?))
        }
        Measured::Roofline => {
            let found = roofline::measure(&args.bodies, &cache)?;
            ("roofline", found)
        }
        _ if !args.bodies.is_empty() => {
            return Err(
                "--body applies only to `bench table1`, `bench gallery` and `bench roofline`"
                    .into(),
            );
        }
        Measured::Contacts => ("contacts", json!(contacts::measure(&cache)?)),
        Measured::Again => {
            let runs = args.runs.unwrap_or(3);
            ("again", json!(again::measure(runs, GamePlan::default())?))
        }
    };
    Place::new(&args.write, name, Measures::Scenes)?.put(true, &found)
}

fn compare(args: &CompareArgs) -> Result<()> {
    let place = Place::new(&args.write, "compare", Measures::Scenes)?;
    let methods = args
        .methods
        .iter()
        .map(|name| Method::from_name(name.trim()));
    let mut methods: Vec<Method> = methods.collect::<std::result::Result<_, _>>()?;
    if methods.is_empty() {
        methods = Method::ALL.into();
    }
    let bar = Bar::new();
    let run = |mut scene: frangible_scenes::Scene| {
        scene.seed = args.seed.unwrap_or(scene.seed);
        let mut options = Options::default();
        options.seed = scene.seed;
        options.step = args.step.map_or(options.step, |ms| 1e-3 * ms);
        options.sites = args.sites.unwrap_or(options.sites);
        options.cells = args.cells;
        broken_scene(&scene, &methods, &options, &|share| {
            bar.show(&scene.name, share);
        })
    };
    let Some(docs) = &args.write.write else {
        let (found, all, data) = run(scene_of(args.file.as_deref(), args.scene.as_deref())?)?;
        if let Some(file) = &args.picture {
            write_atomically(file, &picture(&found, &all)?)?;
        }
        return place.put(true, &data);
    };
    make_folder(&docs.join("compare"), &[], "--write")?;
    let mut rows = Vec::new();
    for name in SCENES {
        let (found, all, data) = run(scene(name)?)?;
        let file = docs.join("compare").join(format!("{name}.png"));
        write_atomically(&file, &picture(&found, &all)?)?;
        rows.push(data);
    }
    drop(bar);
    place.put(true, &rows)
}
