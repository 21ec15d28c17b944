//! `frangible-lab experiments`: cracks and pieces beside published experiments.

use std::error::Error;
use std::fmt::Write;

use frangible_lab::verify::experiments::{Experiments, Figure, MassPlan, RearStarPlan, StarPlan};
use serde_json::json;

use crate::args::PageArgs;
use crate::output::{Bar, Page, say};

/// The page, and the folder of its pictures.
const PAGE: &str = "experiments.md";
const PICTURES: &str = "experiments";

pub(crate) fn run(args: &PageArgs) -> Result<(), Box<dyn Error>> {
    let place = Page::new(args.write.as_deref(), PAGE, PICTURES)?;
    let bar = Bar::new(args.json);
    let hear = |share: f64| bar.show("breaking plates and balls", share);
    let found = Experiments::compute(
        StarPlan::full(),
        RearStarPlan::full(),
        MassPlan::full(),
        &hear,
    )?;
    drop(bar);
    let page = found.page(PICTURES)?;
    let files = place.write(&page.text, &page.pictures)?;
    let figures = found.figures();
    if args.json {
        say(&format!("{:#}\n", as_json(&figures, &files)))?;
    } else {
        say(&table(&figures, &files))?;
    }
    Ok(())
}

fn table(figures: &[Figure], files: &[String]) -> String {
    let widest = figures.iter().map(|f| f.name.chars().count()).max();
    let name = widest.unwrap_or(0);
    let mut text = format!("{:name$}  {:>14}  {:>9}\n", "", "computed", "published");
    for f in figures {
        let computed = if f.error > 0.0 {
            format!("{:.2} ± {:.2}", f.value, f.error)
        } else {
            format!("{:.2}", f.value)
        };
        let published = f
            .published
            .map_or_else(|| "–".into(), |p| format!("{p:.2}"));
        let _ = writeln!(text, "{:name$}  {computed:>14}  {published:>9}", f.name);
    }
    for file in files {
        let _ = writeln!(text, "wrote {file}");
    }
    text
}

fn as_json(figures: &[Figure], files: &[String]) -> serde_json::Value {
    let figures: Vec<serde_json::Value> = figures
        .iter()
        .map(|f| json!({ "name": f.name, "value": f.value, "error": f.error, "published": f.published }))
        .collect();
    json!({ "figures": figures, "files": files })
}
