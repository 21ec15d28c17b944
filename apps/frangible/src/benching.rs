//! `frangible bench`: how fast it is.

use std::error::Error;

use frangible_bench::cache::Cache;
use frangible_bench::machine::Machine;
use frangible_bench::subjects::chosen;
use frangible_bench::{contacts, page, roofline, table1};
use frangible_export::write_atomically;
use serde_json::json;

use crate::args::{BenchArgs, Measured};
use crate::place::make_folder;
use crate::progress::Bar;
use crate::say::say;

/// The page that `--write` writes.
const PAGE: &str = "performance.md";

/// The one that `roofline --write` writes.
const ROOFLINE_PAGE: &str = "roofline.md";

pub(crate) fn run(args: &BenchArgs) -> Result<(), Box<dyn Error>> {
    if args.what == Measured::Roofline {
        return run_roofline(args);
    }
    let subjects = chosen(&args.bodies)?;
    if let Some(folder) = &args.write {
        if args.what != Measured::All {
            return Err(
                "--write writes one page of both measurements: frangible bench all --write DIR"
                    .into(),
            );
        }
        if !args.bodies.is_empty() {
            return Err("--write writes a page of all bodies: leave out --body".into());
        }
        let wrong = |e: String| e.replace("--out DIR", "--write DIR");
        make_folder(folder, &[PAGE.into()]).map_err(wrong)?;
    }
    let cache = Cache {
        folder: args.cache.clone(),
        // A page that stays must not show a body, or a bake time, of another day.
        rebake: args.rebake || args.write.is_some(),
    };
    let options = table1::Options {
        runs: args.runs as usize,
        reference: !args.no_reference,
    };
    let bar = Bar::new(args.json);
    let mut show = |what: &str, share: f64| bar.show(what, share);
    let mut rows = Vec::new();
    if args.what != Measured::Contacts {
        for subject in subjects {
            rows.push(table1::measure(subject, &cache, &options, &mut show)?);
        }
    }
    let found = match args.what {
        Measured::Table1 => None,
        _ => Some(contacts::measure(&cache, &mut show)?),
    };
    drop(bar);
    let machine = Machine::this();
    if let (Some(folder), Some(found)) = (&args.write, &found) {
        let text = page::page(&machine, &rows, found);
        write_atomically(&folder.join(PAGE), text.as_bytes())?;
    }
    if args.json {
        let all = json!({ "machine": machine, "table1": rows, "contacts": found });
        return Ok(say(&format!("{all:#}\n"))?);
    }
    let mut text = String::new();
    if !rows.is_empty() {
        text += &page::table1(&rows);
    }
    if let Some(found) = &found {
        text += "\n### Refused contacts\n\n";
        text += &page::contacts(found);
    }
    if let Some(folder) = &args.write {
        text += &format!("\nwrote {}\n", folder.join(PAGE).display());
    }
    Ok(say(&text)?)
}

fn run_roofline(args: &BenchArgs) -> Result<(), Box<dyn Error>> {
    let subjects = if args.bodies.is_empty() {
        chosen(&roofline::BODIES.map(String::from))?
    } else {
        chosen(&args.bodies)?
    };
    if let Some(folder) = &args.write {
        let wrong = |e: String| e.replace("--out DIR", "--write DIR");
        make_folder(folder, &[ROOFLINE_PAGE.into()]).map_err(wrong)?;
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
