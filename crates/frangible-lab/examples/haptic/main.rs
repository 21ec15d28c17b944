//! A plate of glass under a hand, a thousand times a second: the force on the hand, and the break of the plate.
//!
//! `cargo run --release -p frangible-lab --example haptic -- [TICKS]` prints JSON, for `docs/data/haptic.json`: the time of every kind of tick, its
//! least over equal runs one tick after the other, and in one run that keeps time with the clock. The work of a tick is in [`touch`], the hand that
//! holds the probe in [`hand`], the verdicts from another thread in [`judge`], the vibration of the body from tick to tick in [`live`].

mod hand;
mod judge;
mod live;
#[cfg(test)]
mod tests;
mod touch;

use std::time::{Duration, Instant};

use frangible::{Breakable, FractureConfig, Material};
use frangible_lab::Result;
use frangible_lab::bench::Fingerprint;
use frangible_lab::bench::cache::Cache;
use frangible_lab::bench::stats::Times;
use frangible_lab::bench::subjects::{MODES, chosen, steel_ball};
use frangible_lab::data::{Measures, stored};
use serde_json::json;

use hand::Hand;
use touch::{Felt, Kind, Probe, TICK, Touch};

/// Mass of the hammer's head, kg, and the springs of the contact, N/m and N·s/m.
const HEAD: f64 = 0.13;
const STIFFNESS: f32 = 20e3;
const DAMPING: f32 = 30.0;
/// Speeds of the strokes on a plate, m/s; the last again and again until it breaks.
const SPEEDS: [f32; 6] = [0.1, 0.3, 1.0, 2.0, 4.0, 7.0];
/// Time steps per period of the highest mode that matters: cracks start between steps, so few serve.
const SAMPLES: f64 = 4.0;
/// Equal runs that do not keep time.
const RUNS: usize = 5;
const KINDS: [Kind; 5] = [
    Kind::Free,
    Kind::Contact,
    Kind::Blow,
    Kind::Asked,
    Kind::Verdict,
];

fn main() -> Result<()> {
    let ticks = std::env::args().nth(1).map_or(Ok(20_000), |n| n.parse())?;
    let cache = Cache {
        folder: "target/bench".into(),
        rebake: false,
    };
    let subject = chosen(&["slab-moderate".into()])?[0];
    let geometry = || subject.geometry();
    // None of the paper's materials breaks under a hand.
    let baked = cache.body("glass-slab-moderate", MODES, "glass", geometry)?;
    let kind = Breakable::uniform(baked.asset)?;
    let mut best = play(&kind, ticks, false)?;
    for _ in 1..RUNS {
        let log = play(&kind, ticks, false)?;
        best.same(&log)?;
        for ((_, time), (_, other)) in best.times.iter_mut().zip(log.times) {
            *time = time.min(other);
        }
    }
    // The clock must not change the forces and displacements.
    let paced = play(&kind, ticks, true)?;
    best.same(&paced)?;
    let rows = KINDS.map(Some).into_iter().chain([None]).map(|wanted| {
        let spread = |log: &Log| {
            let times = log
                .times
                .iter()
                .filter(|(kind, _)| wanted.is_none_or(|w| w == *kind));
            Times::new(times.map(|(_, t)| *t).collect()).spread()
        };
        let name = wanted.map_or("all".into(), |kind| format!("{kind:?}"));
        json!({ "tick": name, "work_s": spread(&best), "paced_s": spread(&paced) })
    });
    let found = json!({
        "ticks": rows.collect::<Vec<_>>(),
        "tets": kind.asset().fracture().tets.len(),
        "late": paced.late,
        "waited": paced.waited,
        "broken": best.broken,
        "pieces": best.pieces,
        "largest_force_n": best.largest[0],
        "largest_displacement_m": best.largest[1],
        "largest_swing_m": best.largest[2],
        "fingerprint": format!("{:016x}", best.print.value()),
    });
    println!("{:#}", stored(Measures::Model, true, &found)?);
    Ok(())
}

