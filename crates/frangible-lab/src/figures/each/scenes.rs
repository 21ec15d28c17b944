//! Fig. 1: a glass, a piggy bank and three plates.

use frangible::glam::{Quat, Vec3};
use frangible::{FractureConfig, Material};
use frangible_photo::{PhotoError, SheetOptions, Studio, sheet_of_frames};
use frangible_recording::{Recording, View};
use frangible_scenes::{BakedBody, BodySource, Projectile, Run, Scene, bake, play, scene};
use image::RgbImage;

use crate::figures::FigureError;
use crate::figures::draw::{below, beside};
use crate::figures::figure::{Claim, Figure, Findings, Picture, Table};
use crate::figures::workshop::Workshop;

pub(crate) const FIGURE: Figure = Figure {
    name: "fig1",
    title: "Fig. 1: a glass, a piggy bank and three plates",
    shows: "\"a water glass breaks (with partial fractures) at the second bounce\", \"a piggy bank smashed by a hammer\", \"three plates dropped with different \
            material properties\".",
    compute,
};

/// Fracture tetrahedra of these bodies, about, and their modes.
const TETS: usize = 20_000;
const MODES: usize = 80;

/// Drops of the glass that are tried: tilts, degrees, and heights, m.
const TILTS: [f32; 6] = [75.0, 100.0, 60.0, 115.0, 40.0, 130.0];
/// Height of the lowest drop, m, and factor from each drop to the next.
const LOWEST: f64 = 0.15;
const HIGHER: f64 = 1.08;

/// Drops at each tilt: up to about 3 m.
const DROPS: i32 = 40;

/// Longest simulated time of the search, and simulated time that is shown, s.
const SEARCHED: f64 = 1.6;
const SHOWN: f64 = 4.0;

/// Speed of the hammer, m/s: R_c of the paper's piggy bank is more than ten times that of porcelain.
const HAMMER: f64 = 20.0;

/// Material of each plate.
const PLATES: [&str; 3] = ["porcelain", "glass", "chocolate"];

fn compute(workshop: &mut Workshop<'_>) -> Result<Findings, FigureError> {
    workshop.tell("the glass: looking for a drop", 0.0);
    let glass = second_bounce()?;
    workshop.tell("the piggy bank", 0.4);
    let pig = piggy_bank()?;
    let mut plates = Vec::new();
    for (i, material) in PLATES.into_iter().enumerate() {
        workshop.tell(&format!("a plate of {material}"), 0.6 + 0.1 * i as f64);
        plates.push(plate(material)?);
    }
    workshop.tell("drawing", 0.9);
    let count = pieces_of(&pig);
    let plate_pieces: Vec<usize> = plates.iter().map(pieces_of).collect();
    let mut table = Table::new([
        "scene",
        "bounce at which it broke",
        "peak stress",
        "cracks",
        "pieces",
    ]);
    let named = [("glass", &glass.run), ("piggy bank", &pig)];
    let plates_named = PLATES.iter().zip(&plates).map(|(m, run)| (*m, run));
    for (name, run) in named.into_iter().chain(plates_named) {
        if let Some(record) = run.breaks.first() {
            table.row([
                name.into(),
                bounce_of_break(run).map_or("–".into(), |b| b.to_string()),
                format!("{:.0} MPa", 1e-6 * record.report.peak_stress),
                record.report.cracks.to_string(),
                record.masses.len().to_string(),
            ]);
        }
    }
    let differ = plate_pieces[0] != plate_pieces[1] && plate_pieces[1] != plate_pieces[2];
    Ok(Findings {
        picture: Picture {
            image: draw(&glass, &pig, &plates)?,
            caption: "a glass that breaks at its second bounce, a piggy bank under a hammer, plates of three materials".into(),
        },
        text: format!(
            "Above, a drinking glass of real glass dropped from {:.2} m, tilted by {:.0}°: of the drops tried the first after which the second bounce \
             breaks it and not the first. Its stress is {:.0} MPa then; the paper's glass, with an R_c of 4 GPa, would hold. In the middle, a piggy bank of \
             `paper-piggy` under a hammer of 0.5 kg at {HAMMER:.0} m/s, the paper's model. Below, dinner plates dropped alike from 1.5 m on their \
             edge. Glass and plates: our model.",
            glass.height,
            glass.tilt,
            1e-6 * glass.run.breaks.first().map_or(0.0, |b| b.report.peak_stress)
        ),
        claims: vec![
            Claim::new(
                "a glass survives its first bounce and breaks at the second",
                format!("at bounce {}", bounce_of_break(&glass.run).unwrap_or(0)),
                bounce_of_break(&glass.run) == Some(2),
            ),
            Claim::new("a hammer smashes a piggy bank (five pieces or more)", format!("{count} pieces"), count >= 5),
            Claim::new(
                "plates of other materials break otherwise (three different numbers of pieces)",
                format!("{plate_pieces:?} pieces of {}", PLATES.join(", ")),
                differ && plate_pieces[0] != plate_pieces[2],
            ),
        ],
        tables: vec![table],
    })
}

