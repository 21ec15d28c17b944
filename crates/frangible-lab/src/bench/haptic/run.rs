//! Strokes on one plate after another until each breaks, with the time of every tick.

use std::time::{Duration, Instant};

use frangible::glam::Vec3;
use frangible::{Breakable, FractureConfig, Material};
use serde::Serialize;

use super::hand::Hand;
use super::touch::{Felt, Kind, Probe, TICK, Touch};
use crate::bench::cache::Cache;
use crate::bench::error::BenchError;
use crate::bench::fingerprint::Fingerprint;
use crate::bench::stats::{Spread, Times};
use crate::bench::subjects::{MODES, Subject, steel_ball};

/// Mass of the hammer's head, kg, and the springs of the contact, N/m and N·s/m.
const HEAD: f64 = 0.13;
const STIFFNESS: f32 = 20e3;
const DAMPING: f32 = 30.0;
/// Speeds of the strokes on a plate, m/s; the last again and again until it breaks.
const SPEEDS: [f32; 6] = [0.1, 0.3, 1.0, 2.0, 4.0, 7.0];
/// Material of the plate: none of the paper's breaks under a hand.
const MATERIAL: &str = "glass";
/// Time steps per period of the highest mode that matters: cracks start between steps, so few serve.
const SAMPLES: f64 = 4.0;
/// A tick that begins later than this after its time, s, was missed.
const LATE: Duration = Duration::from_millis(1);

/// Options of the benchmark.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// Ticks of a run.
    pub ticks: u64,
    /// Equal runs that do not keep time: of each tick the least time counts.
    pub runs: usize,
    /// Also one run that keeps time with the clock.
    pub paced: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            ticks: 20_000,
            runs: 5,
            paced: true,
        }
    }
}

/// Ticks of a kind.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Taps {
    /// Name of the kind.
    pub title: &'static str,
    /// The least time of each tick over equal runs, one tick after the other, s: the work.
    pub work: Spread,
    /// Time of each tick in the run that kept time with the clock, s: with all that a machine adds.
    pub paced: Option<Spread>,
}

/// Punctuality of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Kept {
    /// Ticks that began more than a millisecond late.
    pub late: usize,
    /// Times that a verdict was not ready in its tick, so that the tick waited.
    pub waited: usize,
}

/// Results of the benchmark.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Findings {
    /// Tetrahedra of the plate.
    pub tets: usize,
    /// Its nodes.
    pub nodes: usize,
    /// Its modes.
    pub modes: usize,
    /// Its material.
    pub material: &'static str,
    /// Times of the ticks, by kind; the last line is all of them.
    pub taps: Vec<Taps>,
    /// Punctuality of the run with the clock.
    pub kept: Option<Kept>,
    /// Runs that did not keep time.
    pub runs: usize,
    /// Plates broken.
    pub broken: usize,
    /// Pieces of all of them.
    pub pieces: usize,
    /// Largest force, N.
    pub largest_force: f32,
    /// Largest displacement of the surface, m.
    pub largest_displacement: f32,
    /// Largest difference between the displacement and its quasi-static part, m.
    pub largest_swing: f32,
    /// A number made of all forces, displacements and pieces; it is the same in every run.
    pub fingerprint: String,
}

const KINDS: [(Kind, &str); 5] = [
    (Kind::Free, "no contact"),
    (Kind::Contact, "contact"),
    (Kind::Blow, "a blow, refused"),
    (Kind::Asked, "a crack may start"),
    (Kind::Verdict, "the answer is there"),
];

/// Bakes the plate, or reads it, and runs the loop.
///
/// # Errors
/// A body that does not bake, whose file cannot be read; runs that differ.
pub fn measure(
    subject: &'static Subject,
    cache: &Cache,
    options: &Options,
    progress: &mut dyn FnMut(&str, f64),
) -> Result<Findings, BenchError> {
    let name = format!("{MATERIAL}-{}", subject.file());
    let baked = cache.body(&name, MODES, MATERIAL, || subject.geometry(), progress)?;
    let kind = Breakable::uniform(baked.asset)?;
    let runs = options.runs.max(1);
    let of_all = (runs + usize::from(options.paced)) as f64;
    let mut best: Option<Log> = None;
    for run in 0..runs {
        progress("ticks one after the other", run as f64 / of_all);
        let log = play(&kind, options.ticks, false)?;
        best = Some(match best {
            None => log,
            Some(best) => best.least(&log)?,
        });
    }
    let best = best.unwrap_or_default();
    let paced = if options.paced {
        progress("ticks of 1 ms", runs as f64 / of_all);
        let log = play(&kind, options.ticks, true)?;
        // The clock must not change the forces and displacements.
        best.same(&log)?;
        Some(log)
    } else {
        None
    };
    let asset = kind.asset();
    Ok(Findings {
        tets: asset.fracture().tets.len(),
        nodes: asset.fracture().positions.len(),
        modes: asset.modes().count(),
        material: MATERIAL,
        taps: taps(&best, paced.as_ref()),
        kept: paced.map(|log| log.kept),
        runs,
        broken: best.broken,
        pieces: best.pieces,
        largest_force: best.largest_force,
        largest_displacement: best.largest_displacement,
        largest_swing: best.largest_swing,
        fingerprint: format!("{:016x}", best.print.value()),
    })
}