/// One run.
fn play(kind: &Breakable, ticks: u64, paced: bool) -> Result<Log> {
    let steel = Material::preset("steel")?;
    let radius = (0.75 * HEAD / steel.density / std::f64::consts::PI).cbrt() as f32;
    let probe = Probe {
        radius,
        striker: steel_ball(HEAD)?,
        stiffness: STIFFNESS,
        damping: DAMPING,
    };
    let mut config = FractureConfig::with_given_impulses();
    config.samples_per_period = SAMPLES;
    let positions = kind.asset().fracture().positions.iter();
    let top = positions.map(|p| p.z).fold(f32::NEG_INFINITY, f32::max);
    let mut hand = Hand::new(HEAD as f32, radius, top, 1);
    // A tick has no time for the data that a first blow prepares.
    let fresh = |plate| {
        let body = kind.body(plate);
        body.prepare_for_blows(&config);
        body
    };
    let (mut plate, mut strokes, mut broken) = (1, 0, false);
    let mut touch = Touch::new(fresh(plate), probe, &config)?;
    let mut log = Log::default();
    let mut next = Instant::now();
    for _ in 0..ticks {
        if hand.is_done() {
            if broken {
                plate += 1;
                touch.replace(fresh(plate))?;
                (strokes, broken) = (0, false);
            }
            hand.strike(SPEEDS[strokes.min(SPEEDS.len() - 1)]);
            strokes += 1;
        }
        let due = touch.expects_verdict();
        if paced {
            log.late += usize::from(!wait(&mut next));
            log.waited += usize::from(due && !touch.judge().is_ready());
        }
        while due && !paced && !touch.judge().is_ready() {
            std::thread::yield_now();
        }
        let start = Instant::now();
        let felt = touch.tick(hand.position, hand.velocity)?;
        let time = start.elapsed();
        touch.judge().hand_over();
        log.add(&felt, time);
        hand.step(felt.force);
        broken |= felt.pieces.is_some();
    }
    Ok(log)
}

/// Sleeps until the next tick. Returns false if it is more than a millisecond late; missed ticks are not made up for.
fn wait(next: &mut Instant) -> bool {
    let now = Instant::now();
    let punctual = now < *next + Duration::from_millis(1);
    match next.checked_duration_since(now) {
        Some(early) => std::thread::sleep(early),
        None if punctual => {}
        None => *next = now,
    }
    *next += Duration::from_secs_f64(TICK);
    punctual
}

/// Log of the ticks.
#[derive(Default)]
struct Log {
    times: Vec<(Kind, f64)>,
    late: usize,
    waited: usize,
    broken: usize,
    pieces: usize,
    /// Largest force, N, displacement, m, and difference between the displacement and its quasi-static part, m.
    largest: [f32; 3],
    /// Made of all forces, displacements and pieces.
    print: Fingerprint,
}

impl Log {
    fn add(&mut self, felt: &Felt, time: Duration) {
        self.times.push((felt.kind, time.as_secs_f64()));
        let swing = felt.displacement - felt.at_rest;
        let sizes = [felt.force, felt.displacement, swing].map(|v| v.length());
        for (largest, size) in self.largest.iter_mut().zip(sizes) {
            *largest = largest.max(size);
        }
        let pieces = felt
            .pieces
            .as_ref()
            .map_or(&[][..], |fracture| &fracture.fragments);
        self.broken += usize::from(felt.pieces.is_some());
        self.pieces += pieces.len();
        let places = pieces.iter().flat_map(|piece| &piece.mesh.positions);
        for v in [felt.force, felt.displacement].iter().chain(places) {
            v.to_array().into_iter().for_each(|x| self.print.add(x));
        }
    }

    /// An error where another run was not the same.
    fn same(&self, other: &Self) -> Result<()> {
        if self.print == other.print {
            return Ok(());
        }
        Err("two equal runs of the haptic loop differ: please report it".into())
    }
}
