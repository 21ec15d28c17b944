//! `frangible-lab pieces`: ways to find how fragments vibrate, beside a full analysis of each.

use std::error::Error;
use std::fmt::Write;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use frangible::{Outcome, impact};
use frangible_lab::verify::pieces::{Broken, Truth, TruthPlan};
use frangible_scenes::SCENE_NAMES;
use serde_json::json;

use crate::args::PiecesArgs;
use crate::output::{Bar, Page, say};

/// The page, and the folder of its pictures.
const PAGE: &str = "recursive.md";
const PICTURES: &str = "recursive";
/// Simulated time of the scenes, s: by then every body has met what breaks it.
const DURATION: f64 = 1.0;
/// Bodies that take the blow of each scene, each with weak points of its own.
const SEEDS: u64 = 4;
/// Share of the work that goes into breaking the scenes.
const BREAKING: f64 = 0.3;

pub(crate) fn run(args: &PiecesArgs) -> Result<(), Box<dyn Error>> {
    let place = Page::new(args.page.write.as_deref(), PAGE, PICTURES)?;
    let mut plan = TruthPlan::full();
    if let Some(count) = args.count {
        plan.baked = (plan.baked * count).div_ceil(plan.fragments).min(count);
        plan.fragments = count;
    }
    let bar = Bar::new(args.page.json);
    let hear = |share: f64| bar.show("breaking scenes", BREAKING * share);
    let broken = broken(plan.threads, &hear)?;
    let hear = |share: f64| bar.show("analysing pieces", BREAKING + (1.0 - BREAKING) * share);
    let truth = Truth::compute(plan, &broken, &hear)?;
    drop(bar);
    let page = truth.page(PICTURES)?;
    let files = place.write(&page.text, &page.pictures)?;
    if args.page.json {
        say(&format!("{:#}\n", as_json(&truth, &files)))?;
    } else {
        say(&text(&truth, &files))?;
    }
    Ok(())
}

/// Number of a scene, and its broken bodies.
type OfScene = (usize, Result<Vec<Broken>, String>);

/// The bodies of all built-in scenes, broken as the scenes break them, each with several seeds.
fn broken(threads: usize, hear: &(dyn Fn(f64) + Sync)) -> Result<Vec<Broken>, Box<dyn Error>> {
    let (next, done) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let found: Mutex<Vec<OfScene>> = Mutex::default();
    let work = || {
        loop {
            let i = next.fetch_add(1, Ordering::Relaxed);
            let Some(name) = SCENE_NAMES.get(i) else {
                return;
            };
            let bodies = of_scene(name).map_err(|e| e.to_string());
            if let Ok(mut found) = found.lock() {
                found.push((i, bodies));
            }
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            hear(done as f64 / SCENE_NAMES.len() as f64);
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(work);
        }
    });
    let mut found = found.into_inner().map_err(|e| e.to_string())?;
    found.sort_by_key(|f| f.0);
    let mut all = Vec::new();
    for (_, bodies) in found {
        all.extend(bodies?);
    }
    Ok(all)
}

/// The bodies of a scene, broken by the blows of the scene.
fn of_scene(name: &str) -> Result<Vec<Broken>, Box<dyn Error>> {
    let mut scene = frangible_scenes::scene(name)?;
    scene.duration = DURATION;
    let baked = frangible_scenes::bake(&scene)?;
    let run = frangible_scenes::play(&scene, &baked, &mut |_| {})?;
    let mut all = Vec::new();
    for (i, (spec, baked)) in scene.bodies.iter().zip(&baked).enumerate() {
        let Some(record) = run.break_of(i) else {
            continue;
        };
        let kind = frangible_scenes::breakable(spec, &baked.asset)?;
        for seed in 1..=SEEDS {
            let body = kind.body(seed);
            let outcome = impact(&body, &record.contacts, &scene.fracture)?;
            if let Outcome::Broke(fracture) = outcome {
                all.push(Broken::new(name, body, *fracture));
            }
        }
    }
    Ok(all)
}

fn text(truth: &Truth, files: &[String]) -> String {
    let (head, rows) = (Truth::head(), truth.rows());
    let all = || std::iter::once(&head).chain(&rows);
    let width = |column: usize| all().map(|r| r[column].chars().count()).max().unwrap_or(0);
    let mut text = format!("{} pieces\n", truth.pieces.len());
    for row in all() {
        for (column, cell) in row.iter().enumerate() {
            let width = width(column);
            let _ = match column {
                0 => write!(text, "{cell:width$}"),
                _ => write!(text, "  {cell:>width$}"),
            };
        }
        text.push('\n');
    }
    for file in files {
        let _ = writeln!(text, "wrote {file}");
    }
    text
}

fn as_json(truth: &Truth, files: &[String]) -> serde_json::Value {
    let head = Truth::head();
    let ways: Vec<serde_json::Value> = truth
        .rows()
        .iter()
        .map(|row| {
            let mut way = serde_json::Map::new();
            way.insert("way".into(), row[0].clone().into());
            for (name, cell) in head.iter().zip(row).skip(1) {
                way.insert(name.clone(), cell.clone().into());
            }
            way.into()
        })
        .collect();
    json!({ "pieces": truth.pieces.len(), "ways": ways, "files": files })
}
