//! `frangible break`: bake, play, write, report.

use std::error::Error;
use std::fs;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use frangible::Asset;
use frangible_bake::BakeReport;
use frangible_export::{Recording, write_atomically, write_glb};
use frangible_scenes::{Run, Scene, bake, play};

use crate::args::BreakArgs;
use crate::progress::Bar;
use crate::report::{Impact, Report};
use crate::request::scene_of;

/// File name and PNG bytes.
type Picture = (String, Vec<u8>);

/// Most seeds in one sheet.
const MOST_SEEDS: i64 = 36;

pub(crate) fn run(args: &BreakArgs) -> Result<(), Box<dyn Error>> {
    let mut scene = scene_of(args)?;
    let seeds = match args.contact_sheet {
        None => 1,
        Some(n @ 1..=MOST_SEEDS) => n as u64,
        Some(n) => {
            return Err(format!("--contact-sheet is {n}; it must be 1 to {MOST_SEEDS}").into());
        }
    };
    make_folder(&args.out)?;
    for ending in ["glb", "png"] {
        let path = args.out.join(format!("{}.{ending}", scene.name));
        if path.is_dir() {
            return Err(format!("`{}` is a folder, and a file of that name is to be written; move it, or choose another --out DIR", path.display()).into());
        }
    }
    let mut stages = Vec::new();

    let bar = Bar::new(args.json);
    let clock = Instant::now();
    let (asset, baked) = bake(&scene, &mut |p| {
        bar.show(&format!("{}: {}", scene.name, p.stage), p.fraction);
    })?;
    stages.push(("bake".to_string(), 1e3 * clock.elapsed().as_secs_f64()));

    let first_seed = scene.seed;
    let mut runs = Vec::new();
    for i in 0..seeds {
        scene.seed = first_seed.wrapping_add(i);
        let message = format!("{}: breaking, seed {}", scene.name, scene.seed);
        runs.push((
            scene.seed,
            play(&scene, &asset, &mut |done| bar.show(&message, done))?,
        ));
    }
    scene.seed = first_seed;
    let run = &runs[0].1;
    stages.extend(stages_of(run));

    let mut files = Vec::new();
    let mut notes = Vec::new();
    let mut write = |name: String, bytes: &[u8]| -> Result<(), Box<dyn Error>> {
        let path = args.out.join(name);
        write_atomically(&path, bytes)?;
        files.push(path.display().to_string());
        Ok(())
    };
    let clock = Instant::now();
    write(format!("{}.glb", scene.name), &write_glb(&run.recording)?)?;
    stages.push(("GLB".into(), 1e3 * clock.elapsed().as_secs_f64()));
    if !args.no_pictures {
        bar.show(&format!("{}: drawing", scene.name), 1.0);
        let clock = Instant::now();
        match pictures(&scene.name, &runs, args.contact_sheet.is_some()) {
            Ok(pictures) => {
                for (name, png) in pictures {
                    write(name, &png)?;
                }
            }
            Err(error) => notes.push(format!("no pictures: {error}")),
        }
        stages.push(("pictures".into(), 1e3 * clock.elapsed().as_secs_f64()));
    }
    drop(bar);

    let report = summary(
        &scene,
        &asset,
        &baked,
        run,
        Output {
            stages,
            files,
            notes,
        },
    );
    if args.json {
        println!("{}", serde_json::to_string_pretty(&report)?);
    } else {
        print!("{}", report.table());
    }
    Ok(())
}

/// Makes the output folder and proves that it can be written, before minutes are spent.
fn make_folder(folder: &Path) -> Result<(), String> {
    let wrong = |e: std::io::Error| {
        format!(
            "cannot write to the folder `{}`: {e}; choose another with --out DIR",
            folder.display()
        )
    };
    fs::create_dir_all(folder).map_err(wrong)?;
    let probe = folder.join(format!(".frangible-{}", std::process::id()));
    fs::write(&probe, b"").map_err(wrong)?;
    fs::remove_file(&probe).map_err(wrong)
}

