//! `frangible break`: bake, play, write, report.

use std::error::Error;
use std::path::Path;
use std::time::Instant;

use frangible::internals::Fields;
use frangible_export::{GlbOptions, write_glb_with};
use frangible_recording::write_atomically;
use frangible_scenes::{
    BakedBody, BodySpec, Drawing, Opened, Run, Scene, Simplified, Sounded, Sounding, TOLERANCE,
    bake_opened, open_scene, play, sound, sound_config,
};

use crate::args::BreakArgs;
use crate::level::encoded;
use crate::pictures;
use crate::progress::Bar;
use crate::report::{BodyReport, Report, frames_ms};
use crate::request::{Request, break_of};
use crate::say::say;
use frangible_recording::make_folder;

pub(crate) fn run(file: Option<&Path>, args: &BreakArgs) -> Result<(), Box<dyn Error>> {
    let Request { scene, mut notes } = break_of(file, args)?;
    let bar = Bar::new(args.json);
    bar.show(&format!("{}: reading", scene.name), 0.0);
    let (scene, sources) = open_scene(&scene)?;
    notes.extend(sources.iter().flat_map(Opened::notes).cloned());
    let open: Vec<bool> = sources.iter().map(Opened::is_open).collect();
    let names = scene.output.file_names(&scene.name);
    let was_there = make_folder(
        &args.out,
        &names.iter().flatten().cloned().collect::<Vec<_>>(),
        "--out",
    )?;
    let [glb, wav, picture, sheet, json] = names;
    let mut stages = Vec::new();

    let clock = Instant::now();
    let baked = bake_opened(&scene, sources, &mut |p| {
        bar.show(&format!("{}: {}", scene.name, p.stage), p.fraction);
    })
    .inspect_err(|_| {
        if !was_there {
            // Removes the folder only if it is empty, as it was made. A failure changes nothing for the user.
            let _ = std::fs::remove_dir(&args.out);
        }
    })?;
    stages.push(("bake".to_string(), 1e3 * clock.elapsed().as_secs_f64()));
    notes.extend(mesh_notes(&scene, &baked));
    notes.extend(filled(&open, &baked));
    let specs = scene.bodies.iter().zip(&baked);
    notes.extend(specs.filter_map(|(spec, baked)| crowded_flaws(spec, baked)));
    let runs = play_seeds(&scene, &baked, sheet.is_some(), &bar)?;
    let Some((_, run)) = runs.first() else {
        return Err("no seed to break with".into());
    };
    stages.extend(stages_of(run));
    notes.extend(missed(run));
    notes.extend(lighter(&run.simplified));

    let (mut files, mut heard) = (Vec::new(), None);
    let mut write = |name: String, bytes: &[u8]| -> Result<(), Box<dyn Error>> {
        let path = args.out.join(name);
        write_atomically(&path, bytes)?;
        files.push(path.display().to_string());
        Ok(())
    };
    if let Some(name) = glb {
        let clock = Instant::now();
        let mut options = GlbOptions::default();
        options.quantized = scene.output.drawing == Drawing::Light;
        write(name, &write_glb_with(&run.recording, &options)?)?;
        stages.push(("GLB".into(), 1e3 * clock.elapsed().as_secs_f64()));
    }
    if let Some(name) = wav {
        bar.show(&format!("{}: synthesising sound", scene.name), 1.0);
        let sounded = sound(run, &scene, &sound_config(run, &scene))?;
        let clock = Instant::now();
        let (bytes, report) = encoded(&sounded, args.level.into())?;
        write(name, &bytes)?;
        let seconds = sounded.seconds.iter().sum::<f64>() + clock.elapsed().as_secs_f64();
        stages.push(("sound".into(), 1e3 * seconds));
        notes.push(report.note());
        notes.extend(left_out(&sounded));
        heard = Some(report);
    }
    if picture.is_some() || sheet.is_some() {
        bar.show(&format!("{}: drawing", scene.name), 1.0);
        let clock = Instant::now();
        match pictures::draw(&runs, picture.as_deref(), sheet.as_deref()) {
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

    let mut bodies = bodies_of(&scene, &baked, run);
    let mut report = Report {
        scene: scene.name.clone(),
        seed: scene.seed,
        only: if bodies.len() == 1 {
            bodies.pop()
        } else {
            None
        },
        bodies,
        sound: heard,
        at_rest: run.at_rest,
        simulated_s: run.simulated,
        frames_ms: frames_ms(run),
        stages_ms: stages,
        files,
        notes,
    };
    if let Some(name) = json {
        let path = args.out.join(name);
        report.files.push(path.display().to_string());
        write_atomically(&path, serde_json::to_string_pretty(&report)?.as_bytes())?;
    }
    if args.json {
        say(&(serde_json::to_string_pretty(&report)? + "\n"))?;
    } else {
        say(&report.table())?;
    }
    Ok(())
}

/// Note for a run in which nothing that was thrown met a body.
fn missed(run: &Run) -> Option<String> {
    let thrown = |node: usize| matches!(run.soundings.get(node), Some(Sounding::Ball(..)));
    let touches = run.recording.touches.iter().map(|touch| touch.nodes);
    let slides = run.recording.slides.iter().map(|slide| slide.nodes);
    let met = touches
        .chain(slides)
        .any(|(node, other)| other.is_some_and(|other| thrown(node) || thrown(other)));
    // The record does not say who gave a blow.
    if !(0..run.soundings.len()).any(thrown) || met || !run.blows.is_empty() {
        return None;
    }
    Some(format!(
        "no projectile hit a body in the {:.2} s of the run; aim with --at and --toward (in a scene file: `at` and `toward`)",
        run.simulated
    ))
}

/// Note on what a light drawing has left.
fn lighter(drawn: &Simplified) -> Option<String> {
    (drawn.full > 0).then(|| {
        let more = match drawn.light > drawn.wanted {
            true => format!(
                "; the aim of {} cannot be met within {:.1} %",
                drawn.wanted,
                100.0 * TOLERANCE
            ),
            false => String::new(),
        };
        format!(
            "light drawing: {} triangles of pieces instead of {}, at most {:.3} mm away ({:.2} % of the body), without cracks that end inside{more}",
            drawn.light,
            drawn.full,
            1e3 * drawn.error,
            100.0 * drawn.share
        )
    })
}

/// Note on what a sound lacks because there was too much at once.
fn left_out(sounded: &Sounded) -> Option<String> {
    let (strikes, tones) = (sounded.report.strikes_left_out, sounded.report.over_budget);
    (strikes + tones > 0).then(|| {
        format!(
            "the sound omits the softest {strikes} strikes and {tones} tones because too many sounded at once"
        )
    })
}

/// Share of its volume by which the mesh of a wall may differ from the drawn surface without a note. What a lattice loses at sharp corners is in the
/// report.
const VOLUME_OFF: f64 = 1e-3;

/// Notes on the loose pieces and sharp features that the mesher left out.
fn mesh_notes(scene: &Scene, baked: &[BakedBody]) -> Vec<String> {
    let mut notes = Vec::new();
    for (body, baked) in scene.bodies.iter().zip(baked) {
        if let Some(report) = &baked.report
            && report.tetrahedra.is_none()
            && let Some(drawn) = report.closed_volume
            && (report.fracture.volume / drawn - 1.0).abs() > VOLUME_OFF
        {
            notes.push(format!(
                "{}: the mesh of its wall has {:+.2} % of volume beside the drawn surface; raise --resolution to come closer",
                body.name,
                100.0 * (report.fracture.volume / drawn - 1.0)
            ));
        }
        let Some(mesh) = baked.report.as_ref().and_then(|r| r.tetrahedra.as_ref()) else {
            continue;
        };
        if mesh.pieces > 1 {
            notes.push(format!(
                "{}: {} disconnected {} left out, {:.2} % of the volume",
                body.name,
                mesh.pieces - 1,
                if mesh.pieces == 2 { "piece" } else { "pieces" },
                100.0 * (1.0 - mesh.kept)
            ));
        }
        if mesh.features.not_snapped * 10 > mesh.features.sharp {
            notes.push(format!(
                "{}: {} of {} sharp edges and corners are rounded off; raise --resolution to keep more of them",
                body.name, mesh.features.not_snapped, mesh.features.sharp
            ));
        }
    }
    notes
}

/// Volume of a body beside that of the closed surface that it was made from, in words, if that is known.
pub(crate) fn baked_off(body: &BakedBody) -> Option<String> {
    let closed = body.report.as_ref()?.closed_volume?;
    let off = 100.0 * (body.asset.mass().volume / closed - 1.0);
    Some(format!(
        "encloses {:.3} cm³, the body has {off:+.3} %",
        1e6 * closed
    ))
}

/// Notes on the bodies whose surface is open. They are filled as solids: such a surface may be the skin of a pot, or a solid with a hole.
pub(crate) fn filled(open: &[bool], baked: &[BakedBody]) -> Vec<String> {
    let open = open.iter().zip(baked).filter(|(open, _)| **open);
    open.map(|(_, body)| {
        let asset = &body.asset;
        format!(
            "{}: the surface is open and was filled as a solid of {:.3} kg; for a thin-walled body, give the wall thickness with --wall METRES",
            asset.name(), asset.mass().mass
        )
    })
    .collect()
}

/// Note on a body whose strength, toughness and density of weak points contradict each other.
fn crowded_flaws(spec: &BodySpec, baked: &BakedBody) -> Option<String> {
    let material = baked.asset.material();
    let fields = Fields::of_material(material);
    let modulus = spec.weibull_modulus.unwrap_or(fields.weibull_modulus);
    let specimen = spec.specimen.unwrap_or(fields.specimen);
    let flaws = (material.weak_point_density * specimen).max(1.0);
    let single = if modulus > 0.0 {
        flaws.powf(1.0 / modulus)
    } else {
        1.0
    };
    let depth = material.flaw_depth(material.fracture_energy, single * material.strength);
    let spacing = material.weak_point_spacing();
    (depth > spacing).then(|| {
        format!(
            "{}: at the strength of `{}` a weak point is a flaw of {:.1} mm, but weak points lie only {:.1} mm apart; with weibull_modulus = 6, few of them are that weak",
            baked.asset.name(),
            material.name,
            1e3 * depth,
            1e3 * spacing
        )
    })
}

/// Plays the scene, with a sheet once per seed, the scene's own first.
fn play_seeds(
    scene: &Scene,
    baked: &[BakedBody],
    sheet: bool,
    bar: &Bar,
) -> Result<Vec<(u64, Run)>, Box<dyn Error>> {
    let count = if sheet { scene.output.seeds } else { 1 };
    let mut scene = scene.clone();
    let first = scene.seed;
    let mut runs = Vec::with_capacity(count);
    for i in 0..count {
        scene.seed = first.wrapping_add(i as u64);
        let message = format!("{}: breaking, seed {}", scene.name, scene.seed);
        let run = play(&scene, baked, &mut |done| bar.show(&message, done))?;
        runs.push((scene.seed, run));
    }
    Ok(runs)
}

fn stages_of(run: &Run) -> Vec<(String, f64)> {
    let mut stages = Vec::new();
    if !run.breaks.is_empty() {
        let timings = || run.breaks.iter().map(|b| b.report.timings);
        for (name, seconds) in [
            ("response", timings().map(|t| t.response).sum::<f64>()),
            ("stress", timings().map(|t| t.stress).sum()),
            ("cracks", timings().map(|t| t.cracks).sum()),
            (
                "fragments",
                timings().map(|t| t.labels + t.fragments + t.drawing).sum(),
            ),
        ] {
            stages.push((name.to_string(), 1e3 * seconds));
        }
    }
    stages.push(("rigid bodies".into(), 1e3 * run.rigid_seconds));
    stages
}

fn bodies_of(scene: &Scene, baked: &[BakedBody], run: &Run) -> Vec<BodyReport> {
    scene
        .bodies
        .iter()
        .zip(baked)
        .enumerate()
        .map(|(i, (body, baked))| BodyReport::new(&body.name, baked, run, i))
        .collect()
}

#[cfg(test)]
mod tests {
    use frangible_scenes::Simplified;

    use super::lighter;

    #[test]
    fn a_light_drawing_with_more_triangles_than_wanted_says_so() {
        let mut drawn = Simplified {
            full: 9000,
            light: 1200,
            wanted: 1200,
            error: 1e-3,
            share: 5e-3,
        };
        let note = lighter(&drawn).expect("a note");
        assert!(note.starts_with("light drawing: 1200 triangles of pieces instead of 9000"));
        assert!(!note.contains("aim"), "{note}");
        drawn.light = 1201;
        let note = lighter(&drawn).expect("a note");
        assert!(note.contains("1201 triangles"), "{note}");
        assert!(
            note.ends_with("; the aim of 1200 cannot be met within 0.5 %"),
            "{note}"
        );
        assert_eq!(lighter(&Simplified::default()), None);
    }
}
