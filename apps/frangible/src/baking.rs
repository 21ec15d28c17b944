//! `frangible bake`: a body into a file.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::time::Instant;

use frangible_bake::frangible_mesh::PartChoice;
use frangible_scenes::{
    BakedBody, BodySource, FileKind, Opened, Scene, bake_opened, compacted, open_scene,
    open_sources, save_asset, save_compact_asset, tame,
};

use crate::args::BakeArgs;
use crate::breaking::{baked_off, filled};
use crate::progress::Bar;
use crate::request::body_of;
use crate::say::say;
use frangible_recording::try_file;

/// Largest relative change of a mode's peak stress that `--compact` may make.
const MOST_CHANGE: f64 = 0.1;

pub(crate) fn run(args: &BakeArgs) -> Result<(), Box<dyn Error>> {
    let scene = body_of(args)?;
    if !matches!(FileKind::of(&args.output), Ok(FileKind::Asset)) {
        let given = args.output.display();
        return Err(format!(
            "-o is `{given}`; the name of a baked body's file must end in .frangible"
        )
        .into());
    }
    let bar = Bar::new(false);
    bar.show(&format!("{}: reading", scene.name), 0.0);
    let is_separate = args.mesh.parts.as_deref() == Some("separate");
    let (scene, sources) = if is_separate {
        open_scene(&scene)?
    } else {
        let sources = open_sources(&scene)?;
        (scene, sources)
    };
    let mut notes: Vec<String> = sources.iter().flat_map(Opened::notes).cloned().collect();
    let open: Vec<bool> = sources.iter().map(Opened::is_open).collect();
    let outputs = outputs(&scene, &args.output);
    for output in &outputs {
        try_file(output)?;
    }

    let clock = Instant::now();
    let baked = bake_opened(&scene, sources, &mut |p| {
        bar.show(&format!("{}: {}", scene.name, p.stage), p.fraction);
    })?;
    drop(bar);
    let seconds = clock.elapsed().as_secs_f64();
    notes.extend(filled(&open, &baked));
    let mut text = String::new();
    for (body, output) in baked.iter().zip(&outputs) {
        text += &quality(body);
        text += &save(body, output, args.compact)?;
    }
    text += &row("seconds", &format!("{seconds:.2}"));
    for note in notes {
        text += &row("note", &note);
    }
    Ok(say(&text)?)
}

/// The file of each body: the one that was named, or, of several, one with the name of each part.
fn outputs(scene: &Scene, output: &Path) -> Vec<PathBuf> {
    if scene.bodies.len() < 2 {
        return vec![output.to_path_buf()];
    }
    let stem = output.file_stem().unwrap_or_default().to_string_lossy();
    let names = scene.bodies.iter().map(|body| match &body.source {
        BodySource::Mesh {
            parts: PartChoice::Only(part),
            ..
        } => tame(part),
        _ => tame(&body.name),
    });
    names
        .map(|name| output.with_file_name(format!("{stem}-{name}.frangible")))
        .collect()
}

/// Writes a baked body. Returns what is to be said of it.
fn save(body: &BakedBody, output: &Path, compact: bool) -> Result<String, Box<dyn Error>> {
    let mut text = String::new();
    if compact {
        let (asset, change) = compacted(&body.asset);
        if change > MOST_CHANGE {
            return Err(format!(
                "half precision would change the peak stress of a mode of `{}` by {:.0} %, as happens where walls are thin; remove --compact",
                body.asset.name(),
                100.0 * change
            )
            .into());
        }
        save_compact_asset(&asset, output)?;
        let value = format!(
            "mode shapes in half precision; peak stress of the modes changed by up to {:.3} %",
            100.0 * change
        );
        text += &row("compact", &value);
    } else {
        save_asset(&body.asset, output)?;
    }
    let shapes = size_of_val(&*body.asset.modes().shapes) as f64;
    text += &row(
        "wrote",
        &format!(
            "{}, {:.1} MB; the modes take {:.1} MB in memory",
            output.display(),
            1e-6 * std::fs::metadata(output).map_or(0, |m| m.len()) as f64,
            1e-6 * shapes
        ),
    );
    Ok(text)
}

fn row(name: &str, value: &str) -> String {
    format!("  {name:<15} {value}\n")
}

/// Figures of the baked body, a row each.
fn quality(body: &BakedBody) -> String {
    let asset = &body.asset;
    let mut text = String::new();
    let mut row = |name: &str, value: String| text += &row(name, &value);
    row(
        "body",
        format!("{}, {}", asset.name(), asset.material().name),
    );
    if let Some(report) = &body.report {
        for (name, mesh) in [
            ("fracture mesh", &report.fracture),
            ("analysis mesh", &report.analysis),
        ] {
            row(
                name,
                format!(
                    "{} tetrahedra, {} nodes, smallest dihedral angle {:.1}°, volume {:.3} cm³",
                    mesh.tets,
                    mesh.nodes,
                    mesh.min_dihedral,
                    1e6 * mesh.volume
                ),
            );
        }
        if let Some(mesh) = &report.tetrahedra {
            row("solid", mesh.to_string());
        }
        let first = report.frequencies.first().copied().unwrap_or(0.0);
        row(
            "modes",
            format!(
                "{} kept, from {first:.0} Hz (residual {:.0e}); {} integrated through time, up to {:.0} Hz",
                report.modes,
                report.max_residual,
                report.followed,
                asset.modes().frequency(report.followed - 1)
            ),
        );
        if asset.is_supported() {
            let share = asset.supported().len() as f64 / report.fracture.nodes as f64;
            row("supports", format!("{:.1} % of the nodes", 100.0 * share));
        }
        row("collider", format!("{} convex cells", report.cells));
        let stages: Vec<String> = report
            .seconds
            .iter()
            .map(|(stage, s)| format!("{stage} {s:.2}"))
            .collect();
        row("stages", format!("{} s", stages.join(", ")));
    }
    row("mass", format!("{:.4} kg", asset.mass().mass));
    if let Some(off) = baked_off(body) {
        row("surface", off);
    }
    text
}