#[cfg(feature = "draw")]
fn pictures(scene: &str, runs: &[(u64, Run)], sheet: bool) -> Result<Vec<Picture>, Box<dyn Error>> {
    use frangible_draw::{SheetOptions, contact_sheet, encode_png, sheet_of_frames};

    let recording: &Recording = &runs[0].1.recording;
    let mut pictures = vec![(
        format!("{scene}.png"),
        encode_png(&contact_sheet(recording, &SheetOptions::default())?)?,
    )];
    if sheet {
        let labels: Vec<String> = runs
            .iter()
            .map(|(seed, run)| format!("seed {seed}: {}", pieces(run)))
            .collect();
        let cells: Vec<(&Recording, usize, &str)> = runs
            .iter()
            .zip(&labels)
            .map(|((_, run), label)| {
                (
                    &run.recording,
                    run.recording.moments.at_rest,
                    label.as_str(),
                )
            })
            .collect();
        let columns = (cells.len() as f64).sqrt().ceil() as u32;
        let options = SheetOptions {
            cell_width: 480,
            cell_height: 360,
            columns,
        };
        pictures.push((
            format!("{scene}-seeds.png"),
            encode_png(&sheet_of_frames(&cells, &options)?)?,
        ));
    }
    Ok(pictures)
}

#[cfg(not(feature = "draw"))]
fn pictures(_: &str, _: &[(u64, Run)], _: bool) -> Result<Vec<Picture>, Box<dyn Error>> {
    Err("this build has none; build with the feature `draw`".into())
}

#[cfg(feature = "draw")]
fn pieces(run: &Run) -> String {
    run.breaks
        .first()
        .map_or("held".into(), |b| format!("{} pieces", b.masses.len()))
}

fn stages_of(run: &Run) -> Vec<(String, f64)> {
    let mut stages = Vec::new();
    if let Some(b) = run.breaks.first() {
        let t = b.report.timings;
        for (name, seconds) in [
            ("response", t.response),
            ("stress", t.stress),
            ("cracks", t.cracks),
            ("fragments", t.fragments),
        ] {
            stages.push((name.to_string(), 1e3 * seconds));
        }
    }
    stages.push(("rigid bodies".into(), 1e3 * run.rigid_seconds));
    stages
}

struct Output {
    stages: Vec<(String, f64)>,
    files: Vec<String>,
    notes: Vec<String>,
}

fn summary(
    scene: &Scene,
    asset: &Arc<Asset>,
    baked: &BakeReport,
    run: &Run,
    output: Output,
) -> Report {
    let broken = run.breaks.first();
    let impact = broken
        .map(|b| Impact::new(&b.report, &b.contacts))
        .or_else(|| {
            run.held
                .as_ref()
                .map(|h| Impact::new(&h.report, &h.contacts))
        });
    Report {
        scene: scene.name.clone(),
        material: scene.material.name.clone(),
        seed: scene.seed,
        broke: broken.is_some(),
        fracture_nodes: baked.fracture.nodes,
        fracture_tets: baked.fracture.tets,
        analysis_nodes: baked.analysis.nodes,
        analysis_elements: baked.analysis.tets,
        modes: asset.modes.count(),
        first_frequencies_hz: baked.frequencies.iter().copied().take(4).collect(),
        largest_residual: baked.max_residual,
        impact,
        fragments: broken.map_or(1, |b| b.masses.len()),
        mass_kg: asset.mass.mass,
        fragment_mass_sum_kg: broken.map_or(asset.mass.mass, |b| b.masses.iter().sum()),
        volume_m3: asset.mass.volume,
        fragment_volume_sum_m3: broken.map_or(asset.mass.volume, |b| b.volume),
        largest_fragments_kg: broken
            .map_or(Vec::new(), |b| b.masses.iter().copied().take(5).collect()),
        at_rest: run.at_rest,
        simulated_s: run.simulated,
        stages_ms: output.stages,
        files: output.files,
        notes: output.notes,
    }
}
