//! `frangible-lab compare`: one impact, several methods.

mod page;
mod report;

use std::error::Error;
use std::fs;

use frangible::Fragment;
use frangible_compare::{Broken, Hit, Method, Options, compare};
use frangible_recording::{make_folder, write_atomically};
use frangible_scenes::{
    FirstBreak, Opened, Scene, bake_opened, first_break, open_sources, scene_of,
};

use crate::args::CompareArgs;
use crate::output::{Bar, say};
use page::{SCENES, page};
use report::CompareReport;

/// Runs of each method, of which the fastest counts.
const RUNS: usize = 3;

/// Spread of the drawn pieces, share of their distance from the body's middle.
const APART: f32 = 0.22;

/// Size limit of a picture, bytes.
const MOST_BYTES: usize = 900_000;

/// Folder of the page's pictures.
const PICTURES: &str = "compare";

pub(crate) fn run(args: &CompareArgs) -> Result<(), Box<dyn Error>> {
    let methods = methods(&args.methods)?;
    if let Some(folder) = &args.write {
        return write_page(folder, args, &methods);
    }
    let mut scene = scene_of(args.file.as_deref(), args.scene.as_deref())?;
    if let Some(seed) = args.seed {
        scene.seed = seed;
    }
    let stem = format!("{}-compare", scene.name);
    let [png, md, json] = ["png", "md", "json"].map(|ending| format!("{stem}.{ending}"));
    let was_there = make_folder(&args.out, &[png.clone(), md.clone(), json.clone()], "--out")?;
    let bar = Bar::new(args.json);
    let (found, all, mut report) = compared(&scene, args, &methods, &bar).inspect_err(|_| {
        if !was_there {
            // Removes the folder only if it is empty, as it was made. A failure changes nothing for the user.
            let _ = fs::remove_dir(&args.out);
        }
    })?;
    let place = |name: &str| args.out.join(name);
    if !args.no_pictures {
        bar.show(&format!("{}: drawing", scene.name), 1.0);
        match picture(&found, &all) {
            Ok(bytes) => {
                write_atomically(&place(&png), &bytes)?;
                report.files.push(place(&png).display().to_string());
            }
            Err(error) => report.notes.push(format!("no picture: {error}")),
        }
    }
    drop(bar);
    for name in [&md, &json] {
        report.files.push(place(name).display().to_string());
    }
    let text = format!(
        "# {}\n\n{}\n\n{}",
        scene.name,
        report.impact(),
        report.markdown()
    );
    write_atomically(&place(&md), text.as_bytes())?;
    let text = serde_json::to_string_pretty(&report)? + "\n";
    write_atomically(&place(&json), text.as_bytes())?;
    Ok(say(if args.json { text } else { report.text() }.as_str())?)
}

/// The page of the documentation, and its pictures.
fn write_page(
    folder: &std::path::Path,
    args: &CompareArgs,
    methods: &[Method],
) -> Result<(), Box<dyn Error>> {
    make_folder(folder, &["compare.md".into()], "--write")?;
    let pictures = folder.join(PICTURES);
    make_folder(&pictures, &[], "--write")?;
    let bar = Bar::new(false);
    let mut reports = Vec::new();
    for name in SCENES {
        let scene = frangible_scenes::scene(name)?;
        let (found, all, report) = compared(&scene, args, methods, &bar)?;
        bar.show(&format!("{name}: drawing"), 1.0);
        let file = pictures.join(format!("{name}.png"));
        write_atomically(&file, &picture(&found, &all)?)?;
        reports.push(report);
    }
    drop(bar);
    let path = folder.join("compare.md");
    write_atomically(&path, page(&reports, PICTURES).as_bytes())?;
    Ok(say(&format!("  wrote {}\n", path.display()))?)
}

/// Methods by name; all if none is named.
fn methods(names: &[String]) -> Result<Vec<Method>, String> {
    if names.is_empty() {
        return Ok(Method::ALL.to_vec());
    }
    let mut methods = Vec::new();
    for name in names {
        let method = Method::from_name(name.trim())?;
        if !methods.contains(&method) {
            methods.push(method);
        }
    }
    Ok(methods)
}

/// The first break of a scene by each method.
fn compared(
    scene: &Scene,
    args: &CompareArgs,
    methods: &[Method],
    bar: &Bar,
) -> Result<(FirstBreak, Vec<Broken>, CompareReport), Box<dyn Error>> {
    bar.show(&format!("{}: reading", scene.name), 0.0);
    let sources = open_sources(scene)?;
    let notes: Vec<String> = sources.iter().flat_map(Opened::notes).cloned().collect();
    let baked = bake_opened(scene, sources, &mut |p| {
        bar.show(&format!("{}: {}", scene.name, p.stage), p.fraction);
    })?;
    let found = first_break(scene, &baked, &mut |share| {
        bar.show(
            &format!("{}: simulating up to the first break", scene.name),
            share,
        );
    })?;
    let found = found.ok_or_else(|| {
        format!(
            "no impact breaks a body in the scene `{}` with seed {}; choose another seed (--seed) or a harder blow",
            scene.name, scene.seed
        )
    })?;
    let mut options = Options::default();
    options.seed = scene.seed;
    if let Some(step) = args.step {
        options.step = 1e-3 * step;
    }
    options.sites = args.sites.unwrap_or(options.sites);
    options.cells = args.cells;
    let hit = Hit {
        body: &found.body,
        contacts: &found.contacts,
        config: &found.config,
    };
    let mut all: Vec<Broken> = Vec::new();
    for run in 0..RUNS {
        let mut done = 0;
        let again = compare(hit, methods, &options, &mut |method| {
            let share = (run * methods.len() + done) as f64 / (RUNS * methods.len()) as f64;
            bar.show(&format!("{}: {}", scene.name, method.title()), share);
            done += 1;
        })?;
        for (known, new) in all.iter_mut().zip(&again) {
            known.seconds = known.seconds.min(new.seconds);
        }
        if all.is_empty() {
            all = again;
        }
    }
    let mut report = CompareReport::new(&scene.name, scene.seed, &found, &all);
    report.notes = notes;
    Ok((found, all, report))
}

/// The body as it was hit, and the pieces of each method.
fn picture(found: &FirstBreak, all: &[Broken]) -> Result<Vec<u8>, Box<dyn Error>> {
    use frangible_photo::{SheetOptions, encode_png_within, sheet_of_frames};

    let sets: Vec<&[Fragment]> = all.iter().map(|broken| &broken.fragments[..]).collect();
    let stills = found.stills(&sets, APART);
    let Some(first) = stills.first() else {
        return Err("no method to draw".into());
    };
    let before = found.still_of_impact(first);
    let labels: Vec<String> = all.iter().map(label).collect();
    let mut cells = vec![(&before, 0, "the impact")];
    cells.extend(stills.iter().zip(&labels).map(|(s, l)| (s, 0, l.as_str())));
    let options = SheetOptions {
        cell_width: 420,
        cell_height: 340,
        columns: 3,
    };
    let sheet = sheet_of_frames(&cells, &options)?;
    Ok(encode_png_within(&sheet, MOST_BYTES)?)
}

fn label(broken: &Broken) -> String {
    match broken.pieces() {
        1 => format!("{}: held", broken.method.title()),
        n => format!("{}: {n} pieces", broken.method.title()),
    }
}
