//! Scenes whose pieces break again, played as a game plays them: frame times.
//!
//! Every run gives the same bits, so a frame's time is its least over the runs, and percentiles are over frames.

use frangible::FractureConfig;
use frangible_scenes::{GamePlan, GameRun, SceneError, bake, play_as_game, scene};
use serde_json::{Value, json};

use crate::Result;
use crate::bench::fingerprint::Fingerprint;
use crate::bench::stats::Times;

/// The scenes.
const SCENES: [&str; 4] = ["shards", "five-blows", "wall", "crockery"];

/// Fracture tetrahedra and modes of each body, as of a game's.
const SIZE: [usize; 2] = [8000, 40];

/// The scene that leaves the heap.
const HEAP: &str = "hammer";

/// Plays each scene, and the heap, so many times.
///
/// # Errors
/// A scene that cannot be baked or played, runs that differ.
pub fn measure(runs: usize, plan: GamePlan) -> Result<Value> {
    let runs = runs.max(1);
    let mut scenes = Vec::new();
    for name in SCENES {
        let mut scene = scene(name)?;
        for body in &mut scene.bodies {
            (body.resolution, body.modes) = (Some(SIZE[0]), SIZE[1]);
        }
        let baked = bake(&scene)?;
        let best = best_of(name, runs, || {
            play_as_game(&scene, &baked, plan, &mut |_| {})
        })?;
        let fine = GamePlan {
            coarse_colliders: false,
            ..plan
        };
        let fine = best_of(name, runs, || {
            play_as_game(&scene, &baked, fine, &mut |_| {})
        })?;
        scenes.push(json!({
            "scene": name,
            "breaks": best.breaks,
            "again": best.again,
            "bodies": best.poses.len(),
            "runs": runs,
            "late_frames": best.frames.iter().filter(|t| **t > 1.0 / 60.0).count(),
            "fingerprint": format!("{:016x}", print(&best).value()),
            "frames": Times::new(best.frames).spread(),
            "frames_with_default_colliders": Times::new(fine.frames).spread(),
            "rapier": Times::new(best.parts.iter().map(|p| p.rigid).collect()).spread(),
        }));
    }
    Ok(json!({ "scenes": scenes, "heap": heap(runs, plan)? }))
}

/// Plays a heap of all pieces that there are, in one step per frame.
fn heap(runs: usize, plan: GamePlan) -> Result<Value> {
    let scene = scene(HEAP)?;
    let baked = bake(&scene)?;
    let plan = GamePlan {
        steps_per_frame: 1,
        crumb_share: FractureConfig::default().crumb_share,
        ..plan
    };
    let best = best_of(HEAP, runs, || {
        play_as_game(&scene, &baked, plan, &mut |_| {})
    })?;
    Ok(json!({
        "bodies": best.poses.len(),
        "simulated_s": best.frames.len() as f64 / 60.0,
        "frames_s": best.frames.iter().sum::<f64>(),
        "rapier_s": best.parts.iter().map(|part| part.rigid).sum::<f64>(),
    }))
}

/// The least time of each frame over equal runs.
fn best_of(
    name: &str,
    runs: usize,
    mut play: impl FnMut() -> std::result::Result<GameRun, SceneError>,
) -> Result<GameRun> {
    let mut best = play()?;
    for _ in 1..runs {
        let other = play()?;
        if print(&other) != print(&best) {
            let problem = format!("two runs of the scene `{name}` ended differently");
            return Err(crate::Error::from(problem));
        }
        for (time, t) in best.frames.iter_mut().zip(other.frames) {
            *time = time.min(t);
        }
        for (best, other) in best.parts.iter_mut().zip(other.parts) {
            best.rigid = best.rigid.min(other.rigid);
        }
    }
    Ok(best)
}

fn print(run: &GameRun) -> Fingerprint {
    let mut print = Fingerprint::default();
    run.poses.iter().flatten().for_each(|&x| print.add(x));
    print
}
