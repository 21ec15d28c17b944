//! A scene as a game plays it: coarse steps, colliders of few parts, breaks on other threads and after the step, frames that begin when they
//! are due.

use std::time::{Duration, Instant};

use frangible_rapier::rapier3d::dynamics::RigidBody;
use frangible_rapier::{Breaking, StepTimings, WorldConfig};

use crate::bake::BakedBody;
use crate::error::SceneError;
use crate::scene::Scene;
use crate::stage::set_up_as;

/// Frames, and steps in each, per second.
const FRAME_RATE: f32 = 60.0;

/// Settings with which a game plays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GamePlan {
    /// Steps of a frame of 1/60 s, from 1.
    pub steps_per_frame: usize,
    /// Work per step, tetrahedra, and steps that a break has for itself: see [`Breaking::AfterStep`].
    pub budget: usize,
    /// See [`GamePlan::budget`].
    pub delay: usize,
    /// Times after its birth from which on a piece breaks, and with modes of its own, s: other threads find them meanwhile
    /// ([`PieceConfig`](frangible_rapier::PieceConfig)).
    pub pieces: [f32; 2],
    /// Work of other threads on pieces, s per second of the game ([`PieceConfig::pace`](frangible_rapier::PieceConfig::pace)).
    pub pace: f32,
    /// Colliders of few parts, those of [`WorldConfig::for_games`], in place of the default's.
    pub coarse_colliders: bool,
    /// Share of its body's volume below which a piece stays with a neighbour ([`FractureConfig::crumb_share`](frangible::FractureConfig::crumb_share)).
    pub crumb_share: f64,
}

impl Default for GamePlan {
    fn default() -> Self {
        Self {
            steps_per_frame: 2,
            budget: 8000,
            delay: 8,
            pieces: [0.1, 0.4],
            pace: 0.5,
            coarse_colliders: true,
            crumb_share: 5e-3,
        }
    }
}

/// Record of a scene played as in a game. All but the times is the same in every run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GameRun {
    /// Time of each frame, without waiting for its beginning, s.
    pub frames: Vec<f64>,
    /// Times of the parts of each frame: the sum over its steps.
    pub parts: Vec<StepTimings>,
    /// Bodies of the scene that broke.
    pub breaks: usize,
    /// Pieces that broke again.
    pub again: usize,
    /// Pose of each rigid body at the end: position, m, and rotation.
    pub poses: Vec<[f32; 7]>,
}

/// Plays a scene with these settings for its duration. Steps are coarse, so what breaks need not be what breaks in [`play`](crate::play()).
///
/// # Errors
/// A quantity of the scene that cannot be used, not as many baked bodies as the scene has, or a break that the fracture model
/// refused.
pub fn play_as_game(
    scene: &Scene,
    baked: &[BakedBody],
    plan: GamePlan,
    progress: &mut dyn FnMut(f64),
) -> Result<GameRun, SceneError> {
    scene.validate()?;
    let steps = plan.steps_per_frame.max(1);
    let mut stage = set_up_as(scene, baked, |config: &mut WorldConfig| {
        config.dt = 1.0 / (FRAME_RATE * steps as f32);
        config.record_held = false;
        config.fracture.samples_per_period = 4.0;
        config.fracture.crumb_share = plan.crumb_share;
        config.max_clumps = WorldConfig::for_games().max_clumps;
        if plan.coarse_colliders {
            let coarse = WorldConfig::for_games();
            config.hull_volume_ratio = coarse.hull_volume_ratio;
            config.whole_collider = coarse.whole_collider;
            config.fragment_collider = coarse.fragment_collider;
        }
        [config.pieces.delay, config.pieces.later] = plan.pieces;
        config.pieces.pace = plan.pace;
        config.breaking = Breaking::AfterStep {
            budget: plan.budget,
            delay: plan.delay,
        };
    })?;
    // As a game does while it loads.
    for body in stage.world.breakables() {
        if let Some(body) = stage.world.breakable(body) {
            body.prepare_for_blows(&stage.world.config().fracture);
        }
    }
    let mut run = GameRun::default();
    let frames = (scene.duration * f64::from(FRAME_RATE)).ceil() as usize;
    let mut due = Instant::now();
    for frame in 0..frames {
        let now = Instant::now();
        match due.checked_duration_since(now) {
            Some(early) => std::thread::sleep(early),
            None => due = now,
        }
        due += Duration::from_secs_f32(1.0 / FRAME_RATE);
        let began = Instant::now();
        stage.throw(scene, frame as f64 / f64::from(FRAME_RATE))?;
        let mut parts = StepTimings::default();
        for _ in 0..steps {
            stage.world.step()?;
            parts += *stage.world.timings();
            for event in stage.world.breaks() {
                // A body that is cracked and whole has a portion, too.
                match event.generation() {
                    0 => run.breaks += 1,
                    _ => run.again += 1,
                }
            }
        }
        run.frames.push(began.elapsed().as_secs_f64());
        run.parts.push(parts);
        progress((frame + 1) as f64 / frames as f64);
    }
    let pose = |body: &RigidBody| {
        let ([x, y, z], [i, j, k, w]) = (
            body.position().translation.to_array(),
            body.position().rotation.to_array(),
        );
        [x, y, z, i, j, k, w]
    };
    run.poses = stage
        .world
        .physics
        .bodies
        .iter()
        .map(|(_, body)| pose(body))
        .collect();
    Ok(run)
}