/// One run.
fn play(kind: &Breakable, ticks: u64, paced: bool) -> Result<Log, BenchError> {
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
    let mut plate = 1;
    // A tick has no time for the data that a first blow prepares.
    let fresh = |plate| {
        let body = kind.body(plate);
        body.prepare_for_blows(&config);
        body
    };
    let mut touch = Touch::new(fresh(plate), probe, &config)?;
    let mut log = Log::default();
    let mut clock = Clock::start(paced);
    let (mut strokes, mut broken) = (0, false);
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
        if due && !paced {
            touch.judge().wait();
        }
        clock.wait();
        let waits = due && !touch.judge().is_ready();
        let start = Instant::now();
        let felt = touch.tick(hand.position, hand.velocity)?;
        let time = start.elapsed();
        touch.judge().hand_over();
        log.kept.waited += usize::from(waits);
        log.add(&felt, time);
        hand.step(felt.force);
        broken |= felt.pieces.is_some();
    }
    log.kept.late = clock.late;
    Ok(log)
}

/// Log of the ticks.
#[derive(Default)]
struct Log {
    times: Vec<(Kind, f64)>,
    kept: Kept,
    broken: usize,
    pieces: usize,
    largest_force: f32,
    largest_displacement: f32,
    largest_swing: f32,
    print: Fingerprint,
}

impl Log {
    fn add(&mut self, felt: &Felt, time: Duration) {
        self.times.push((felt.kind, time.as_secs_f64()));
        let largest = |known: &mut f32, v: f32| *known = known.max(v);
        largest(&mut self.largest_force, felt.force.length());
        largest(&mut self.largest_displacement, felt.displacement.length());
        let swing = (felt.displacement - felt.at_rest).length();
        largest(&mut self.largest_swing, swing);
        let mut add = |v: Vec3| v.to_array().into_iter().for_each(|x| self.print.add(x));
        add(felt.force);
        add(felt.displacement);
        if let Some(fracture) = &felt.pieces {
            self.broken += 1;
            self.pieces += fracture.fragments.len();
            for fragment in &fracture.fragments {
                fragment.mesh.positions.iter().copied().for_each(&mut add);
            }
        }
    }

    /// An error where another run was not the same.
    fn same(&self, other: &Self) -> Result<(), BenchError> {
        if self.print == other.print {
            return Ok(());
        }
        let (a, b) = (self.print.value(), other.print.value());
        Err(BenchError::NotAsMeant(format!(
            "two equal runs of the haptic loop differ, {a:016x} and {b:016x}: please report it"
        )))
    }

    /// Takes the lesser time of each tick.
    fn least(mut self, other: &Self) -> Result<Self, BenchError> {
        self.same(other)?;
        for ((_, time), (_, t)) in self.times.iter_mut().zip(&other.times) {
            *time = time.min(*t);
        }
        Ok(self)
    }

    fn spread(&self, wanted: Option<Kind>) -> Spread {
        let times = self.times.iter();
        let times = times.filter(|(kind, _)| wanted.is_none_or(|w| w == *kind));
        Times::new(times.map(|(_, t)| *t).collect()).spread()
    }
}

fn taps(best: &Log, paced: Option<&Log>) -> Vec<Taps> {
    let kinds = KINDS.iter().map(|&(kind, title)| (Some(kind), title));
    kinds
        .chain([(None, "all")])
        .map(|(kind, title)| Taps {
            title,
            work: best.spread(kind),
            paced: paced.map(|log| log.spread(kind)),
        })
        .collect()
}

/// Begins ticks a millisecond apart, or at once.
struct Clock {
    next: Option<Instant>,
    late: usize,
}

impl Clock {
    fn start(paced: bool) -> Self {
        Self {
            next: paced.then(Instant::now),
            late: 0,
        }
    }

    fn wait(&mut self) {
        let Some(next) = &mut self.next else { return };
        let now = Instant::now();
        if let Some(early) = next.checked_duration_since(now) {
            std::thread::sleep(early);
        } else if now.duration_since(*next) > LATE {
            self.late += 1;
            // Missed ticks are not made up for.
            *next = now;
        }
        *next += Duration::from_secs_f64(TICK);
    }
}