/// A drop and its outcome.
struct Drop {
    height: f64,
    tilt: f32,
    run: Run,
}

fn pieces_of(run: &Run) -> usize {
    run.breaks.first().map_or(1, |b| b.masses.len())
}

/// The first drop of the glass that it survives, but not its second bounce; without one the first that breaks it later than at once.
fn second_bounce() -> Result<Drop, FigureError> {
    let mut scene = small("glass")?;
    scene.duration = SEARCHED;
    let baked = bake(&scene)?;
    let mut later = None;
    for tilt in TILTS {
        tilted(&mut scene, tilt);
        for height in (0..DROPS).map(|k| LOWEST * HIGHER.powi(k)) {
            scene.drop_all(height);
            let run = play(&scene, &baked, &mut |_| {})?;
            match bounce_of_break(&run) {
                None => {}
                Some(2) => return shown(&mut scene, &baked, height, tilt),
                Some(1) => break,
                Some(_) => later = later.or(Some((height, tilt))),
            }
        }
    }
    let (height, tilt) = later.ok_or(FigureError::Nothing(
        "no drop breaks the glass at its second bounce",
    ))?;
    tilted(&mut scene, tilt);
    shown(&mut scene, &baked, height, tilt)
}

fn tilted(scene: &mut Scene, degrees: f32) {
    let upright = Quat::from_rotation_x(-std::f32::consts::FRAC_PI_2);
    for body in &mut scene.bodies {
        body.rotation = Quat::from_rotation_z(degrees.to_radians()) * upright;
    }
}

fn shown(
    scene: &mut Scene,
    baked: &[BakedBody],
    height: f64,
    tilt: f32,
) -> Result<Drop, FigureError> {
    scene.drop_all(height);
    scene.duration = SHOWN;
    let run = play(scene, baked, &mut |_| {})?;
    Ok(Drop { height, tilt, run })
}

/// A built-in scene with a body of fewer elements and modes.
fn small(name: &str) -> Result<Scene, FigureError> {
    let mut scene = scene(name)?;
    for body in &mut scene.bodies {
        body.modes = MODES;
        match &mut body.source {
            BodySource::Ready { resolution, .. } => *resolution = Some(2 * TETS),
            _ => body.resolution = Some(TETS),
        }
    }
    Ok(scene)
}

fn piggy_bank() -> Result<Run, FigureError> {
    let mut scene = small("piggy-bank")?;
    scene.fracture = FractureConfig::as_in_the_paper();
    scene.duration = SHOWN;
    for body in &mut scene.bodies {
        body.material = Material::preset("paper-piggy")?;
    }
    scene.throw(Projectile {
        at: Vec3::new(0.0, 0.03, 0.0),
        ..Projectile::hammer(0.5, 0.02, HAMMER)
    });
    let baked = bake(&scene)?;
    Ok(play(&scene, &baked, &mut |_| {})?)
}

fn plate(material: &str) -> Result<Run, FigureError> {
    let mut scene = small("plate")?;
    scene.duration = SHOWN;
    for body in &mut scene.bodies {
        body.material = Material::preset(material)?;
    }
    let baked = bake(&scene)?;
    Ok(play(&scene, &baked, &mut |_| {})?)
}

/// Height that a body must rise before it counts as bouncing again, m.
const RISE: f32 = 4e-3;

/// Number of the bounce, from 1, at which the first body broke; `None` if it did not.
fn bounce_of_break(run: &Run) -> Option<usize> {
    let record = run.breaks.iter().find(|b| b.body == 0)?;
    let heights = lowest_points(&run.recording);
    let last =
        ((record.time * f64::from(run.recording.frame_rate)).floor() as usize).min(heights.len());
    Some(1 + bounces(&heights[..last]).len())
}

