//! `frangible-lab bench`: benchmarks.

use std::error::Error;
use std::path::Path;

use frangible_lab::bench::cache::Cache;
use frangible_lab::bench::machine::Machine;
use frangible_lab::bench::page::sections::{self, Section, with_sections};
use frangible_lab::bench::subjects::chosen;
use frangible_lab::bench::{again, contacts, gallery, haptic, page, roofline, shop, table1};
use frangible_recording::{make_folder, write_atomically};
use frangible_scenes::GamePlan;
use serde_json::{Map, Value, json};

use crate::args::{BenchArgs, Measured};
use crate::output::{Bar, say};

/// The page that `--write` writes into.
const PAGE: &str = "performance.md";
/// Warm runs of each body of Table 1.
const WARM: usize = 30;
/// Runs of each scene.
const AGAIN: usize = 3;
/// The body that is felt.
const FELT: &str = "slab-moderate";
/// Most impacts of a batch on a GPU.
const BATCH: usize = 64;

/// Measurements of one subject: for the page, and for scripts.
struct Part {
    key: &'static str,
    title: &'static str,
    text: String,
    json: Value,
}

/// The one that `roofline --write` writes.
const ROOFLINE_PAGE: &str = "roofline.md";

pub(crate) fn run(args: &BenchArgs) -> Result<(), Box<dyn Error>> {
    if args.what == Measured::Roofline {
        return run_roofline(args);
    }
    if let Some(folder) = &args.write {
        if !args.bodies.is_empty() {
            return Err("--write writes a page about all bodies; remove --body".into());
        }
        make_folder(folder, &[PAGE.into()], "--write")?;
    }
    // Names are checked before anything takes minutes.
    match args.what {
        Measured::Table1 => _ = chosen(&args.bodies)?,
        Measured::Gallery => _ = gallery::chosen(&args.bodies)?,
        _ if args.bodies.is_empty() => {}
        _ => {
            let problem = "--body applies only to `bench table1` and `bench gallery`, for example frangible-lab bench table1 --body NAME";
            return Err(problem.into());
        }
    }
    let bar = Bar::new(args.json);
    let mut parts = Vec::new();
    let mut show = |what: &str, share: f64| bar.show(what, share);
    for what in measured(args.what) {
        parts.push(measure(what, args, &mut show)?);
    }
    drop(bar);
    let machine = Machine::this();
    if let Some(folder) = &args.write {
        write(folder, &machine, &parts)?;
    }
    if args.json {
        let mut all = Map::new();
        all.insert("machine".into(), json!(machine));
        for part in parts {
            all.insert(part.key.into(), part.json);
        }
        return Ok(say(&format!("{:#}\n", Value::Object(all)))?);
    }
    let mut text = String::new();
    for part in &parts {
        text += &format!("\n## {}\n\n{}", part.title, part.text);
    }
    if let Some(folder) = &args.write {
        text += &format!("\nwrote {}\n", folder.join(PAGE).display());
    }
    Ok(say(text.trim_start())?)
}

fn measured(what: Measured) -> Vec<Measured> {
    match what {
        Measured::All => vec![
            Measured::Table1,
            Measured::Gallery,
            Measured::Contacts,
            Measured::Haptic,
            Measured::Shop,
            Measured::Again,
            Measured::Gpu,
        ],
        one => vec![one],
    }
}

