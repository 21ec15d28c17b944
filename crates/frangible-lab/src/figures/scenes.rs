//! Fig. 1: a glass, a piggy bank and three plates.

use frangible::glam::{Quat, Vec3};
use frangible::{FractureConfig, Material};
use frangible_recording::Recording;
use frangible_scenes::{BakedBody, BodySource, Projectile, Run, Scene, bake, play, scene};
use serde_json::{Value, json};

use crate::Result;

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

/// A glass that breaks at its second bounce, a piggy bank under a hammer, plates of three materials.
pub(super) fn compute() -> Result<Value> {
    let glass = second_bounce()?;
    let mut runs = vec![("glass", glass.run), ("piggy bank", piggy_bank()?)];
    for material in PLATES {
        runs.push((material, plate(material)?));
    }
    let rows = runs.iter().filter_map(|(name, run)| {
        let record = run.breaks.first()?;
        Some(json!({
            "scene": name,
            "bounce": bounce_of_break(run),
            "peak_stress_pa": record.report.peak_stress,
            "cracks": record.report.cracks,
            "pieces": record.masses.len(),
        }))
    });
    let rows: Vec<Value> = rows.collect();
    Ok(json!({ "glass_height_m": glass.height, "glass_tilt_degrees": glass.tilt, "scenes": rows }))
}

/// A drop and its outcome.
struct Drop {
    height: f64,
    tilt: f32,
    run: Run,
}

/// The first drop of the glass that it survives, but not its second bounce; without one the first that breaks it later than at once.
fn second_bounce() -> Result<Drop> {
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
    let (height, tilt) = later.ok_or("no drop breaks the glass at its second bounce")?;
    tilted(&mut scene, tilt);
    shown(&mut scene, &baked, height, tilt)
}

fn tilted(scene: &mut Scene, degrees: f32) {
    let upright = Quat::from_rotation_x(-std::f32::consts::FRAC_PI_2);
    for body in &mut scene.bodies {
        body.rotation = Quat::from_rotation_z(degrees.to_radians()) * upright;
    }
}

fn shown(scene: &mut Scene, baked: &[BakedBody], height: f64, tilt: f32) -> Result<Drop> {
    scene.drop_all(height);
    scene.duration = SHOWN;
    let run = play(scene, baked, &mut |_| {})?;
    Ok(Drop { height, tilt, run })
}

/// A built-in scene with a body of fewer elements and modes.
fn small(name: &str) -> Result<Scene> {
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

fn piggy_bank() -> Result<Run> {
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

fn plate(material: &str) -> Result<Run> {
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