/// Frames of the bounces: where the lowest point was lowest before it rose again.
fn bounces(heights: &[f32]) -> Vec<usize> {
    let mut frames = Vec::new();
    let (mut low, mut at, mut falling) = (f32::INFINITY, 0, true);
    let mut high = f32::NEG_INFINITY;
    for (frame, &height) in heights.iter().enumerate() {
        if falling {
            if height < low {
                (low, at) = (height, frame);
            } else if height > low + RISE {
                frames.push(at);
                (falling, high) = (false, height);
            }
        } else {
            high = high.max(height);
            if height < high - RISE {
                (falling, low, at) = (true, height, frame);
            }
        }
    }
    frames
}

/// Height of the first body's lowest point in every frame in which it is whole, m.
fn lowest_points(recording: &Recording) -> Vec<f32> {
    let Some(node) = recording.nodes.first() else {
        return Vec::new();
    };
    let mesh = &recording.meshes[node.mesh];
    let lowest = |frame| {
        let pose = recording.pose(0, frame);
        let heights = mesh
            .positions
            .iter()
            .map(|&p| (pose.rotation * p + pose.translation).y);
        heights.fold(f32::INFINITY, f32::min)
    };
    node.visible.clone().map(lowest).collect()
}

/// Distance of the camera from the glass, m.
const NEAR: f32 = 0.42;

/// Looks at the first body where it is in this frame; its pieces start where it was.
fn near(recording: &Recording, frame: usize) -> View {
    let last = recording
        .nodes
        .first()
        .map_or(0, |node| node.visible.end.saturating_sub(1));
    let target = recording.pose(0, frame.min(last)).translation;
    View {
        eye: target + NEAR * Vec3::new(0.55, 0.5, 1.0).normalize(),
        target,
        ..recording.camera
    }
}

fn draw(glass: &Drop, pig: &Run, plates: &[Run]) -> Result<RgbImage, FigureError> {
    let options = SheetOptions {
        cell_width: 330,
        cell_height: 248,
        columns: 3,
    };
    let recording = &glass.run.recording;
    let first = bounces(&lowest_points(recording))
        .first()
        .copied()
        .unwrap_or(0);
    let studio = Studio::new(options.cell_width, options.cell_height)?;
    let moments = recording.moments;
    let whole = |frame: usize, label| -> Result<RgbImage, PhotoError> {
        let view = near(recording, frame);
        Ok(studio.frame(recording, frame, &view, label)?.into())
    };
    let at_rest = sheet_of_frames(&[(recording, moments.at_rest, "at rest")], &options)?.into();
    let above = beside(&[
        whole(first, "first bounce")?,
        whole(moments.first_crack, "second bounce")?,
        at_rest,
    ]);
    let r = &pig.recording;
    let middle = sheet_of_frames(
        &[
            (r, r.moments.before, "hammer"),
            (r, r.moments.first_crack + 1, "smashed"),
            (r, r.moments.at_rest, "at rest"),
        ],
        &options,
    )?
    .into();
    let labels: Vec<String> = PLATES
        .iter()
        .zip(plates)
        .map(|(material, run)| format!("{material}: {} pieces", pieces_of(run)))
        .collect();
    let cells: Vec<(&Recording, usize, &str)> = plates
        .iter()
        .zip(&labels)
        .map(|(run, label)| {
            (
                &run.recording,
                run.recording.moments.at_rest,
                label.as_str(),
            )
        })
        .collect();
    let plates = sheet_of_frames(&cells, &options)?.into();
    Ok(below(&[above, middle, plates]))
}

#[cfg(test)]
mod tests {
    use super::bounces;

    #[test]
    fn a_bounce_is_where_the_lowest_point_turns() {
        // Falls, bounces twice, lies.
        let heights = [
            0.3, 0.2, 0.02, 0.03, 0.08, 0.05, 0.004, 0.001, 0.02, 0.01, 0.0, 0.0, 0.001, 0.0,
        ];
        assert_eq!(bounces(&heights), [2, 7]);
        assert_eq!(bounces(&[0.3, 0.1, 0.0, 0.001, 0.0]), [0_usize; 0]);
    }
}
