//! `frangible-lab figures`: the paper's figures, computed.

use std::error::Error;
use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::time::Instant;

use frangible_lab::figures::page::{page, part, verdict};
use frangible_lab::figures::{Figure, Findings, compute, figures_named};
use frangible_photo::encode_png_within;
use frangible_recording::{make_folder, write_atomically};
use serde_json::{Value, json};

use crate::args::FiguresArgs;
use crate::output::{Bar, say};

/// The page, and the folder of its pictures.
const PAGE: &str = "figures.md";
const PICTURES: &str = "figures";
/// Size limit of a picture, bytes.
const MOST_BYTES: usize = 600_000;

pub(crate) fn run(args: &FiguresArgs) -> Result<(), Box<dyn Error>> {
    let figures = figures_named(&args.names)?;
    make_folder(&args.write, &[PAGE.into()], "--write")?;
    let folder = args.write.join(PICTURES);
    make_folder(&folder, &[], "--write")?;

    let bar = Bar::new(args.json);
    let mut text = String::new();
    let mut found = Vec::new();
    let mut parts = Vec::new();
    let mut clock = Instant::now();
    compute(
        &figures,
        &mut |what, share| bar.show(what, share),
        &mut |figure, findings: Findings| -> Result<(), Box<dyn Error>> {
            let path = folder.join(format!("{}.png", figure.name));
            let png = encode_png_within(&findings.picture.image.clone().into(), MOST_BYTES)?;
            write_atomically(&path, &png)?;
            let seconds = clock.elapsed().as_secs_f64();
            clock = Instant::now();
            describe(&mut text, figure, &findings, seconds, &path);
            found.push(as_json(figure, &findings, seconds, &path));
            parts.push((figure, part(figure, &findings, PICTURES)));
            Ok(())
        },
    )?;
    drop(bar);
    let path = args.write.join(PAGE);
    let older = fs::read_to_string(&path).unwrap_or_default();
    write_atomically(&path, page(&parts, &older).as_bytes())?;
    if args.json {
        let all = json!({ "figures": found, "page": path.display().to_string() });
        return Ok(say(&format!("{all:#}\n"))?);
    }
    let _ = writeln!(text, "wrote {}", path.display());
    Ok(say(&text)?)
}

/// A figure for scripts: its claims with their verdicts, and its tables with the cells as they stand on the page.
fn as_json(figure: &Figure, found: &Findings, seconds: f64, path: &Path) -> Value {
    let claims: Vec<Value> = found
        .claims
        .iter()
        .map(|c| json!({ "says": c.says, "measured": c.measured, "agrees": c.holds }))
        .collect();
    let tables: Vec<Value> = found
        .tables
        .iter()
        .map(|t| json!({ "heading": t.heading, "rows": t.rows }))
        .collect();
    json!({
        "name": figure.name,
        "title": figure.title,
        "seconds": seconds,
        "claims": claims,
        "tables": tables,
        "picture": path.display().to_string(),
    })
}

fn describe(text: &mut String, figure: &Figure, found: &Findings, seconds: f64, path: &Path) {
    let _ = writeln!(text, "{} ({seconds:.1} s)", figure.title);
    for claim in &found.claims {
        let says = claim.says.split(" (").next().unwrap_or(&claim.says);
        let verdict = verdict(claim).replace('*', "");
        let _ = writeln!(text, "  {verdict}: {says}: {}", claim.measured);
    }
    let _ = writeln!(text, "  wrote {}", path.display());
}
