//! One run: the shop settles, the bull comes, every frame is timed.

use std::time::{Duration, Instant};

use frangible_lab::Result;
use frangible_lab::bench::Fingerprint;
use frangible_rapier::rapier3d::dynamics::{MassProperties, RigidBodyHandle};
use frangible_rapier::rapier3d::geometry::Collider;
use frangible_rapier::rapier3d::math::Vector;
use frangible_rapier::{BreakableWorld, Breaking, ColliderDetail, WorldConfig};

use crate::crockery::Kind;
use crate::furnish::{Shop, furnish, let_in};

/// Frames per second, one step of physics each.
pub(crate) const FRAME_RATE: f32 = 60.0;
/// Frames for the things to come to rest before the bull comes.
pub(crate) const SETTLE: usize = 90;
/// Seed of the weak points.
pub(crate) const SEED: u64 = 7;
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

/// A piece that was made, for the shop that has it from the beginning.
#[derive(Clone)]
pub(crate) struct Piece {
    pub(crate) handle: RigidBodyHandle,
    pub(crate) parent: RigidBodyHandle,
    /// Centre of mass in the parent's frame, m.
    pub(crate) centre: Vector,
    pub(crate) mass: MassProperties,
    pub(crate) colliders: Vec<Collider>,
}

/// A run.
pub(crate) struct Run {
    pub(crate) frames: Vec<Frame>,
    pub(crate) happened: Vec<Happened>,
    pub(crate) print: Fingerprint,
    /// Pieces that are there in the end.
    pub(crate) pieces: Vec<Piece>,
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

/// The shop, with everything at rest.
pub(crate) fn settled(kinds: &[Kind]) -> Result<Shop> {
    let mut shop = furnish(kinds, config(), SEED)?;
    for _ in 0..SETTLE {
        shop.world.step()?;
    }
    Ok(shop)
}

/// A run of so many frames.
pub(crate) fn play(kinds: &[Kind], frames: usize) -> Result<Run> {
    let Shop { mut world, things } = settled(kinds)?;
    let_in(&mut world)?;
    let mut run = Run {
        frames: Vec::with_capacity(frames),
        happened: Vec::with_capacity(frames),
        print: Fingerprint::default(),
        pieces: Vec::new(),
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
        run.pieces.extend(new_pieces(&world));
    }
    run.pieces
        .retain(|piece| world.physics.bodies.contains(piece.handle));
    for (_, body) in world.physics.bodies.iter() {
        let (p, v) = (body.position().translation, body.linvel());
        for x in p.to_array().into_iter().chain(v.to_array()) {
            run.print.add(x);
        }
    }
    Ok(run)
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

/// Pieces with a collider that the last step made.
fn new_pieces(world: &BreakableWorld) -> Vec<Piece> {
    let physics = &world.physics;
    let mut pieces = Vec::new();
    for event in world.breaks() {
        for (&handle, fragment) in event.fragments.iter().zip(&event.fracture.fragments) {
            let Some(body) = physics.bodies.get(handle) else {
                continue;
            };
            let colliders = body.colliders().iter();
            let colliders: Vec<Collider> = colliders
                .filter_map(|&c| physics.colliders.get(c).cloned())
                .collect();
            if !colliders.is_empty() {
                pieces.push(Piece {
                    handle,
                    parent: event.parent,
                    centre: fragment.mass.centre.as_vec3(),
                    mass: body.mass_properties().local_mprops,
                    colliders,
                });
            }
        }
    }
    pieces
}