fn measure(
    what: Measured,
    args: &BenchArgs,
    show: &mut dyn FnMut(&str, f64),
) -> Result<Part, Box<dyn Error>> {
    let cache = Cache {
        folder: args.cache.clone(),
        // A page that stays must not show a body, or a bake time, of another day.
        rebake: args.rebake || args.write.is_some(),
    };
    let (key, title, text, json) = match what {
        // The others are dealt with before.
        Measured::Table1 | Measured::All | Measured::Roofline => {
            let options = table1::Options {
                runs: args.runs.map_or(WARM, |n| n as usize),
                reference: !args.no_reference,
            };
            let mut rows = Vec::new();
            for subject in chosen(&args.bodies)? {
                rows.push(table1::measure(subject, &cache, &options, show)?);
            }
            let text = page::table1_section(&rows);
            ("table1", sections::TABLE1, text, json!(rows))
        }
        Measured::Gallery => {
            let subjects = gallery::chosen(&args.bodies)?;
            let runs = args.runs.map_or(WARM, |n| n as usize);
            let found = gallery::measure(&subjects, runs, show)?;
            let text = page::gallery(&found);
            ("gallery", sections::GALLERY, text, json!(found))
        }
        Measured::Contacts => {
            let found = contacts::measure(&cache, show)?;
            let text = page::contacts(&found);
            ("contacts", sections::CONTACTS, text, json!(found))
        }
        Measured::Haptic => {
            let plate = chosen(&[FELT.into()])?[0];
            let known = haptic::Options::default();
            let options = haptic::Options {
                ticks: u64::from(args.ticks),
                runs: args.runs.map_or(known.runs, |n| n as usize),
                ..known
            };
            let found = haptic::measure(plate, &cache, &options, show)?;
            let text = page::haptic(&found);
            ("haptic", sections::HAPTIC, text, json!(found))
        }
        Measured::Shop => {
            let known = shop::Options::default();
            let options = shop::Options {
                runs: args.runs.map_or(known.runs, |n| n as usize),
                ..known
            };
            let found = shop::measure(&options, show)?;
            ("shop", sections::SHOP, page::shop(&found), json!(found))
        }
        Measured::Again => {
            let plan = GamePlan::default();
            let found = again::measure(args.runs.map_or(AGAIN, |n| n as usize), plan, show)?;
            let text = page::again(&found, plan);
            ("again", sections::AGAIN, text, json!(found))
        }
        Measured::Gpu => {
            let found = frangible_lab::bench::gpu::measure(BATCH, show)?;
            // Where a GPU was asked for by name, to have none is a failure.
            if let (Err(problem), Measured::Gpu) = (&found.adapter, args.what) {
                return Err(problem.clone().into());
            }
            ("gpu", sections::GPU, page::gpu(&found), json!(found))
        }
    };
    Ok(Part {
        key,
        title,
        text,
        json,
    })
}

/// Puts the measurements into their sections of the page.
fn write(folder: &Path, machine: &Machine, parts: &[Part]) -> Result<(), Box<dyn Error>> {
    let path = folder.join(PAGE);
    let known = std::fs::read_to_string(&path).ok();
    let new: Vec<Section> = parts
        .iter()
        .map(|part| Section::new(part.title, machine, &part.text))
        .collect();
    let page = with_sections(known.as_deref(), &new);
    Ok(write_atomically(&path, page.as_bytes())?)
}

fn run_roofline(args: &BenchArgs) -> Result<(), Box<dyn Error>> {
    let subjects = if args.bodies.is_empty() {
        chosen(&roofline::BODIES.map(String::from))?
    } else {
        chosen(&args.bodies)?
    };
    if let Some(folder) = &args.write {
        make_folder(folder, &[ROOFLINE_PAGE.into()], "--write")?;
    }
    let cache = Cache {
        folder: args.cache.clone(),
        rebake: args.rebake,
    };
    let bar = Bar::new(args.json);
    let found = roofline::measure(&subjects, &cache, &mut |what, share| bar.show(what, share))?;
    drop(bar);
    let machine = Machine::this();
    if let Some(folder) = &args.write {
        let text = roofline::page(&machine, &found);
        write_atomically(&folder.join(ROOFLINE_PAGE), text.as_bytes())?;
    }
    if args.json {
        let all = json!({ "machine": machine, "roofline": found });
        return Ok(say(&format!("{all:#}\n"))?);
    }
    let mut text = roofline::tables(&found);
    if let Some(folder) = &args.write {
        text += &format!("\nwrote {}\n", folder.join(ROOFLINE_PAGE).display());
    }
    Ok(say(&text)?)
}
