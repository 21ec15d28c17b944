//! `frangible modes`: how a body vibrates.

use std::error::Error;
use std::f32::consts::FRAC_PI_2;
use std::path::{Path, PathBuf};

use frangible::glam::{Quat, Vec3};
use frangible_bake::Shape;
use frangible_recording::write_atomically;
use frangible_scenes::{BodySource, BodySpec, Opened, bake_opened, open_sources};

use crate::args::ModesArgs;
use crate::mode_files::{analysis_vtu, fracture_vtu, picture};
use crate::mode_report::ModeReport;
use crate::progress::Bar;
use crate::request::body_with_modes;
use crate::say::say;
use frangible_recording::try_file;

/// The most shapes that one sheet can show.
const MOST_DRAWN: usize = 36;

/// Direction from the body towards the camera: high enough that plates are seen from above.
const LOOK_FROM: Vec3 = Vec3::new(0.55, 0.7, 1.0);

/// Stands a body up that its scene tilts or drops on its rim: shapes of revolution and ready solids have z up.
fn upright(body: &BodySpec) -> Quat {
    match &body.source {
        BodySource::Shape(Shape::Box { .. }) | BodySource::Mesh { .. } | BodySource::Asset(_) => {
            body.rotation
        }
        _ => Quat::from_rotation_x(-FRAC_PI_2),
    }
}

pub(crate) fn run(args: &ModesArgs) -> Result<(), Box<dyn Error>> {
    let drawn = usize::try_from(args.modes)
        .ok()
        .filter(|n| (1..=MOST_DRAWN).contains(n))
        .ok_or_else(|| format!("--modes is {}; it must be 1 to {MOST_DRAWN}", args.modes))?;
    for (option, path, ending) in [
        ("-o", &args.output, "png"),
        ("--vtu", &args.vtu, "vtu"),
        ("--fracture-vtu", &args.fracture_vtu, "vtu"),
    ] {
        if let Some(path) = path
            && !ends_in(path, ending)
        {
            return Err(format!(
                "{option} is `{}`; its name must end in .{ending}",
                path.display()
            )
            .into());
        }
    }
    if args.vtu.is_some() && args.vtu == args.fracture_vtu {
        return Err("--vtu and --fracture-vtu name the same file; give each its own".into());
    }
    let scene = body_with_modes(args)?;
    let [spec] = &scene.bodies[..] else {
        return Err("the scene has no body; add a [[body]]".into());
    };
    let bar = Bar::new(false);
    bar.show(&format!("{}: reading", scene.name), 0.0);
    let sources = open_sources(&scene)?;
    let mut notes: Vec<String> = sources.iter().flat_map(Opened::notes).cloned().collect();
    let png = picture_path(args, &scene.name)?;
    for path in [&png, &args.vtu, &args.fracture_vtu].into_iter().flatten() {
        try_file(path)?;
    }

    let baked = bake_opened(&scene, sources, &mut |p| {
        bar.show(&format!("{}: {}", scene.name, p.stage), p.fraction);
    })?;
    let Some(body) = baked.first() else {
        return Err("the scene has no body; add a [[body]]".into());
    };
    let asset = &body.asset;
    let mut files = Vec::new();
    let mut write = |path: &Path, bytes: &[u8]| {
        files.push(path.display().to_string());
        write_atomically(path, bytes)
    };
    if let Some(path) = &png {
        bar.show(&format!("{}: drawing", scene.name), 1.0);
        match picture(asset, drawn, upright(spec), LOOK_FROM) {
            Ok(bytes) => write(path, &bytes)?,
            // As of other pictures: the figures are worth having without.
            Err(error) => notes.push(format!("no picture: {error}")),
        }
    }
    if let Some(path) = &args.vtu {
        write(path, &analysis_vtu(asset)?)?;
    }
    if let Some(path) = &args.fracture_vtu {
        write(path, &fracture_vtu(asset)?)?;
    }
    drop(bar);
    let report = ModeReport::new(body, files, notes);
    if args.json {
        say(&(serde_json::to_string_pretty(&report)? + "\n"))?;
    } else {
        say(&report.table(drawn))?;
    }
    Ok(())
}

/// Path of the picture, or None if there is to be none. The default folder is made if no path was named.
fn picture_path(args: &ModesArgs, name: &str) -> Result<Option<PathBuf>, String> {
    if args.no_pictures {
        return Ok(None);
    }
    if let Some(path) = &args.output {
        return Ok(Some(path.clone()));
    }
    let folder = Path::new("out");
    std::fs::create_dir_all(folder).map_err(|e| {
        format!("cannot make the folder `out`: {e}; name the picture's file with -o FILE.png")
    })?;
    Ok(Some(folder.join(format!("{name}-modes.png"))))
}

fn ends_in(path: &Path, ending: &str) -> bool {
    path.extension()
        .is_some_and(|found| found.eq_ignore_ascii_case(ending))
}
