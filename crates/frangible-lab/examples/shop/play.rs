//! One run: the shop settles, the bull comes, every frame is timed.

use std::time::{Duration, Instant};

use frangible_lab::Result;
use frangible_lab::bench::Fingerprint;
use frangible_rapier::{BreakableWorld, Breaking, ColliderDetail, WorldConfig};

use crate::crockery::Kind;
use crate::furnish::{Shop, furnish, let_in};

/// Frames per second, one step of physics each.
pub(crate) const FRAME_RATE: f32 = 60.0;
/// Frames for the things to come to rest before the bull comes.
pub(crate) const SETTLE: usize = 90;
/// Seed of the weak points.
pub(crate) const SEED: u64 = 7;
/// Speed of the bull, m/s.
pub(crate) const SPEED: f32 = 7.0;
/// Work per step, tetrahedra, and steps that a break has for itself: see [`Breaking::AfterStep`].
pub(crate) const BUDGET: usize = 8000;
pub(crate) const DELAY: usize = 8;

/// Times of a frame, s.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Frame {
    /// Time of the whole frame.
    pub(crate) all: f64,
    /// Rapier's step.
    pub(crate) rigid: f64,
    /// Time of the frame without Rapier's step.
    pub(crate) ours: f64,
    /// Parts of that time: [`PARTS`].
    pub(crate) parts: [f64; 5],
}

/// Parts of [`Frame::parts`].
pub(crate) const PARTS: [&str; 5] = ["contacts", "fracture", "fragments", "loads", "upkeep"];

impl Frame {
    /// Takes the lesser of each time of two equal frames.
    pub(crate) fn least(&mut self, other: &Self) {
        self.all = self.all.min(other.all);
        self.rigid = self.rigid.min(other.rigid);
        self.ours = self.ours.min(other.ours);
        for (a, b) in self.parts.iter_mut().zip(other.parts) {
            *a = a.min(b);
        }
    }
}

/// Events of a frame; the same in every run.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Happened {
    /// Things that broke.
    pub(crate) breaks: usize,
    /// Pieces they broke into.
    pub(crate) pieces: usize,
    /// Bodies in the world.
    pub(crate) bodies: usize,
    /// Bodies in the world that move.
    pub(crate) awake: usize,
}

/// A run, or the least times of several equal ones.
pub(crate) struct Run {
    pub(crate) frames: Vec<Frame>,
    pub(crate) happened: Vec<Happened>,
    pub(crate) print: Fingerprint,
    /// Things in the shop.
    pub(crate) things: usize,
}

/// Settings of the world: for many bodies.
pub(crate) fn config() -> WorldConfig {
    let mut config = WorldConfig::for_games();
    config.dt = 1.0 / FRAME_RATE;
    config.fracture.samples_per_period = 4.0;
    config.breaking = Breaking::AfterStep {
        budget: BUDGET,
        delay: DELAY,
    };
    config.whole_collider = ColliderDetail {
        parts: 1,
        // With half as many a foot has too few corners to stand on, and bottles fall over.
        hull_points: 64,
    };
    config.debris_mass = 3e-3;
    config.dust_mass = 1e-3;
    config.fracture.crumb_share = 5e-3;
    config.impact_speed = 1.0;
    config
}

/// Begins frames at their rate, as a game does that waits for the screen: other threads have the time in between.
pub(crate) struct Clock(Instant);

impl Clock {
    pub(crate) fn start() -> Self {
        Self(Instant::now())
    }

    /// Sleeps until the next frame is due; at once, if the last one took too long.
    pub(crate) fn wait(&mut self) {
        let now = Instant::now();
        match self.0.checked_duration_since(now) {
            Some(early) => std::thread::sleep(early),
            None => self.0 = now,
        }
        self.0 += Duration::from_secs_f32(1.0 / FRAME_RATE);
    }
}

/// A run of so many frames, with a bull of this speed, m/s.
pub(crate) fn play(kinds: &[Kind], frames: usize, config: WorldConfig, speed: f32) -> Result<Run> {
    let Shop { mut world, things } = furnish(kinds, config, SEED)?;
    for _ in 0..SETTLE {
        world.step()?;
    }
    let_in(&mut world, speed)?;
    let mut run = Run {
        frames: Vec::with_capacity(frames),
        happened: Vec::with_capacity(frames),
        print: Fingerprint::default(),
        things: things.len(),
    };
    let mut clock = Clock::start();
    for _ in 0..frames {
        clock.wait();
        let start = Instant::now();
        world.step()?;
        let all = start.elapsed().as_secs_f64();
        let t = world.timings();
        run.frames.push(Frame {
            all,
            rigid: t.rigid,
            ours: all - t.rigid,
            parts: [t.contacts, t.fracture, t.fragments, t.loads, t.upkeep],
        });
        run.happened.push(happened(&world));
    }
    for (_, body) in world.physics.bodies.iter() {
        let (p, v) = (body.position().translation, body.linvel());
        for x in p.to_array().into_iter().chain(v.to_array()) {
            run.print.add(x);
        }
    }
    Ok(run)
}

/// The least times of so many equal runs.
///
/// # Errors
/// Runs that differ.
pub(crate) fn play_often(
    kinds: &[Kind],
    frames: usize,
    config: &WorldConfig,
    speed: f32,
    runs: usize,
) -> Result<Run> {
    let mut best = play(kinds, frames, config.clone(), speed)?;
    for _ in 1..runs {
        let other = play(kinds, frames, config.clone(), speed)?;
        if best.print != other.print {
            return Err("two equal runs of the china shop differ: please report it".into());
        }
        for (frame, other) in best.frames.iter_mut().zip(&other.frames) {
            frame.least(other);
        }
    }
    Ok(best)
}

fn happened(world: &BreakableWorld) -> Happened {
    let breaks = world.breaks();
    let bodies = world.physics.bodies.iter();
    Happened {
        breaks: breaks.len(),
        pieces: breaks.iter().map(|e| e.fragments.len()).sum(),
        bodies: world.physics.bodies.len(),
        awake: bodies
            .filter(|(_, b)| !(b.is_sleeping() || b.is_fixed()))
            .count(),
    }
}
