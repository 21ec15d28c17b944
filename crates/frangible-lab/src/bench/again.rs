//! Scenes whose pieces break again, played as a game plays them: frame times.
//!
//! Every run gives the same bits, so a frame's time is its least over the runs, and percentiles are over frames.

use frangible::FractureConfig;
use frangible_scenes::{GamePlan, GameRun, SceneError, bake, play_as_game, scene};
use serde::Serialize;

use crate::Result;
use crate::bench::fingerprint::Fingerprint;
use crate::bench::stats::{Spread, Times};

/// The scenes.
pub const SCENES: [&str; 4] = ["shards", "five-blows", "wall", "crockery"];

/// Fracture tetrahedra and modes of each body, as of a game's.
pub const SIZE: [usize; 2] = [8000, 40];

/// The scene that leaves the heap.
pub const HEAP: &str = "hammer";

/// Results of the benchmark.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Found {
    /// Frames of the scenes whose pieces break again.
    pub scenes: Vec<Findings>,
    /// Results of the heap.
    pub heap: Heap,
}

/// Results of a heap of pieces.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Heap {
    /// Rigid bodies in the end.
    pub bodies: usize,
    /// Simulated time, s.
    pub seconds: f64,
    /// Time of all frames, s.
    pub frames: f64,
    /// Time of Rapier's steps in them, s.
    pub rigid: f64,
}

/// Results of a scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Findings {
    /// Its name.
    pub scene: String,
    /// Bodies of the scene that broke.
    pub breaks: usize,
    /// Pieces that broke again.
    pub again: usize,
    /// Rigid bodies in the end.
    pub bodies: usize,
    /// Equal runs.
    pub runs: usize,
    /// Frames: the least time of each.
    pub frames: Spread,
    /// Frames with the default's colliders, which have more parts.
    pub fine: Spread,
    /// Rapier's steps in the frames, likewise.
    pub rigid: Spread,
    /// Frames over 1/60 s.
    pub late: usize,
    /// A number made of all bodies in the end; it is the same in every run.
    pub fingerprint: String,
}

/// Plays each scene, and the heap, so many times.
///
/// # Errors
/// A scene that cannot be baked or played, runs that differ.
pub fn measure(runs: usize, plan: GamePlan, progress: &mut dyn FnMut(&str, f64)) -> Result<Found> {
    let runs = runs.max(1);
    let mut scenes = Vec::new();
    for (i, name) in SCENES.into_iter().enumerate() {
        let share = |part: f64| (i as f64 + part) / (SCENES.len() + 1) as f64;
        progress(name, share(0.0));
        let mut scene = scene(name)?;
        for body in &mut scene.bodies {
            (body.resolution, body.modes) = (Some(SIZE[0]), SIZE[1]);
        }
        let baked = bake(&scene)?;
        let best = best_of(name, runs, || {
            play_as_game(&scene, &baked, plan, &mut |_| {})
        })?;
        progress(name, share(0.5));
        let fine = GamePlan {
            coarse_colliders: false,
            ..plan
        };
        let fine = best_of(name, runs, || {
            play_as_game(&scene, &baked, fine, &mut |_| {})
        })?;
        scenes.push(Findings {
            scene: name.into(),
            breaks: best.breaks,
            again: best.again,
            bodies: best.poses.len(),
            runs,
            late: best.frames.iter().filter(|t| **t > 1.0 / 60.0).count(),
            fingerprint: format!("{:016x}", print(&best).value()),
            frames: Times::new(best.frames).spread(),
            fine: Times::new(fine.frames).spread(),
            rigid: Times::new(best.parts.iter().map(|p| p.rigid).collect()).spread(),
        });
    }
    progress(HEAP, SCENES.len() as f64 / (SCENES.len() + 1) as f64);
    let heap = heap(runs, plan)?;
    Ok(Found { scenes, heap })
}

/// Plays a heap of all pieces that there are, in one step per frame.
fn heap(runs: usize, plan: GamePlan) -> Result<Heap> {
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
    Ok(Heap {
        bodies: best.poses.len(),
        seconds: best.frames.len() as f64 / 60.0,
        frames: best.frames.iter().sum(),
        rigid: best.parts.iter().map(|part| part.rigid).sum(),
    })
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
